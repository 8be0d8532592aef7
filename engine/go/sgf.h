// SGF, FF[3] and FF[4] (red-bean.com/sgf): reading and writing game trees, and the game that a
// tree's main line holds. Reading keeps every property it does not know, so that a file survives
// a round trip; text is UTF-8 inside whatever CA says. No depth of nesting exhausts the stack.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/go/go.h"

namespace go::sgf {

struct Property {
    std::string id;                   // upper case: "B", "AB", "KM"
    std::vector<std::string> values;  // unescaped, UTF-8
};

struct Node {
    std::vector<Property> properties;
    std::vector<std::uint32_t> children;  // indices into Tree::nodes, main line first

    const Property* find(std::string_view id) const;
    // The first value of the property, or empty.
    std::string_view value(std::string_view id) const;
};

// Nodes in the order of the text; node 0 is the root.
struct Tree {
    std::vector<Node> nodes;
};

// All game trees of a collection. Fails with engine::Error that says line and column.
std::vector<Tree> parse(std::string_view text);
std::string to_text(const Tree& tree);

// One turn of a main line, already checked against the rules.
struct Turn {
    Player player;
    Move move;
    bool operator==(const Turn&) const = default;
};

struct Record {
    Go start;                 // after set-up stones and handicap, before the first move
    std::vector<Turn> turns;  // players need not alternate
    Go end;
    std::string result;  // RE as written
};

// Plays through the tree's main line, at most `most_moves` of it. Komi, rules, size and handicap
// from the root (RU by name where known). Fails with engine::Error naming the move number when
// a move is illegal or malformed.
Record main_line(const Tree& tree, int most_moves = 1 << 20);

// A tree of one line; `facts` are root properties such as {"PB", "sanban"}.
Tree tree_of(const Go& start, const std::vector<Turn>& turns, std::string_view result,
             const std::vector<Property>& facts = {});

// Reads the whole file (plain or .gz); fails naming the file.
std::string read_file(const std::filesystem::path& path);

}  // namespace go::sgf
