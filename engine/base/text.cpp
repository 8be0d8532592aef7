#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace engine {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

// Table 3-7 of the Unicode standard: a range of first bytes, that of the second byte after it
// (any further one is 0x80..0xBF), and the length.
struct Form {
    std::uint8_t first, last, second_least, second_most;
    std::size_t length;
};
constexpr std::array<Form, 9> forms{{
    {0x00, 0x7F, 0x00, 0xFF, 1},
    {0xC2, 0xDF, 0x80, 0xBF, 2},
    {0xE0, 0xE0, 0xA0, 0xBF, 3},
    {0xE1, 0xEC, 0x80, 0xBF, 3},
    {0xED, 0xED, 0x80, 0x9F, 3},
    {0xEE, 0xEF, 0x80, 0xBF, 3},
    {0xF0, 0xF0, 0x90, 0xBF, 4},
    {0xF1, 0xF3, 0x80, 0xBF, 4},
    {0xF4, 0xF4, 0x80, 0x8F, 4},
}};

bool has_form(std::string_view text, const Form& form) {
    if (text.size() < form.length) return false;
    const auto within = [&](std::size_t i, std::uint8_t least, std::uint8_t most) {
        const auto byte = static_cast<std::uint8_t>(text[i]);
        return byte >= least && byte <= most;
    };
    if (!within(0, form.first, form.last)) return false;
    if (form.length > 1 && !within(1, form.second_least, form.second_most)) return false;
    for (std::size_t i = 2; i < form.length; ++i)
        if (!within(i, 0x80, 0xBF)) return false;
    return true;
}

// Bytes of the well-formed character that `text` begins with, 0 if there is none.
std::size_t character_length(std::string_view text) {
    const auto* const form =
        std::find_if(forms.begin(), forms.end(), [&](const Form& f) { return has_form(text, f); });
    return form == forms.end() ? 0 : form->length;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view take_word(std::string_view& text) {
    text = trimmed(text);
    std::size_t end = 0;
    while (end < text.size() && !is_blank(text[end])) ++end;
    const auto word = text.substr(0, end);
    text.remove_prefix(end);
    return word;
}

std::string_view take_operation(std::string_view& text) {
    bool quoted = false;
    std::size_t end = 0;
    for (; end < text.size() && (quoted || text[end] != ';'); ++end)
        if (text[end] == '"') quoted = !quoted;
    const auto operation = text.substr(0, end);
    text.remove_prefix(end < text.size() ? end + 1 : end);
    return trimmed(operation);
}

std::string_view unquoted(std::string_view text) {
    if (text.starts_with('"')) text.remove_prefix(1);
    if (text.ends_with('"')) text.remove_suffix(1);
    return text;
}

bool is_ascii(std::string_view text) {
    return std::all_of(text.begin(), text.end(),
                       [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const auto length = character_length(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string repaired_utf8(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const auto length = character_length(text);
        result += length == 0 ? replacement : text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

std::string excerpt(std::string_view text, std::size_t most) {
    std::string result(text.substr(0, most));
    for (char& c : result)
        if (c < ' ' || c > '~') c = '?';
    return text.size() > most ? result + "..." : result;
}

}  // namespace engine
