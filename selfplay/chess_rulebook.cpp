#include <fmt/format.h>

#include <array>
#include <sstream>

#include "engine/base/error.h"
#include "engine/chess/chess.h"
#include "engine/chess/pgn.h"
#include "engine/chess/san.h"
#include "selfplay/line_openings.h"
#include "selfplay/rulebook.h"

namespace selfplay {

using chess::Chess;

// Engines of xboard's day may answer in SAN.
template <>
struct Manner<Chess> {
    static std::optional<engine::Move> read(const Chess& game, std::string_view text) {
        if (const auto move = game.move_from_text(text)) return move;
        return chess::move_from_san(game.position(), text);
    }
    static std::string ending(const Chess& game) { return std::string(chess::text(game.ending())); }
    static bool may_claim_win(const Chess&) { return false; }
};

namespace {

Chess start_from(const std::string& text) {
    return text.empty() ? Chess() : Chess::from_text(text);
}

std::unique_ptr<Referee> referee_from(const std::string& start) {
    return std::make_unique<GameReferee<Chess>>(start_from(start));
}

// A FEN, or an EPD line, whose operations are left out.
std::optional<Opening> opening_of_line(std::string_view line) {
    std::istringstream words{std::string(line)};
    std::string fen;
    constexpr int fields_of_epd = 4;
    int fields = 0;
    for (std::string word; fields < fields_of_epd && words >> word; ++fields)
        fen += (fields == 0 ? "" : " ") + word;
    if (fields < fields_of_epd || fen[0] == '#') return std::nullopt;
    int half_moves = 0, move = 1;
    if (!(words >> half_moves >> move)) half_moves = 0, move = 1;
    return Opening{fmt::format("{} {} {}", fen, half_moves, move), {}};
}

class ChessRulebook final : public Rulebook {
   public:
    std::unique_ptr<Referee> referee(const std::string& start) const override {
        return referee_from(start);
    }
    GameSetup setup(const std::string& start) const override {
        GameSetup setup;
        setup.game = "chess";
        setup.start = start;
        setup.chess960 = start_from(start).chess960();
        return setup;
    }
    std::vector<Opening> openings(const std::filesystem::path& path, int plies) const override;
    std::string to_text(const GameRecord& record) const override;
    std::string_view extension() const override { return "pgn"; }
    int usual_move_limit() const override { return 0; }
};

bool is_pgn(std::filesystem::path path) {
    if (path.extension() == ".gz") path.replace_extension();
    return path.extension() == ".pgn";
}

Opening opening_of(const chess::pgn::Record& record) {
    Opening opening;
    if (record.start != Chess()) opening.start = record.start.to_text();
    auto game = record.start;
    for (const auto move : record.main_line()) {
        opening.moves.push_back(game.move_to_text(move));
        game.play(move);
    }
    return opening;
}

// The next game that can be read; those that cannot are left out.
std::optional<chess::pgn::Record> next_game(chess::pgn::Reader& reader) {
    for (;;) {
        try {
            return reader.next();
        } catch (const engine::Error&) {
            continue;
        }
    }
}

std::vector<Opening> openings_of_pgn(const std::filesystem::path& path, int plies) {
    const auto file = chess::pgn::open(path);
    chess::pgn::Reader reader(*file);
    std::vector<Opening> openings;
    while (const auto record = next_game(reader))
        if (auto opening = playable(opening_of(*record), plies, referee_from))
            openings.push_back(std::move(*opening));
    if (openings.empty()) engine::fail("{}: holds no game to begin with", path.string());
    return openings;
}

std::vector<Opening> ChessRulebook::openings(const std::filesystem::path& path, int plies) const {
    if (is_pgn(path)) return openings_of_pgn(path, plies);
    return openings_of_lines(path, plies, opening_of_line, referee_from);
}

std::string ChessRulebook::to_text(const GameRecord& record) const {
    constexpr std::array<std::string_view, 4> results{"*", "1/2-1/2", "1-0", "0-1"};
    const auto start = start_from(record.start);
    auto game = start;
    std::vector<engine::Move> moves;
    for (const auto& text : record.moves) {
        const auto move = game.move_from_text(text);
        if (!move) engine::fail("game {}: illegal move {}", record.index + 1, text);
        moves.push_back(*move);
        game.play(*move);
    }
    auto ending = record.reason;
    if (!record.detail.empty()) ending += ": " + record.detail;
    return chess::pgn::to_text(
        chess::pgn::record_of(start, moves, results[static_cast<std::size_t>(record.outcome)],
                              {{"Event", record.event},
                               {"Round", std::to_string(record.index + 1)},
                               {"White", record.name_of(engine::Player::first)},
                               {"Black", record.name_of(engine::Player::second)},
                               {"Termination", ending}}));
}

}  // namespace

std::unique_ptr<Rulebook> chess_rulebook() { return std::make_unique<ChessRulebook>(); }

}  // namespace selfplay
