#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/base/error.h"
#include "engine/go/score.h"
#include "engine/go/sgf.h"
#include "selfplay/rulebook.h"

namespace selfplay {

namespace {

using engine::Outcome;
using go::Go;
using go::Point;

// Whether `player` has stones on all neighbours of the empty point: an eye, or as good as one.
bool surrounded(const Go& game, Point point, engine::Player player) {
    constexpr std::array<Point, 4> steps{Point{1, 0}, Point{-1, 0}, Point{0, 1}, Point{0, -1}};
    return std::all_of(steps.begin(), steps.end(), [&](Point step) {
        const Point next{point.x + step.x, point.y + step.y};
        const bool outside =
            next.x < 0 || next.y < 0 || next.x >= game.size() || next.y >= game.size();
        return outside || game.at(next) == player;
    });
}

class GoReferee final : public Referee {
   public:
    GoReferee(Go start, bool agree) : game_(std::move(start)), agree_(agree) {}

    engine::Player to_play() const override { return game_.to_play(); }

    Played play(std::string_view text) override {
        const auto move = game_.move_from_text(text);
        if (!move) return {{}, std::string(why_not(text))};
        auto written = game_.move_to_text(*move);
        game_.play(*move);
        return {std::move(written), {}};
    }

    std::vector<std::string> opening_moves() const override {
        std::vector<std::string> moves;
        for (const auto move : game_.legal_moves()) {
            const auto point = game_.point_of(move);
            if (point && !surrounded(game_, *point, game_.to_play()))
                moves.push_back(game_.move_to_text(move));
        }
        return moves;
    }

    Verdict verdict() const override {
        if (game_.no_result()) return {Outcome::draw, "no result", {}};
        if (game_.consecutive_passes() < 2) return {};
        const auto score = go::score(game_, dead_);
        return {score.outcome(), "score", score.text()};
    }

    bool wants_dead_stones() const override { return agree_ && !game_.no_result(); }

    void remove(std::span<const std::string> vertices) override {
        for (const auto& vertex : vertices) {
            const auto point = go::point_from_vertex(vertex, game_.size());
            if (point && game_.at(*point)) dead_.push_back(*point);
        }
    }

   private:
    std::string_view why_not(std::string_view text) const {
        const auto point = go::point_from_vertex(text, game_.size());
        return point ? game_.why_illegal(game_.move_at(*point)) : "not a vertex";
    }

    Go game_;
    bool agree_;
    std::vector<Point> dead_;
};

class GoRulebook final : public Rulebook {
   public:
    GoRulebook(const GoConditions& conditions, bool agree)
        : conditions_(conditions), agree_(agree), start_(start_of(conditions)) {}

    std::unique_ptr<Referee> referee(const std::string& start) const override {
        if (!start.empty()) engine::fail("a game of Go starts from moves, not from a position");
        return std::make_unique<GoReferee>(start_, agree_);
    }

    GameSetup setup(const std::string&) const override {
        GameSetup setup;
        setup.game = "go";
        setup.go = conditions_;
        return setup;
    }

    std::vector<Opening> openings(const std::filesystem::path& path, int plies) const override {
        std::vector<Opening> found;
        for (const auto& tree : go::sgf::parse(go::sgf::read_file(path)))
            if (auto moves = beginning(tree, plies)) found.push_back({{}, std::move(*moves)});
        if (found.empty())
            engine::fail("{}: no game begins with {} moves that fit the conditions", path.string(),
                         plies);
        return found;
    }

    std::string to_text(const GameRecord& record) const override;
    std::string_view extension() const override { return "sgf"; }
    int usual_move_limit() const override { return 3 * conditions_.size * conditions_.size; }

   private:
    // The tree's first moves, if they are as many and also legal in our game.
    std::optional<std::vector<std::string>> beginning(const go::sgf::Tree& tree, int plies) const;

    GoConditions conditions_;
    bool agree_;
    Go start_;
};

std::optional<std::vector<std::string>> GoRulebook::beginning(const go::sgf::Tree& tree,
                                                              int plies) const try {
    const auto record = go::sgf::main_line(tree, plies);
    if (record.start.size() != start_.size() ||
        record.turns.size() < static_cast<std::size_t>(plies))
        return std::nullopt;
    GoReferee game(start_, false);
    std::vector<std::string> moves;
    for (const auto& [player, move] : record.turns) {
        const auto text = record.start.move_to_text(move);
        if (player != game.to_play() || move == Go::pass || !game.play(text).objection.empty())
            return std::nullopt;
        moves.push_back(text);
    }
    return moves;
} catch (const engine::Error&) {
    return std::nullopt;
}

std::string result_text(const GameRecord& record) {
    if (record.outcome == Outcome::draw) return record.reason == "no result" ? "Void" : "0";
    if (record.reason == "score") return record.score;
    const char winner = record.outcome == Outcome::first_wins ? 'B' : 'W';
    if (record.reason == "resignation") return fmt::format("{}+R", winner);
    if (record.reason == "time") return fmt::format("{}+T", winner);
    return fmt::format("{}+F", winner);
}

std::string GoRulebook::to_text(const GameRecord& record) const {
    Go game = start_;
    std::vector<go::sgf::Turn> turns;
    for (const auto& text : record.moves) {
        const auto move = game.move_from_text(text);
        if (!move) engine::fail("game {}: illegal move {}", record.index + 1, text);
        turns.push_back({game.to_play(), *move});
        game.play(*move);
    }
    auto comment = record.reason;
    if (!record.detail.empty()) comment += ": " + record.detail;
    return go::sgf::to_text(go::sgf::tree_of(start_, turns, result_text(record),
                                             {{"PB", {record.name_of(engine::Player::first)}},
                                              {"PW", {record.name_of(engine::Player::second)}},
                                              {"RO", {std::to_string(record.index + 1)}},
                                              {"GC", {comment}}})) +
           '\n';
}

}  // namespace

go::Go start_of(const GoConditions& conditions) {
    Go start(conditions.size, go::Komi::from_points(conditions.komi),
             go::rules_from_text(conditions.rules));
    for (const auto& vertex : conditions.handicap) {
        const auto point = go::point_from_vertex(vertex, conditions.size);
        if (!point) engine::fail("handicap: not a vertex: {}", vertex);
        start.set_up(*point, engine::Player::first);
    }
    if (conditions.handicap.empty()) return start;
    start.set_handicap(static_cast<int>(conditions.handicap.size()));
    start.set_to_play(engine::Player::second);
    return start;
}

std::unique_ptr<Rulebook> go_rulebook(const GoConditions& conditions, bool agree) {
    return std::make_unique<GoRulebook>(conditions, agree);
}

}  // namespace selfplay
