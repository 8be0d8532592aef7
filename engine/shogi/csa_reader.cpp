#include <charconv>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/shogi/csa.h"
#include "engine/shogi/csa_words.h"
#include "engine/shogi/sfen.h"
#include "engine/shogi/usi.h"

namespace shogi::csa {
namespace {

using engine::excerpt;
using engine::fail;

// The start of a game as its P lines tell it.
class SetUp {
   public:
    bool begun() const { return begun_; }

    void line(std::string_view text) {
        begun_ = true;
        const char what = text.size() < 2 ? ' ' : text[1];
        if (what == 'I')
            even(text.substr(2));
        else if (what >= '1' && what <= '9')
            rank(text.substr(2), what - '1');
        else if (const auto player = player_of(what))
            pieces(text.substr(2), *player);
        else
            fail("\"{}\" sets up nothing", excerpt(text));
    }

    Shogi finish(Player mover) {
        Position position = begun_ ? position_ : Position::start();
        position.set_to_play(mover);
        check(position);
        return Shogi(position);
    }

   private:
    // The usual start but for pieces left out, as in "82HI22KA".
    void even(std::string_view left_out) {
        position_ = Position::start();
        for (; left_out.size() >= 4; left_out.remove_prefix(4)) {
            const auto square = square_of(left_out);
            if (!square || position_.at(*square).empty())
                fail("nothing to leave out at {}", excerpt(left_out));
            position_.remove(*square);
        }
    }

    void rank(std::string_view text, int rank) {
        for (int file = board_size - 1; file >= 0 && !text.empty(); --file) {
            const auto cell = text.substr(0, 3);
            text.remove_prefix(cell.size());
            if (const auto player = player_of(cell[0]))
                put(square_at(file, rank), *player, cell.substr(1));
        }
    }

    void pieces(std::string_view text, Player player) {
        for (; text.size() >= 4; text.remove_prefix(4)) {
            if (text.substr(0, 4) == "00AL")
                all_others(player);
            else if (text.substr(0, 2) == "00")
                into_hand(player, kind_named(text.substr(2, 2)));
            else if (const auto square = square_of(text))
                put(*square, player, text.substr(2, 2));
            else
                fail("no square: {}", excerpt(text));
        }
    }

    void put(int square, Player player, std::string_view name) {
        const Kind kind = kind_named(name);
        if (kind == Kind::none) fail("no piece: {}", excerpt(name));
        if (!position_.at(square).empty()) fail("two pieces on {}", to_usi(square));
        position_.put(square, {player, kind});
    }

    void into_hand(Player player, Kind kind) {
        if (kind == Kind::none || kind > Kind::rook) fail("no piece for the hand");
        const int pieces = position_.hand(player, kind) + 1;
        if (pieces > full_set[index(kind)]) fail("too many pieces in hand");
        position_.set_hand(player, kind, pieces);
    }

    // What a full set has more than the board and both hands.
    void all_others(Player player) {
        for (const Kind kind : hand_kinds) {
            const Bitboard on_board =
                position_.of(kind) | (can_promote(kind) ? position_.of(promoted(kind)) : 0);
            const int used = count(on_board) + position_.hand(~player, kind);
            position_.set_hand(player, kind, std::max(0, full_set[index(kind)] - used));
        }
    }

    Position position_;
    bool begun_ = false;
};

// One game, line after line.
class GameReader {
   public:
    void line(std::string_view text) {
        switch (text[0]) {
            case '\'':
                return comment(text.substr(1));
            // Thoughts of an engine that forgot the mark of a comment.
            case '*':
                return comment(text);
            case 'V':
            case '#':
                return;
            case 'N':
                return name(text);
            case '$':
                return fact(text.substr(1));
            default:
                return statements(text);
        }
    }

    Record finish() {
        if (!writer_) start(Player::first);
        return std::move(record_);
    }

   private:
    Node& node() { return writer_ ? writer_->node() : record_.nodes[0]; }

    void comment(std::string_view text) {
        auto& comment = node().comment;
        if (!comment.empty()) comment += '\n';
        comment += text;
    }

    void name(std::string_view text) {
        const auto player = text.size() < 2 ? std::nullopt : player_of(text[1]);
        if (!player) fail("no player: {}", excerpt(text));
        (*player == Player::first ? record_.black : record_.white) = text.substr(2);
    }

    void fact(std::string_view text) {
        const auto colon = text.find(':');
        const auto value = colon == text.npos ? std::string_view() : text.substr(colon + 1);
        record_.facts.push_back({std::string(text.substr(0, colon)), std::string(value)});
    }

    // Several may stand in one line, with commas between.
    void statements(std::string_view text) {
        while (!text.empty()) {
            const auto comma = text.find(',');
            statement(engine::trimmed(text.substr(0, comma)), text);
            text.remove_prefix(comma == text.npos ? text.size() : comma + 1);
        }
    }

    void statement(std::string_view text, std::string_view line) {
        if (text.empty()) return;
        if (text[0] == 'P' && !writer_) return set_up_.line(line_of_pieces(text, line));
        if (text[0] == 'T') return time(text.substr(1));
        if (text[0] == '%') return end(text.substr(1));
        const auto player = player_of(text[0]);
        if (!player) fail("not understood: {}", excerpt(text));
        if (text.size() == 1 && !writer_) return start(*player);
        if (!writer_) start(*player);
        move(text);
    }

    // A rank ends with blanks that are squares.
    static std::string_view line_of_pieces(std::string_view text, std::string_view line) {
        return line.find(',') == line.npos ? line : text;
    }

    void start(Player mover) {
        record_.start = set_up_.finish(mover);
        writer_.emplace(record_);
    }

    void move(std::string_view text) {
        const auto move = parse_csa_move(writer_->position(), text);
        if (!move) fail("move {} ({}) is none", writer_->number(), excerpt(text));
        writer_->play(*move, excerpt(text));
    }

    // Whole seconds; version 3 has fractions.
    void time(std::string_view text) {
        int seconds = 0;
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), seconds);
        if (status == std::errc{} && seconds >= 0 && writer_ && writer_->number() > 1 &&
            !node().seconds)
            node().seconds = seconds;
    }

    void end(std::string_view text) {
        if (!writer_) start(Player::first);
        if (text == "+ILLEGAL_ACTION" || text == "-ILLEGAL_ACTION") {
            const bool own = player_of(text[0]) == writer_->position().to_play();
            node().ending = own ? Ending::foul : Ending::foul_of_opponent;
            return;
        }
        const auto* const found =
            std::find_if(endings.begin(), endings.end(),
                         [text](const NamedEnding& ending) { return ending.name == text; });
        if (found == endings.end()) fail("no ending: %{}", excerpt(text));
        node().ending = found->ending;
    }

    Record record_;
    SetUp set_up_;
    std::optional<RecordWriter> writer_;
};

// The next line, without its end; takes it off `rest`.
std::string_view take_line(std::string_view& rest) {
    const auto end = rest.find('\n');
    auto line = rest.substr(0, end);
    rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
}

class FileReader {
   public:
    void read(std::string_view text) {
        while (!text.empty()) {
            ++line_;
            const auto line = take_line(text);
            if (line == "/")
                finish();
            else if (!engine::trimmed(line).empty())
                (game_ ? *game_ : game_.emplace()).line(line);
        }
        finish();
    }

    std::vector<Record> games;
    int line() const { return line_; }

   private:
    void finish() {
        if (game_) games.push_back(game_->finish());
        game_.reset();
    }

    std::optional<GameReader> game_;
    int line_ = 0;
};

}  // namespace

std::vector<Record> parse(std::string_view bytes) {
    FileReader reader;
    try {
        reader.read(japanese_text(bytes));
    } catch (const engine::Error& error) {
        fail("CSA: game {}, line {}: {}", reader.games.size() + 1, reader.line(), error.what());
    }
    return std::move(reader.games);
}

}  // namespace shogi::csa
