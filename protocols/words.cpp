#include "protocols/words.h"

#include <optional>
#include <sstream>

#include "engine/base/option.h"

namespace protocols {

namespace {

std::optional<engine::Player> colour_of(std::string_view word) {
    const auto text = lower(word);
    if (text == "b" || text == "black") return engine::Player::first;
    if (text == "w" || text == "white") return engine::Player::second;
    return std::nullopt;
}

// Quoted in an error message, so that a megabyte of noise does not come back.
std::string_view excerpt(std::string_view word) { return word.substr(0, 60); }

template <class T>
T number_in(std::string_view text, std::string_view what, std::string_view kind, T least, T most) {
    std::optional<T> value;
    try {
        value = engine::parse_number<T>(text);
    } catch (const engine::Error&) {
        engine::fail("{} must be {} in {}..{}, not {}", what, kind, least, most, excerpt(text));
    }
    if (*value < least || *value > most)
        engine::fail("{} must lie in {}..{}, not {}", what, least, most, excerpt(text));
    return *value;
}

}  // namespace

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    return result;
}

Words::Words(std::string_view text) {
    std::istringstream in{std::string(text)};
    for (std::string word; in >> word;) words_.push_back(word);
}

std::string_view Words::take(std::string_view what) {
    if (empty()) engine::fail("{} is missing", what);
    return words_[at_++];
}

int Words::whole(std::string_view what, int least, int most) {
    return number_in(take(what), what, "a whole number", least, most);
}

double Words::number(std::string_view what, double least, double most) {
    return number_in(take(what), what, "a number", least, most);
}

bool Words::yes_or_no(std::string_view what) {
    const auto text = lower(take(what));
    if (text == "true" || text == "1" || text == "on" || text == "yes") return true;
    if (text == "false" || text == "0" || text == "off" || text == "no") return false;
    engine::fail("{} must be true or false, not {}", what, excerpt(text));
}

engine::Player Words::colour() {
    const auto text = take("the colour");
    if (const auto player = colour_of(text)) return *player;
    engine::fail("the colour is b, w, black or white, not {}", excerpt(text));
}

bool Words::at_colour() const { return !empty() && colour_of(peek()); }

bool Words::at_number() const {
    return !empty() && peek().find_first_not_of("0123456789.") == std::string::npos;
}

std::string Words::rest() const {
    std::string text;
    for (std::size_t i = at_; i < words_.size(); ++i)
        text.append(text.empty() ? "" : " ").append(words_[i]);
    return text;
}

void Words::finish() const {
    if (!empty()) engine::fail("nothing more was expected, but {} came", excerpt(peek()));
}

}  // namespace protocols
