#include "engine/go/patterns.h"

#include <array>
#include <string>
#include <string_view>

namespace go {

namespace {

// Rows from the top, the move in the middle. X and O: the two sides, the mover either of them where
// the pattern is not the mover's alone; x: not X, o: not O; #: beyond the edge; ?: whatever.
struct Pattern {
    std::string_view points;
    bool movers_alone = false;  // the mover is X
};

constexpr Pattern patterns[] = {
    {"XOX...???"},        // hane that encloses
    {"XO....?.?"},        // hane that does not cut
    {"XO?X..x.?"},        // magari
    {"XOO...?.?", true},  // thin hane
    {".O.X....."},        // diagonal attachment
    {"XO?O.o?o?"},        // cut without protection
    {"XO?O.X???"},        // cut that was peeped at
    {"?X?O.Oooo"},        // push through
    {"OX?o.O???", true},  // cut of a knight's move
    {"X.?O.?###"},        // chase along the edge
    {"OX?X.O###"},        // blocks a cut at the edge
    {"?X?x.O###"},        // blocks a connection at the edge
    {"?XOx.x###"},        // descent to the edge
    {"?OXX.O###"},        // cut at the edge
};

std::string_view colours_of(char letter) {
    switch (letter) {
        case 'x':
            return ".O#";
        case 'o':
            return ".X#";
        case '?':
            return ".XO#";
        default:
            return {};
    }
}

std::uint16_t code_of(std::string_view points, bool x_is_black) {
    std::uint32_t code = 0, shift = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i == 4) continue;
        const bool black = points[i] == (x_is_black ? 'X' : 'O');
        const auto colour = points[i] == '.'   ? Colour::empty
                            : points[i] == '#' ? Colour::edge
                            : black            ? Colour::black
                                               : Colour::white;
        code |= static_cast<std::uint32_t>(colour) << shift;
        shift += 2;
    }
    return static_cast<std::uint16_t>(code);
}

// Calls action(points) for each way of making the letters definite.
template <class Action>
void expand(std::string points, const Action& action) {
    for (char& letter : points) {
        const auto colours = colours_of(letter);
        if (colours.empty()) continue;
        for (const char colour : colours) {
            letter = colour;
            expand(points, action);
        }
        return;
    }
    action(points);
}

std::string turned(std::string_view points, int symmetry) {
    std::string result(9, ' ');
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column) {
            const std::size_t y = symmetry & 1 ? 2 - row : row;
            const std::size_t x = symmetry & 2 ? 2 - column : column;
            result[symmetry & 4 ? 3 * x + y : 3 * y + x] = points[3 * row + column];
        }
    return result;
}

}  // namespace

const Patterns& Patterns::all() {
    static const Patterns patterns;
    return patterns;
}

Patterns::Patterns() {
    for (const auto& [points, movers_alone] : patterns)
        for (int symmetry = 0; symmetry < 8; ++symmetry)
            expand(turned(points, symmetry), [&, alone = movers_alone](std::string_view definite) {
                black_.set(code_of(definite, true));
                white_.set(code_of(definite, false));
                if (alone) return;
                black_.set(code_of(definite, false));
                white_.set(code_of(definite, true));
            });
}

}  // namespace go
