#include "engine/chess/pgn_lexer.h"

#include <sstream>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace chess::pgn {

namespace {

bool is_blank(int letter) { return letter >= 0 && engine::is_blank(static_cast<char>(letter)); }
bool is_digit(int letter) { return letter >= 0 && engine::is_digit(static_cast<char>(letter)); }
bool is_name(int letter) {
    return letter == '_' || is_digit(letter) || (letter >= 'a' && letter <= 'z') ||
           (letter >= 'A' && letter <= 'Z');
}

}  // namespace

int Lexer::take() {
    const int letter = peek();
    if (letter == end) return end;
    buffer_.sbumpc();
    ++place_.column;
    if (letter == '\n') place_ = {place_.line + 1, 1};
    return letter;
}

void Lexer::skip_line() {
    while (peek() != end && peek() != '\n') take();
}

void Lexer::skip_to_tags() {
    bool blank_line = false;
    while (peek() != end) {
        if (place_.column == 1 && blank_line && peek() == '[') return;
        blank_line = place_.column == 1 && (peek() == '\n' || peek() == '\r');
        skip_line();
        take();
    }
}

// Skips one thing that means nothing; false when there is none.
bool Lexer::skip_noise() {
    const int letter = peek();
    if (letter == '%' && place_.column == 1) return skip_line(), true;
    const bool byte_order_mark = letter >= 0x80;
    if (!is_blank(letter) && letter != '.' && !byte_order_mark) return false;
    take();
    return true;
}

// The text up to `closing`, its blanks and line breaks made one space.
std::string Lexer::until(char closing, std::string_view what, Place from) {
    std::string text;
    for (;;) {
        const int letter = take();
        if (letter == closing) break;
        if (letter == end) throw Refusal{fmt::format("{} without its end", what), from};
        if (!is_blank(letter))
            text += static_cast<char>(letter);
        else if (!text.empty() && text.back() != ' ')
            text += ' ';
    }
    if (text.ends_with(' ')) text.pop_back();
    return text;
}

Token Lexer::tag(Place place) {
    Token token{Token::Kind::tag, {}, {}, place};
    take();
    while (is_blank(peek())) take();
    while (is_name(peek())) token.text += static_cast<char>(take());
    while (is_blank(peek())) take();
    if (token.text.empty() || take() != '"')
        throw Refusal{"a tag is not like [Name \"value\"]", place};
    for (int letter = take(); letter != '"'; letter = take()) {
        if (letter == '\\' && (peek() == '"' || peek() == '\\')) letter = take();
        if (letter == end || letter == '\n')
            throw Refusal{"the value of a tag has no closing quote", place};
        token.value += static_cast<char>(letter);
    }
    while (is_blank(peek())) take();
    if (take() != ']') throw Refusal{"a tag has no closing bracket", place};
    return token;
}

// Moves, move numbers, results and signs; dots are part of "e.p." only.
Token Lexer::word(Place place) {
    Token token{Token::Kind::word, {}, {}, place};
    const bool number = is_digit(peek());
    constexpr std::string_view stops = "()[]{};$";
    while (peek() > ' ' && stops.find(static_cast<char>(peek())) == stops.npos &&
           !(number && peek() == '.'))
        token.text += static_cast<char>(take());
    while (token.text.ends_with('.')) token.text.pop_back();
    if (token.text.empty()) throw Refusal{"unexpected character", place};
    return token;
}

Token Lexer::nag(Place place) {
    Token token{Token::Kind::nag, {}, {}, place};
    take();
    while (is_digit(peek())) token.text += static_cast<char>(take());
    return token;
}

Token Lexer::next() {
    while (skip_noise()) {
    }
    const Place place = place_;
    switch (peek()) {
        case end:
            return {Token::Kind::end, {}, {}, place};
        case '[':
            return tag(place);
        case '$':
            return nag(place);
        case '{':
            take();
            return {Token::Kind::comment, until('}', "a comment", place), {}, place};
        case ';': {
            take();
            std::string text;
            while (peek() != end && peek() != '\n') text += static_cast<char>(take());
            std::istringstream line(text + '\n');
            return {Token::Kind::comment, Lexer(line).until('\n', "a comment", place), {}, place};
        }
        case '(':
            take();
            return {Token::Kind::open, {}, {}, place};
        case ')':
            take();
            return {Token::Kind::close, {}, {}, place};
        default:
            return word(place);
    }
}

}  // namespace chess::pgn
