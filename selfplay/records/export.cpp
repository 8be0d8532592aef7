#include "selfplay/records/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/games.h"
#include "engine/go/score.h"
#include "selfplay/records/segment.h"
#include "selfplay/rulebook.h"

namespace selfplay::records {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> segments_of(const fs::path& path) {
    if (!fs::is_directory(path)) return {path};
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(path))
        if (entry.path().extension() == ".games") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    if (found.empty() && fs::is_directory(path / "games")) return segments_of(path / "games");
    return found;
}

std::unique_ptr<Rulebook> rulebook_for(const Game& game) {
    if (game.game == "chess") return chess_rulebook();
    if (game.game == "shogi") return shogi_rulebook("CSARule27");
    const auto start = go::Go::from_text(game.start);
    GoConditions conditions;
    conditions.size = start.size();
    conditions.komi = start.komi().points();
    conditions.rules = go::describe(start.rules());
    if (start != go::Go(start.size(), start.komi(), start.rules()))
        engine::fail("a game of Go that does not begin with an empty board");
    return go_rulebook(conditions, false);
}

std::string score_text(const Game& game) {
    if (game.owners.empty()) return {};
    go::Score score;
    score.lead_halves = static_cast<int>(game.lead * 2);
    return score.text();
}

// The moves as text; `played` is the game after them.
template <engine::Game G>
std::vector<std::string> moves_of(const Game& game, G played) {
    std::vector<std::string> texts;
    for (const auto& turn : game.turns) {
        if (!played.legal_moves().contains(turn.move))
            engine::fail("a record with an illegal move, number {}", texts.size() + 1);
        texts.push_back(played.move_to_text(turn.move));
        played.play(turn.move);
    }
    return texts;
}

std::vector<std::string> moves_of(const Game& game) {
    return engine::Games::visit(
        game.game, [&]<class G>() { return moves_of<G>(game, G::from_text(game.start)); });
}

// How the rules call the end that they brought about.
std::string reason_by_rules(const Rulebook& rulebook, const GameRecord& record) {
    const auto referee = rulebook.referee(record.start);
    for (const auto& move : record.moves) referee->play(move);
    return referee->verdict().reason;
}

template <engine::Game G>
std::string best_of(const Game& game, const Turn& turn, const G& position) {
    constexpr std::size_t most = 5;
    const auto shares = game.policy(turn);
    std::vector<Share> best(shares.begin(), shares.end());
    std::stable_sort(best.begin(), best.end(),
                     [](const Share& a, const Share& b) { return a.share > b.share; });
    std::string text;
    for (std::size_t i = 0; i < std::min(best.size(), most); ++i)
        text += fmt::format("  {} {:.1f} %", position.move_to_text(best[i].move),
                            best[i].share / 655.35);
    return text;
}

}  // namespace

bool holds_games(const fs::path& path) {
    if (fs::is_directory(path)) return true;
    std::ifstream file(path, std::ios::binary);
    std::string start(4, '\0');
    file.read(start.data(), 4);
    return file && is_segment(start);
}

std::vector<Game> read_games(const fs::path& path, std::vector<std::string>& damage) {
    std::vector<Game> games;
    for (const auto& file : segments_of(path)) {
        auto segment = unpack(engine::read_file(file));
        if (!segment.damage.empty())
            damage.push_back(fmt::format("{}: {}", file.string(), segment.damage));
        std::move(segment.games.begin(), segment.games.end(), std::back_inserter(games));
    }
    if (games.empty()) engine::fail("{}: holds no self-play game", path.string());
    return games;
}

GameRecord match_record(const Game& game, int index) {
    GameRecord record;
    record.index = index;
    record.names = {"sanban", "sanban"};
    record.event = fmt::format("sanban self-play, {} steps of training", game.steps);
    if (game.game != "go") record.start = game.start;
    record.moves = moves_of(game);
    record.outcome = game.outcome;
    record.score = score_text(game);
    if (game.ending == Ending::resigned || game.ending == Ending::agreed) {
        record.reason = name_of(game.ending);
    } else if (game.ending == Ending::move_limit) {
        record.reason = record.score.empty() ? "move limit" : "score";
        record.detail = fmt::format("cut off after {} moves", record.moves.size());
    } else {
        record.reason = reason_by_rules(*rulebook_for(game), record);
    }
    return record;
}

std::string to_text(const Game& game, int index) {
    return rulebook_for(game)->to_text(match_record(game, index));
}

std::string_view text_extension(std::string_view game) {
    return game == "go" ? "sgf" : game == "chess" ? "pgn" : "csa";
}

std::string summary(const Game& game) {
    const char* result = game.outcome == engine::Outcome::first_wins    ? "1-0"
                         : game.outcome == engine::Outcome::second_wins ? "0-1"
                                                                        : "draw";
    const auto score = score_text(game);
    return fmt::format("{} {}{}{} after {} moves, {}", game.game, result, score.empty() ? "" : " ",
                       score, game.turns.size(), name_of(game.ending));
}

std::string turns_text(const Game& game) {
    return engine::Games::visit(game.game, [&]<class G>() {
        std::string text;
        G position = G::from_text(game.start);
        int number = 0;
        for (const auto& turn : game.turns) {
            if (!position.legal_moves().contains(turn.move))
                engine::fail("a record with an illegal move, number {}", number + 1);
            text += fmt::format("{:4} {:6} {:+.3f} {:6}{}\n", ++number,
                                position.move_to_text(turn.move), turn.value, turn.simulations,
                                best_of(game, turn, position));
            position.play(turn.move);
        }
        return text + position.to_text() + '\n';
    });
}

}  // namespace selfplay::records
