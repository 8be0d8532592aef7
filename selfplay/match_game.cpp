#include "selfplay/match_game.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "engine/base/error.h"

namespace selfplay {

namespace {

using engine::Outcome;
using search::TimeLeft;

constexpr std::array both{engine::Player::first, engine::Player::second};

std::size_t index(engine::Player player) { return static_cast<std::size_t>(player); }

std::string_view reason_of(Fault::Kind kind) {
    constexpr std::array<std::string_view, 3> names{"crash", "hang", "protocol error"};
    return names[static_cast<std::size_t>(kind)];
}

double seconds(Milliseconds time) { return static_cast<double>(time.count()) / 1000; }

// How long each side has judged the game as drawn or lost without a break.
class Judgements {
   public:
    explicit Judgements(const Adjudication& rules) : rules_(rules) {}

    void note(engine::Player mover, const Answer& answer) {
        auto& side = sides_[index(mover)];
        ++side.moves;
        const auto score = answer.centipawns;
        side.drawn = score && std::abs(*score) <= rules_.draw_score ? side.drawn + 1 : 0;
        side.lost = score && *score <= -rules_.resign_score ? side.lost + 1 : 0;
    }
    Outcome outcome() const {
        for (const auto player : both)
            if (rules_.resign_moves > 0 && sides_[index(player)].lost >= rules_.resign_moves)
                return engine::win_for(~player);
        const bool drawn = std::all_of(sides_.begin(), sides_.end(), [&](const Side& side) {
            return side.drawn >= rules_.draw_moves && side.moves >= rules_.draw_from;
        });
        return rules_.draw_moves > 0 && drawn ? Outcome::draw : Outcome::ongoing;
    }

   private:
    struct Side {
        int moves = 0, drawn = 0, lost = 0;
    };
    Adjudication rules_;
    std::array<Side, 2> sides_{};
};

GameRecord record_of(const GameOrder& order) {
    GameRecord record;
    record.index = order.index;
    record.first = order.first;
    record.names = order.names;
    record.start = order.opening.start;
    return record;
}

class Game {
   public:
    Game(const Rulebook& rulebook, const GameRules& rules, const GameOrder& order,
         const std::array<Player*, 2>& players)
        : rulebook_(rulebook),
          rules_(rules),
          order_(order),
          players_(players),
          referee_(rulebook.referee(order.opening.start)),
          judgements_(rules.adjudication),
          record_(record_of(order)) {
        for (const auto player : both)
            clocks_[index(player)] = TimeLeft::start_of(rules.time[engine_of(player)]);
    }

    PlayedGame play() {
        try {
            set_up();
            play_opening();
            while (!over()) take_turn();
            tell_end();
        } catch (const Fault& fault) {
            if (fault.kind == Fault::Kind::stopped) throw;
            faulty_ = static_cast<int>(culprit_);
            if (!over()) lose(side_of(culprit_), reason_of(fault.kind), fault.what());
        }
        return {std::move(record_), faulty_};
    }

   private:
    bool over() const { return over_; }

    std::size_t engine_of(engine::Player player) const {
        return static_cast<std::size_t>(player == engine::Player::first ? order_.first
                                                                        : 1 - order_.first);
    }
    engine::Player side_of(std::size_t engine) const {
        return engine == static_cast<std::size_t>(order_.first) ? engine::Player::first
                                                                : engine::Player::second;
    }
    // The player of that side, who answers for whatever goes wrong from here on.
    Player& call(engine::Player side) {
        culprit_ = engine_of(side);
        return *players_[culprit_];
    }
    Deadline command_deadline() const { return Clock::now() + rules_.command_timeout; }

    void end(Outcome outcome, std::string_view reason, std::string_view detail = {}) {
        record_.outcome = outcome;
        record_.reason = reason;
        record_.detail = detail;
        over_ = true;
    }

    // By a fault, which the record lays at the player's door.
    void lose(engine::Player side, std::string_view reason, std::string_view detail) {
        const auto& name = record_.names[engine_of(side)];
        end(engine::win_for(~side), reason, fmt::format("{}: {}", name, detail));
    }

    void set_up() {
        auto setup = rulebook_.setup(order_.opening.start);
        for (const auto side : both) {
            setup.time = rules_.time[engine_of(side)];
            call(side).new_game(setup, side, command_deadline());
        }
    }

    void play_opening() {
        for (const auto& move : order_.opening.moves) {
            const auto mover = referee_->to_play();
            const auto [written, objection] = referee_->play(move);
            if (!objection.empty()) engine::fail("opening move {}: {}", move, objection);
            record_.moves.push_back(written);
            for (const auto side : both) call(side).play(mover, written, command_deadline());
        }
        record_.opening_moves = static_cast<int>(record_.moves.size());
        look_for_end();
    }

    void take_turn() {
        const auto mover = referee_->to_play();
        const auto& left = clocks_[index(mover)];
        const bool timed = !left.control.unlimited;
        const auto begin = Clock::now();
        const auto deadline = begin + (timed ? left.longest_move() + rules_.margin + rules_.grace
                                             : rules_.move_timeout);
        const auto answer = call(mover).think(mover, clocks_, deadline);
        const auto used = std::chrono::ceil<Milliseconds>(Clock::now() - begin);
        record_.milliseconds.push_back(static_cast<int>(used.count()));
        if (timed && !in_time(mover, used)) return;
        if (answer.kind == Answer::Kind::move) return take_move(mover, answer);
        // Nothing was moved: the last time belongs to no move.
        record_.milliseconds.pop_back();
        if (answer.kind == Answer::Kind::resign) return end(engine::win_for(~mover), "resignation");
        if (referee_->may_claim_win()) return end(engine::win_for(mover), "declaration");
        lose(mover, "illegal move", "declared a win that is none");
    }

    bool in_time(engine::Player mover, Milliseconds used) {
        auto& left = clocks_[index(mover)];
        const auto most = left.longest_move();
        if (used <= most + rules_.margin) {
            left.spend(std::min(used, most));
            return true;
        }
        record_.milliseconds.pop_back();
        lose(mover, "time", fmt::format("used {:.3f} s of {:.3f} s", seconds(used), seconds(most)));
        return false;
    }

    void take_move(engine::Player mover, const Answer& answer) {
        const auto [written, objection] = referee_->play(answer.move);
        if (!objection.empty()) {
            record_.milliseconds.pop_back();
            faulty_ = static_cast<int>(culprit_);
            return lose(mover, "illegal move",
                        fmt::format("{}: {}", answer.move.substr(0, 40), objection));
        }
        record_.moves.push_back(written);
        judgements_.note(mover, answer);
        look_for_end();
        // Dead stones are asked for when both know of the last pass, so it is told in any case.
        call(~mover).play(mover, written, command_deadline());
        if (over()) settle();
    }

    void look_for_end() {
        const auto verdict = referee_->verdict();
        const int moves = static_cast<int>(record_.moves.size());
        if (verdict.outcome != Outcome::ongoing) {
            record_.score = verdict.score;
            end(verdict.outcome, verdict.reason);
        } else if (const auto outcome = judgements_.outcome(); outcome != Outcome::ongoing) {
            end(outcome, "adjudication");
        } else if (rules_.move_limit > 0 && moves >= rules_.move_limit) {
            end(Outcome::draw, "move limit");
        }
    }

    // The result by the stones that both call dead, where the rules ask for agreement.
    void settle() {
        if (referee_->verdict().outcome == Outcome::ongoing || !referee_->wants_dead_stones())
            return;
        std::array<std::optional<std::vector<std::string>>, 2> claims;
        for (const auto side : both) {
            claims[index(side)] = call(side).dead_stones(command_deadline());
            if (claims[index(side)])
                std::sort(claims[index(side)]->begin(), claims[index(side)]->end());
        }
        if (!claims[0] || claims[0] != claims[1]) {
            record_.detail = "no agreement on dead stones: counted as it stands";
            return;
        }
        record_.dead = *claims[0];
        referee_->remove(record_.dead);
        const auto verdict = referee_->verdict();
        record_.outcome = verdict.outcome;
        record_.score = verdict.score;
    }

    void tell_end() {
        for (const auto side : both) call(side).game_over(record_.outcome, command_deadline());
    }

    const Rulebook& rulebook_;
    const GameRules& rules_;
    const GameOrder& order_;
    std::array<Player*, 2> players_;
    std::unique_ptr<Referee> referee_;
    Judgements judgements_;
    Clocks clocks_;
    GameRecord record_;
    bool over_ = false;
    std::size_t culprit_ = 0;
    int faulty_ = -1;
};

}  // namespace

PlayedGame play_game(const Rulebook& rulebook, const GameRules& rules, const GameOrder& order,
                     const std::array<Player*, 2>& players) {
    return Game(rulebook, rules, order, players).play();
}

PlayedGame forfeit(const GameOrder& order, int engine, const Fault& fault) {
    if (fault.kind == Fault::Kind::stopped) throw fault;
    auto record = record_of(order);
    record.outcome =
        engine::win_for(engine == order.first ? engine::Player::second : engine::Player::first);
    record.reason = reason_of(fault.kind);
    record.detail = fmt::format("{}: at its start: {}",
                                record.names[static_cast<std::size_t>(engine)], fault.what());
    return {std::move(record), engine};
}

}  // namespace selfplay
