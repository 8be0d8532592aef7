// A game of shogi as written down, whatever the notation: a tree of moves, each of which has been
// checked against the rules, with comments, clock times and how each line ended. What csa.h and
// kif.h read and write. Text is UTF-8.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/shogi/shogi.h"

namespace shogi {

// How a line ended, seen by the player whose turn it was.
enum class Ending : std::uint8_t {
    none,  // it just stops
    resignation,
    mate,
    repetition,
    impasse,      // a draw by agreement or count
    declaration,  // the mover declared the win
    draw,
    move_limit,  // a draw
    time_up,
    foul,              // the mover's
    foul_of_opponent,  // the mover wins
    forfeit,           // the mover did not show up
    interrupted,
    taken_back,
    error,
    no_mate,  // of a problem
};

struct Fact {
    std::string name, value;
    bool operator==(const Fact&) const = default;
};

struct Node {
    Move move{};                          // node 0 has none
    std::vector<std::uint32_t> children;  // indices into Record::nodes, main line first
    std::optional<int> seconds;           // that the move took
    std::string comment;           // lines without their line marks; node 0's precedes the game
    Ending ending = Ending::none;  // of the line that stops here
    bool operator==(const Node&) const = default;
};

struct Record {
    std::string black, white;  // names of the players
    std::vector<Fact> facts;   // other headings, named as the file names them
    Shogi start;
    std::vector<Node> nodes = std::vector<Node>(1);
    bool operator==(const Record&) const = default;

    std::vector<Move> main_line() const;
    // How the main line ended.
    Ending ending() const;
    // The game's result by its ending, or by the rules where the ending leaves it to them;
    // `ongoing` where neither knows.
    Outcome outcome() const;
};

// A record of one line.
Record record_of(const Shogi& start, const std::vector<Move>& moves, Ending ending);

// More moves than any record has; a reader refuses the game.
inline constexpr int most_record_moves = 10000;

// Writes moves into a record as a reader meets them, and jumps back for variations.
class RecordWriter {
   public:
    // Begins at the record's start; the record must outlive the writer.
    explicit RecordWriter(Record& record) : record_(record), position_(record.start.position()) {}

    const Position& position() const { return position_; }
    // The number of the move to come, the game's first being 1.
    int number() const { return static_cast<int>(path_.size()); }
    Node& node() { return record_.nodes[path_.back()]; }
    // The same move twice at a place is one. Fails, naming the move by `text` and its number, when
    // it is illegal.
    void play(Move move, std::string_view text);
    // Back to where that move of the line written last was to come, or of the main line where that
    // one is too short. Fails when both are.
    void go_back_to(int move_number);

   private:
    void step_to(std::uint32_t child);
    void step_back();

    Record& record_;
    Position position_;
    std::vector<std::uint32_t> path_{0};
    std::vector<Piece> captured_;  // by the moves of the path
};

// Text in UTF-8 of a file that is that, Shift_JIS or EUC-JP, without a byte order mark.
std::string japanese_text(std::string_view bytes);

}  // namespace shogi
