// The tokens of PGN, cut from a stream: the lower half of pgn::Reader, for it alone.
#pragma once

#include <cstdint>
#include <istream>
#include <streambuf>
#include <string>
#include <string_view>

namespace chess::pgn {

struct Place {
    int line = 1, column = 1;
};

struct Token {
    enum class Kind : std::uint8_t { end, tag, word, comment, nag, open, close };
    Kind kind = Kind::end;
    std::string text;   // of a tag: its name
    std::string value;  // of a tag
    Place place;
};

// Thrown inside the reader only, which says which game it is about: a message and its place.
struct Refusal {
    std::string message;
    Place place;
};

// Cuts a stream into tokens.
class Lexer {
   public:
    explicit Lexer(std::istream& in) : buffer_(*in.rdbuf()) {}

    Token next();
    // To the first line that starts a new section of tags.
    void skip_to_tags();

   private:
    static constexpr int end = std::streambuf::traits_type::eof();

    // The next byte without taking it, or `end`.
    int peek() { return buffer_.sgetc(); }
    int take();
    void skip_line();
    bool skip_noise();
    std::string until(char closing, std::string_view what, Place from);
    Token tag(Place place);
    Token word(Place place);
    Token nag(Place place);

    std::streambuf& buffer_;
    Place place_;
};

}  // namespace chess::pgn
