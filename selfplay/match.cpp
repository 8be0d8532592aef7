#include "selfplay/match.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "selfplay/match_files.h"
#include "selfplay/openings.h"

namespace selfplay {

namespace {

using Json = nlohmann::json;
using Pair = std::array<std::unique_ptr<Player>, 2>;

Json to_json(const search::TimeControl& time) {
    if (time.unlimited) return "none";
    return {{"main_ms", time.main.count()},      {"increment_ms", time.increment.count()},
            {"period_ms", time.period.count()},  {"periods", time.periods},
            {"period_moves", time.period_moves}, {"moves_per_session", time.moves_per_session}};
}

Json to_json(const PlayerSettings& player) {
    return {{"command", player.command},
            {"protocol", player.protocol},
            {"name", player.name},
            {"init", player.init},
            {"visits", player.visits ? Json(*player.visits) : Json("none")}};
}

Json to_json(const GameRules& rules) {
    const auto& adjudication = rules.adjudication;
    return {{"time", {to_json(rules.time[0]), to_json(rules.time[1])}},
            {"margin_ms", rules.margin.count()},
            {"move_limit", rules.move_limit},
            {"draw_moves", adjudication.draw_moves},
            {"draw_score", adjudication.draw_score},
            {"draw_from", adjudication.draw_from},
            {"resign_moves", adjudication.resign_moves},
            {"resign_score", adjudication.resign_score}};
}

Json to_json(const GoConditions& go) {
    return {{"size", go.size}, {"komi", go.komi}, {"rules", go.rules}, {"handicap", go.handicap}};
}

Json to_json(const OpeningSettings& openings) {
    return {{"file", openings.file.string()},
            {"plies", openings.plies},
            {"random_plies", openings.random_plies},
            {"seed", openings.seed}};
}

Json to_json(const std::optional<Sprt>& sprt) {
    if (!sprt) return "none";
    return {{"elo0", sprt->elo0},
            {"elo1", sprt->elo1},
            {"alpha", sprt->alpha},
            {"beta", sprt->beta},
            {"normalised", sprt->scale == EloScale::normalised}};
}

void check(const MatchSettings& settings) {
    if (settings.games < 1) engine::fail("games must be at least 1, not {}", settings.games);
    if (settings.concurrency < 1 || settings.concurrency > 1024)
        engine::fail("concurrency must lie in 1..1024, not {}", settings.concurrency);
    if (settings.openings.plies < 0 || settings.openings.random_plies < 0)
        engine::fail("an opening cannot have less than no moves");
    if (const auto& sprt = settings.sprt)
        if (sprt->elo0 >= sprt->elo1 || sprt->alpha <= 0 || sprt->beta <= 0 ||
            sprt->alpha + sprt->beta >= 1)
            engine::fail("SPRT wants elo0 < elo1, and alpha and beta above 0 with a sum below 1");
}

std::unique_ptr<Rulebook> rulebook_of(const MatchSettings& settings) {
    if (settings.game == "go") return go_rulebook(settings.go, settings.agree_on_dead);
    if (settings.game == "chess") return chess_rulebook();
    if (settings.game == "shogi") return shogi_rulebook(settings.declaration_rule);
    engine::fail("no such game: {} (go, chess, shogi)", settings.game);
}

void count(Standing& standing, const GameRecord& record, const std::optional<Sprt>& sprt) {
    const int winner = record.winner();
    ++(winner < 0    ? standing.tally.draws
       : winner == 0 ? standing.tally.wins
                     : standing.tally.losses);
    if (record.by_fault() && winner >= 0) ++standing.faults[1 - winner];
    if (!sprt) return;
    standing.llr = sprt->llr(standing.tally);
    standing.verdict = sprt->verdict(standing.tally);
}

}  // namespace

std::string identity(const MatchSettings& settings) {
    return Json{{"game", settings.game},
                {"go", settings.game == "go" ? to_json(settings.go) : Json("none")},
                {"agree_on_dead", settings.agree_on_dead},
                {"declaration_rule", settings.declaration_rule},
                {"players", {to_json(settings.players[0]), to_json(settings.players[1])}},
                {"alternate", settings.alternate},
                {"rules", to_json(settings.rules)},
                {"openings", to_json(settings.openings)},
                {"sprt", to_json(settings.sprt)}}
        .dump();
}

// The threads share everything below `mutex`; what stands above does not change while they run.
struct Match::State {
    State(MatchSettings given, PlayerFactory make)
        : settings(std::move(given)),
          factory(std::move(make)),
          rulebook(rulebook_of(settings)),
          openings(settings.openings, *rulebook),
          files(settings.out, identity(settings), *rulebook) {
        if (settings.rules.move_limit == 0)
            settings.rules.move_limit = rulebook->usual_move_limit();
        standing.games_wanted = settings.games;
        for (const auto& record : files.resumed()) {
            if (!done.insert(record.index).second)
                engine::fail("game {} stands twice in the record", record.index + 1);
            count(standing, record, settings.sprt);
        }
    }

    std::optional<GameOrder> take_game() {
        const std::lock_guard lock(mutex);
        while (done.contains(next)) ++next;
        if (next >= settings.games) return std::nullopt;
        const int index = next++;
        const bool turned = settings.alternate && index % 2 == 1;
        return GameOrder{index, turned ? 1 : 0, names,
                         openings.at(settings.alternate ? index / 2 : index)};
    }

    // Starts the first pair, so that a wrong command is known before anything is played.
    Pair start_first() {
        Pair pair;
        for (std::size_t engine = 0; engine < 2; ++engine) {
            const auto& player = settings.players[engine];
            try {
                pair[engine] = factory(static_cast<int>(engine), stop.get_token());
            } catch (const Fault& fault) {
                if (fault.kind == Fault::Kind::stopped) throw;
                engine::fail("{}: does not start: {}", player.command, fault.what());
            }
            names[engine] = player.name.empty() ? pair[engine]->name() : player.name;
            if (names[engine].empty()) names[engine] = player.command;
        }
        if (names[0] == names[1]) names[0] += " 1", names[1] += " 2";
        return pair;
    }

    // By as many threads as wanted; returns when the last of them is done.
    void play_all(const GameReport& report) try {
        auto first = start_first();
        std::vector<std::jthread> others;
        for (int i = 1; i < std::min(settings.concurrency, settings.games); ++i)
            others.emplace_back([&] { work({}, report); });
        work(std::move(first), report);
    } catch (const Fault&) {  // stopped while the first pair was starting
    }

    // Starts whoever does not run. One that started before and now fails to loses this game.
    PlayedGame play(const GameOrder& order, Pair& pair) {
        for (std::size_t engine = 0; engine < 2; ++engine) {
            try {
                if (!pair[engine])
                    pair[engine] = factory(static_cast<int>(engine), stop.get_token());
            } catch (const Fault& fault) {
                return forfeit(order, static_cast<int>(engine), fault);
            }
        }
        return play_game(*rulebook, settings.rules, order, {pair[0].get(), pair[1].get()});
    }

    // One thread's share: games until there are none left.
    void work(Pair pair, const GameReport& report) try {
        while (!stop.stop_requested()) {
            const auto order = take_game();
            if (!order) return;
            const auto played = play(*order, pair);
            if (played.faulty >= 0) pair[static_cast<std::size_t>(played.faulty)].reset();
            finish(played.record, report);
        }
    } catch (const Fault&) {  // stopped: the game under way is dropped
    } catch (...) {
        fail(std::current_exception());
    }

    void finish(const GameRecord& record, const GameReport& report) {
        const std::lock_guard lock(mutex);
        if (standing.verdict != Sprt::Verdict::undecided) return;
        files.add(record);
        done.insert(record.index);
        count(standing, record, settings.sprt);
        if (report) report(record, standing);
        if (standing.verdict != Sprt::Verdict::undecided) stop.request_stop();
    }

    void fail(std::exception_ptr error) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::move(error);
        stop.request_stop();
    }

    MatchSettings settings;
    PlayerFactory factory;
    std::unique_ptr<Rulebook> rulebook;
    Openings openings;
    MatchFiles files;
    std::array<std::string, 2> names;
    std::stop_source stop;

    std::mutex mutex;
    Standing standing;
    std::set<int> done;
    int next = 0;
    std::exception_ptr failure;
};

Match::Match(MatchSettings settings, PlayerFactory factory) {
    check(settings);
    state_ = std::make_unique<State>(std::move(settings), std::move(factory));
}

Match::~Match() = default;

const Standing& Match::standing() const { return state_->standing; }

void Match::run(const std::stop_token& stop, const GameReport& report) {
    auto& state = *state_;
    if (state.standing.verdict != Sprt::Verdict::undecided) return;
    const std::stop_callback forward(stop, [&] { state.stop.request_stop(); });
    state.play_all(report);
    if (state.failure) std::rethrow_exception(state.failure);
}

}  // namespace selfplay
