// Small questions about text: ASCII case and blanks, UTF-8. No locale, no allocation unless a
// string is returned; for everyone.
#pragma once

#include <string>
#include <string_view>

namespace engine {

constexpr bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
constexpr bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr char to_lower(char c) { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }

// Without blanks at either end.
std::string_view trimmed(std::string_view text);

bool is_ascii(std::string_view text);
// Well-formed by RFC 3629: shortest forms only, no surrogates, nothing past U+10FFFF.
bool is_utf8(std::string_view text);
// The same text with U+FFFD for every byte that is no part of well-formed UTF-8.
std::string repaired_utf8(std::string_view text);

// Takes the next word, up to a blank, off the text.
std::string_view take_word(std::string_view& text);
// Takes the next operation of an EPD line, up to a semicolon outside quotes, off the text.
std::string_view take_operation(std::string_view& text);
// Without a quote at either end.
std::string_view unquoted(std::string_view text);

// At most `most` characters of a text from outside, fit for one line of an error message:
// what is not printable ASCII shows as '?', what is left out as "...".
std::string excerpt(std::string_view text, std::size_t most = 40);

}  // namespace engine
