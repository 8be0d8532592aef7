// Portable game notation: reading collections of any size one game at a time, and writing.
//
// A record is a tree of moves with comments and NAGs; every move in it has been checked against
// the rules. Text is handed on in the bytes it came in, blanks and line breaks made one space.
// Nothing here recurses, so that no file can exhaust the stack.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/chess/chess.h"

namespace chess::pgn {

struct Tag {
    std::string name, value;
    bool operator==(const Tag&) const = default;
};

struct Node {
    Move move{};                          // node 0 has none
    std::vector<std::uint32_t> children;  // indices into Record::nodes, main line first
    std::vector<std::uint8_t> nags;       // $1 is !, $2 is ? …
    std::string comment_before;           // at the beginning of a variation
    std::string comment;                  // behind the move; that of node 0 precedes the game
    bool operator==(const Node&) const = default;
};

struct Record {
    std::vector<Tag> tags;  // as in the file; FEN, SetUp and Variant have been made `start`
    Chess start;
    std::vector<Node> nodes = std::vector<Node>(1);
    std::string result = "*";  // "1-0", "0-1", "1/2-1/2", "*"
    bool operator==(const Record&) const = default;

    // Empty when there is no such tag.
    std::string_view tag(std::string_view name) const;
    std::vector<Move> main_line() const;
};

// A record of one line.
Record record_of(const Chess& start, const std::vector<Move>& moves, std::string_view result,
                 std::vector<Tag> tags = {});

// Variations nested deeper are refused.
inline constexpr int deepest_variation = 1000;

class Reader {
   public:
    // Reads from `in` as games are asked for; `in` must outlive the reader.
    explicit Reader(std::istream& in);
    ~Reader();
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    // The next game, empty at the end. A game may lack tags, or its result at the end of a file;
    // moves may be SAN or UCI; null moves end the variation they are in. Fails with engine::Error
    // naming game, line and column; the call after that reads the game that follows.
    std::optional<Record> next();
    // Games begun so far, those refused among them.
    int games() const;

   private:
    class Parser;
    std::unique_ptr<Parser> parser_;
};

// The first game of a text; fails when there is none.
Record read_one(std::string_view text);

// Opens a file, plain or .gz; fails naming it.
std::unique_ptr<std::istream> open(const std::filesystem::path& path);

// Export format: the seven tags of the roster first ("?" where unknown), lines under 80 columns,
// a blank line at the end. Braces in comments become parentheses.
std::string to_text(const Record& record);

}  // namespace chess::pgn
