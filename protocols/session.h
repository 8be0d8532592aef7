// One game being played, with a search behind it: what every front end talks to. Through Session,
// moves and positions cross as text, so that UCI and USI never learn which game they carry; GTP,
// which is about Go alone, holds a GameSession<go::Go> and looks at the game itself.
//
// One thread owns a session. Callbacks of a think come from a thread of the search and may use
// only the const functions.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/option.h"
#include "engine/games.h"
#include "search/load_player.h"
#include "search/mate.h"
#include "search/searcher.h"

namespace protocols {

class Session {
   public:
    using Report = std::function<void(const search::Analysis&)>;

    virtual ~Session() = default;

    virtual std::string_view game() const = 0;
    virtual engine::Player to_play() const = 0;
    virtual engine::Outcome outcome() const = 0;

    // An empty `start` is the game's own first position. Fails with engine::Error, the position
    // being what it was, when the start or a move is illegal; the message names the move.
    virtual void set_position(std::string_view start, std::span<const std::string> moves) = 0;
    // Forgets what the search knows.
    virtual void new_game() = 0;
    // Fails when the move is illegal.
    virtual void play(std::string_view move) = 0;
    // False at the start.
    virtual bool undo() = 0;

    virtual engine::MoveList legal_moves() const = 0;
    // Empty where the text is no legal move.
    virtual std::optional<engine::Move> move_from_text(std::string_view text) const = 0;
    virtual std::string move_to_text(engine::Move move) const = 0;
    // Moves from the present position on, separated by blanks.
    virtual std::string line_to_text(std::span<const engine::Move> line) const = 0;
    virtual std::string position_text() const = 0;
    // Whether the mover may end the game in its favour by a declaration (shogi's impasse).
    virtual bool can_declare_win() const = 0;
    // Blocks; from any thread while nothing changes the session. Its table is within the memory
    // budget, whatever the limits say. Unknown in games without mate.
    virtual search::MateResult find_mate(const search::MateLimits& limits) const = 0;

    virtual search::SearchParams params() const = 0;
    virtual void set_params(const search::SearchParams& params) = 0;
    // Searches with the network of this file from now on; with games played out when the name is
    // empty. Fails, all being as before, when the file or its game or board is wrong. What this
    // program carries (search::embedded_name) goes by board and method, and gives way to games
    // played out on boards that it does not serve.
    virtual void load_network(const std::string& file, search::PrecisionChoice precision) = 0;
    // Where the network's policy has a legal move; 0 without a network.
    virtual int policy_index(engine::Move move) const = 0;

    // As search::Searcher's.
    virtual void start(const search::Limits& limits, Report report, Report done) = 0;
    virtual void stop() = 0;
    virtual void wait() = 0;
    virtual void interrupt() = 0;
    virtual void ponder_hit() = 0;
    virtual bool thinking() const = 0;
};

// Games in which a king can be mated.
template <class G>
concept HasMate = requires(const G& game) {
    game.position().in_check();
};

template <engine::Game G>
class GameSession final : public Session {
   public:
    explicit GameSession(const search::SearchParams& params)
        : params_(params), searcher_(for_tree(params)), games_(1) {}

    // Applied to the present game and to every start from now on: settings that no position text
    // holds (Chess960 notation, rules of impasse).
    void set_house_rules(std::function<void(G&)> apply) {
        house_rules_ = std::move(apply);
        for (G& game : games_) house_rules_(game);
    }

    // The game now, and all states it went through, the start first.
    const G& now() const { return games_.back(); }
    std::span<const G> states() const { return games_; }
    search::Searcher<G>& searcher() { return searcher_; }
    const search::Searcher<G>& searcher() const { return searcher_; }
    // A new start, with whatever the game can be set to (size, komi, set-up stones).
    void restart(const G& start) { games_.assign(1, start); }
    void play(engine::Move move) {
        G next = games_.back();
        next.play(move);
        append(next);
    }
    // One state more, for games whose turns need not alternate.
    void append(const G& next) { games_.push_back(next); }
    // The present state put right: another side to move, say.
    void replace_last(const G& game) { games_.back() = game; }
    // A setting that holds for the whole game.
    void change_all(const std::function<void(G&)>& change) {
        for (G& game : games_) change(game);
    }

    std::string_view game() const override { return G::name; }
    engine::Player to_play() const override { return now().to_play(); }
    engine::Outcome outcome() const override { return now().outcome(); }

    void set_position(std::string_view start, std::span<const std::string> moves) override {
        std::vector<G> games{start.empty() ? G() : G::from_text(start)};
        if (house_rules_) house_rules_(games[0]);
        for (const std::string& text : moves) {
            const auto move = games.back().move_from_text(text);
            if (!move) engine::fail("illegal move {} (number {})", text, games.size());
            games.push_back(games.back());
            games.back().play(*move);
        }
        games_ = std::move(games);
    }

    void new_game() override { searcher_.clear(); }

    void play(std::string_view text) override {
        const auto move = now().move_from_text(text);
        if (!move) engine::fail("illegal move {}", text);
        play(*move);
    }

    bool undo() override {
        if (games_.size() == 1) return false;
        games_.pop_back();
        return true;
    }

    engine::MoveList legal_moves() const override { return now().legal_moves(); }
    std::optional<engine::Move> move_from_text(std::string_view text) const override {
        return now().move_from_text(text);
    }
    std::string move_to_text(engine::Move move) const override { return now().move_to_text(move); }

    std::string line_to_text(std::span<const engine::Move> line) const override {
        std::string text;
        G game = now();
        for (const engine::Move move : line) {
            text.append(text.empty() ? "" : " ").append(game.move_to_text(move));
            game.play(move);
        }
        return text;
    }

    std::string position_text() const override { return now().to_text(); }

    bool can_declare_win() const override {
        if constexpr (requires(const G& game) { game.can_declare_win(); })
            return now().can_declare_win();
        return false;
    }

    search::MateResult find_mate(const search::MateLimits& limits) const override {
        if constexpr (HasMate<G>) {
            auto bounded = limits;
            bounded.table_bytes =
                static_cast<std::size_t>(search::mate_mebibytes(params_.memory_mib)) << 20;
            return search::find_mate(now(), bounded);
        } else {
            return {};
        }
    }

    search::SearchParams params() const override { return params_; }
    void set_params(const search::SearchParams& params) override {
        const bool anew = embedded_ && choice(now(), params.method) != embedded_->name;
        if (anew) searcher_.set_network(nullptr);
        searcher_.set_params(for_tree(params));
        params_ = params;
        if constexpr (engine::Encoded<G>)
            if (anew) load_embedded(now(), embedded_->precision);
    }

    void load_network(const std::string& file, search::PrecisionChoice precision) override {
        if constexpr (engine::Encoded<G>) {
            if (file == search::embedded_name) return load_embedded(now(), precision);
            auto source = file.empty() ? nullptr : search::load_player(file, precision, now());
            set_network(now(), std::move(source));
            embedded_.reset();
        } else {
            if (!file.empty()) engine::fail("no network plays {}", G::name);
        }
    }

    // Before a game from such a start: fails when the network that was asked for does not serve it.
    void prepare_for(const G& start) {
        if (!embedded_) return searcher_.check(start);
        if constexpr (engine::Encoded<G>) {
            const auto name = choice(start, params_.method);
            const bool lacks = !name.empty() && !searcher_.has_network();
            if (lacks || name != embedded_->name || !serves(start))
                load_embedded(start, embedded_->precision);
        }
    }

    int policy_index(engine::Move move) const override {
        const auto& network = searcher_.network();
        return network ? network->policy_index(now(), move) : 0;
    }

    void start(const search::Limits& limits, Report report, Report done) override {
        if (embedded_) prepare_for(now());
        searcher_.set_position(now());
        auto with_ply = limits;
        with_ply.ply = static_cast<int>(games_.size()) - 1;
        searcher_.start(with_ply, std::move(report), std::move(done));
    }
    void stop() override { searcher_.stop(); }
    void wait() override { searcher_.wait(); }
    void interrupt() override { searcher_.interrupt(); }
    void ponder_hit() override { searcher_.ponder_hit(); }
    bool thinking() const override { return searcher_.thinking(); }

   private:
    // A mate search may run beside the tree's.
    static search::SearchParams for_tree(search::SearchParams params) {
        if (HasMate<G>) params.memory_mib -= search::mate_mebibytes(params.memory_mib);
        return params;
    }

    bool serves(const G& game) const try {
        return searcher_.check(game), true;
    } catch (const engine::Error&) {
        return false;
    }

    void set_network(const G& game, std::shared_ptr<const search::EvaluatorSource<G>> source) {
        searcher_.set_network(nullptr);
        searcher_.set_position(game);
        if (!source) return;
        searcher_.set_network(std::move(source));
        searcher_.warm_up();
    }

    static std::string_view choice(const G& game, search::Method method) {
        if constexpr (engine::Encoded<G>) return search::embedded_choice(game, method);
        return {};
    }

    // Of what this program carries.
    struct Embedded {
        std::string_view name;  // as embedded_choice says
        search::PrecisionChoice precision;
    };

    void load_embedded(const G& game, search::PrecisionChoice precision) {
        embedded_ = {choice(game, params_.method), precision};
        std::shared_ptr<const search::EvaluatorSource<G>> source;
        try {
            source = search::load_embedded(embedded_->name, precision, game);
        } catch (const engine::Error& error) {
            fmt::print(stderr, "{}: games are played out (UCT)\n", error.what());
        }
        set_network(game, std::move(source));
    }

    search::SearchParams params_;  // as they were given
    search::Searcher<G> searcher_;
    std::optional<Embedded> embedded_;  // in use
    std::vector<G> games_;              // the present state last
    std::function<void(G&)> house_rules_;
};

// Each compiled once, in a file of its own.
extern template class GameSession<go::Go>;
extern template class GameSession<chess::Chess>;
extern template class GameSession<shogi::Shogi>;

}  // namespace protocols
