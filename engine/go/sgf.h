// SGF, FF[1] to FF[4] (red-bean.com/sgf): reading and writing game trees, and the game that a
// tree's main line holds. Reading keeps every property it does not know, so that a file survives
// a round trip. A tree in memory is UTF-8 whatever charset it came in, and its CA says so. No
// depth of nesting exhausts the stack, and no tree of over 256 MiB in memory is built.
//
// Reading is lenient where nothing is lost: text around the trees, an empty variation, lower-case
// letters in property names (FF[3]), bytes without meaning (replaced by U+FFFD). It fails where
// moves might be lost: a tree that does not end, a value that is not closed, a property without
// value, a node after its variations.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/go/go.h"

namespace go::sgf {

struct Property {
    std::string id;  // upper case: "B", "AB", "KM"
    // Unescaped when `id` is a property of FF[1] to FF[4], else exactly as they stand in the file,
    // escapes included: only its author knows whether a colon divides such a value.
    std::vector<std::string> values;

    bool operator==(const Property&) const = default;
};

struct Node {
    std::vector<Property> properties;
    std::vector<std::uint32_t> children;  // indices into Tree::nodes, main line first

    const Property* find(std::string_view id) const;
    // The first value of the property, or empty.
    std::string_view value(std::string_view id) const;

    bool operator==(const Node&) const = default;
};

// Nodes in the order of the text, parents before children; node 0 is the root.
struct Tree {
    std::vector<Node> nodes;

    bool operator==(const Tree&) const = default;
};

// Takes the trees of a collection one after the other, so that only one need be held at a time.
//
// CA of the root names the charset. Without it (or with one that is not known) text is UTF-8, and
// where that is not well-formed, ISO-8859-1, the standard's own default. A byte order mark of
// UTF-8 or UTF-16 outweighs CA. `text` must outlive the reader.
class GameReader {
   public:
    explicit GameReader(std::string_view text);
    // A string that would be gone before the first tree is read.
    template <std::same_as<std::string> Temporary>
    explicit GameReader(Temporary&& text) = delete;
    GameReader(const GameReader&) = delete;
    GameReader& operator=(const GameReader&) = delete;

    // Empty after the last tree. Fails with line and column (from 1, in bytes); the next call then
    // goes on with the next line that begins a tree, "(;".
    std::optional<Tree> next();
    // Where the tree that next() returned, or failed in, begins.
    std::int64_t line() const { return tree_line_; }

   private:
    void advance_to(std::size_t at);

    std::string converted_;
    std::string_view text_;
    bool is_utf8_ = false;
    std::size_t at_ = 0;
    // The line of `at_`, and where it begins.
    std::int64_t line_ = 1;
    std::size_t line_start_ = 0;
    std::int64_t tree_line_ = 1;
};

// All game trees of a collection. Fails with engine::Error that says line and column, also when
// there is no tree, or when all take over 1 GiB (see GameReader).
std::vector<Tree> parse(std::string_view text);

// In UTF-8, whatever CA the root says; ends with a line break. Empty for a tree without nodes.
std::string to_text(const Tree& tree);

// One turn of a main line, already checked against the rules.
struct Turn {
    Player player;
    Move move;
    bool operator==(const Turn&) const = default;
};

// Stones set up in the middle of a main line start the record anew: what was played before them
// counts in moves_before and is gone otherwise.
struct Record {
    Go start;                 // after set-up stones and handicap, before the first move
    std::vector<Turn> turns;  // players need not alternate
    Go end;
    std::string result;    // RE as written
    int moves_before = 0;  // of the main line, before `start`
    // What was read other than it stands, one line each ("KM[375]: komi 7.5").
    std::vector<std::string> notes;
};

// Plays through the tree's main line, at most `most_moves` of it, with the set-up that follows the
// last of them. Fails with engine::Error naming the move number when a move is illegal or
// malformed, when the game is not Go, its board not square or not of 2 to 25 lines, and past 65 536
// moves or 1 024 nodes of set-up: no game, and it could be made to take hours.
//
// RU: a name or JSON of go/rules.h, else (or without RU) Chinese rules. KM: without it the rules'
// usual komi. A whole number of 200 or more without decimal point is in hundredths, as the Fox
// server writes (KM[650] is 6.5); a quarter point is counted in zi and doubled (KM[3.75], KM[375]
// are 7.5); anything else off the half points is rounded to the nearest, and what is no number
// within ±1000 gives the rules' usual komi. HA without AB puts the stones on GTP's fixed points if
// White moves first. A pass is B[], or B[tt] up to 19x19.
Record main_line(const Tree& tree, int most_moves = 1 << 20);

// Whether it is a game between two from the empty board on, without handicap, in turn.
bool is_even(const Record& record);

// How RE says that it ended; ongoing where it does not.
Outcome outcome_of(const Record& record);

// A tree of one line; `facts` are root properties such as {"PB", {"sanban"}}, and stand in for
// those made here. `comments`: to the turns, in order, as far as they go.
Tree tree_of(const Go& start, const std::vector<Turn>& turns, std::string_view result,
             const std::vector<Property>& facts = {},
             const std::vector<std::string>& comments = {});

// Reads the whole file (plain or .gz); fails naming the file.
std::string read_file(const std::filesystem::path& path);

}  // namespace go::sgf
