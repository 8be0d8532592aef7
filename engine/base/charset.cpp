#include "engine/base/charset.h"

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace engine {

namespace {

bool is_open(iconv_t handle) { return reinterpret_cast<std::intptr_t>(handle) != -1; }

struct Alias {
    std::string_view name;  // lower case, letters and digits only
    const char* iconv_name;
    Pairs pairs;
};

constexpr std::array<Alias, 22> aliases{{
    {"gb2312", "GB18030", Pairs::from_0x81},
    {"euccn", "GB18030", Pairs::from_0x81},
    {"gbk", "GB18030", Pairs::from_0x81},
    {"cp936", "GB18030", Pairs::from_0x81},
    {"gb18030", "GB18030", Pairs::from_0x81},
    {"gb", "GB18030", Pairs::from_0x81},
    {"windows936", "GB18030", Pairs::from_0x81},
    {"big5", "CP950", Pairs::from_0x81},
    {"cp950", "CP950", Pairs::from_0x81},
    {"big5hkscs", "BIG5-HKSCS", Pairs::from_0x81},
    {"euckr", "CP949", Pairs::from_0x81},
    {"ksc56011987", "CP949", Pairs::from_0x81},
    {"cp949", "CP949", Pairs::from_0x81},
    {"uhc", "CP949", Pairs::from_0x81},
    {"shiftjis", "CP932", Pairs::shift_jis},
    {"sjis", "CP932", Pairs::shift_jis},
    {"xsjis", "CP932", Pairs::shift_jis},
    {"mskanji", "CP932", Pairs::shift_jis},
    {"windows31j", "CP932", Pairs::shift_jis},
    {"cp932", "CP932", Pairs::shift_jis},
    {"utf8", "UTF-8", Pairs::none},
    {"latin1", "ISO-8859-1", Pairs::none},
}};

const Alias* alias_of(std::string_view charset) {
    std::string plain;
    for (const char c : charset)
        if (is_upper(c) || is_lower(c) || is_digit(c)) plain += to_lower(c);
    const auto* const found = std::find_if(aliases.begin(), aliases.end(),
                                           [&](const Alias& alias) { return alias.name == plain; });
    return found == aliases.end() ? nullptr : found;
}

// Names come from files: iconv must not see its own suffixes ("//IGNORE") or a path.
bool well_formed(std::string_view name) {
    const auto allowed = [](char c) {
        return is_upper(c) || is_lower(c) || is_digit(c) || c == '-' || c == '_';
    };
    return !name.empty() && name.size() <= 40 && std::all_of(name.begin(), name.end(), allowed);
}

std::string iconv_name(std::string_view charset) {
    charset = trimmed(charset);
    const auto* const alias = alias_of(charset);
    return alias && well_formed(charset) ? alias->iconv_name : std::string(charset);
}

std::optional<iconv_t> open(std::string_view to, std::string_view from) {
    const auto to_name = iconv_name(to), from_name = iconv_name(from);
    if (!well_formed(to_name) || !well_formed(from_name)) return {};
    auto* const handle = ::iconv_open(to_name.c_str(), from_name.c_str());
    return is_open(handle) ? std::optional(handle) : std::nullopt;
}

iconv_t open_or_fail(std::string_view to, std::string_view from, std::string_view charset) {
    const auto handle = open(to, from);
    if (!handle) fail("unknown charset: {}", excerpt(charset));
    return *handle;
}

// Bytes to pass over where the conversion cannot go on: a whole character of UTF-8 input.
std::size_t unit(std::string_view rest, bool from_utf8) {
    std::size_t length = 1;
    while (from_utf8 && length < rest.size() && (rest[length] & 0xC0) == 0x80) ++length;
    return length;
}

std::string convert(iconv_t handle, std::string_view rest, std::string_view stand_in,
                    bool from_utf8) {
    std::string result;
    result.reserve(rest.size());
    std::array<char, 4096> buffer;
    ::iconv(handle, nullptr, nullptr, nullptr, nullptr);
    bool finished = false;
    while (!finished) {
        auto* in = const_cast<char*>(rest.data());
        std::size_t left = rest.size();
        char* out = buffer.data();
        std::size_t room = buffer.size();
        // The last call, without input, writes what returns a stateful charset to its start.
        finished = rest.empty();
        const auto status = ::iconv(handle, finished ? nullptr : &in, &left, &out, &room);
        const int error = status == static_cast<std::size_t>(-1) ? errno : 0;
        result.append(buffer.data(), buffer.size() - room);
        rest.remove_prefix(rest.size() - left);
        if (error == 0 || error == E2BIG || rest.empty()) continue;
        result += stand_in;
        rest.remove_prefix(unit(rest, from_utf8));
    }
    return result;
}

}  // namespace

bool is_charset(std::string_view charset) {
    if (iconv_name(charset) == "UTF-8") return true;
    const auto handle = open("UTF-8", charset);
    if (handle) ::iconv_close(*handle);
    return handle.has_value();
}

Decoder::Decoder(std::string_view charset)
    : handle_(iconv_name(charset) == "UTF-8" ? nullptr : open_or_fail("UTF-8", charset, charset)) {}

Decoder::~Decoder() {
    if (handle_) ::iconv_close(handle_);
}

std::string Decoder::operator()(std::string_view bytes) {
    return handle_ ? convert(handle_, bytes, "\xEF\xBF\xBD", false) : repaired_utf8(bytes);
}

std::string to_utf8(std::string_view bytes, std::string_view charset) {
    return Decoder(charset)(bytes);
}

std::string from_utf8(std::string_view text, std::string_view charset) {
    const auto handle = open_or_fail(charset, "UTF-8", charset);
    auto result = convert(handle, text, "?", true);
    ::iconv_close(handle);
    return result;
}

Pairs pairs_of(std::string_view charset) {
    const auto* const alias = alias_of(charset);
    return alias ? alias->pairs : Pairs::none;
}

}  // namespace engine
