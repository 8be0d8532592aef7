#include "selfplay/alphago/value_stage.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "nn/load.h"
#include "nn/passes.h"
#include "selfplay/alphago/policy_games.h"
#include "selfplay/alphago/stage_network.h"
#include "selfplay/records/segment.h"
#include "selfplay/training/replay.h"
#include "selfplay/training/student.h"

namespace selfplay::alphago {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view value_encoding = "alphago49";

// Plays games until the archive holds enough of them, or time is up.
class ValueGames {
   public:
    ValueGames(const StageInput& input, const ValuePlayers& players, const ValueSettings& settings,
               const Watch& watch)
        : input_(input),
          settings_(settings),
          watch_(watch),
          archive_(input.folder / "games"),
          workers_(input.threads) {
        for (const auto& path : {players.policy, players.reinforced}) {
            networks_.push_back(playing_network(nn::load(path)));
            if (size() == 0 || networks_.front()->graph().facts.board != size())
                engine::fail("{}: expected a policy network of Go on the board of the other",
                             path.string());
        }
        if (!archive_.damage().empty()) input.say(archive_.damage());
    }

    void play() {
        auto held = count();
        const auto wanted = static_cast<std::size_t>(settings_.games);
        engine::Random random(engine::mixed(static_cast<std::uint64_t>(settings_.seed), held));
        double told = watch_.seconds();
        while (held < wanted && !watch_.over()) {
            held += play_some(random());
            if (watch_.seconds() < told + 15 && held < wanted) continue;
            told = watch_.seconds();
            input_.say(fmt::format("{} of {} games", held, wanted));
        }
    }

    std::vector<records::Game> read() const {
        std::vector<records::Game> games;
        for (const auto& path : archive_.segments()) {
            auto segment = records::unpack(engine::read_file(path));
            std::move(segment.games.begin(), segment.games.end(), std::back_inserter(games));
        }
        return games;
    }
    int size() const { return networks_.back()->graph().facts.board; }
    const nn::Facts& facts() const { return networks_.back()->graph().facts; }

   private:
    std::size_t count() const { return read().size(); }

    // The move of a game that is drawn uniformly: up to 450 on 19x19 (Silver et al. 2016), fewer on
    // smaller boards.
    int drawn_turn(const Playing& playing) const {
        const int most = std::max(size() * size() * 450 / 361, 2);
        return engine::Random(playing.seed + 7).below(most);
    }

    // Games that end before anything is to be learned are played in vain.
    std::size_t play_some(std::uint64_t seed) {
        constexpr int together = 64;
        const auto turn = [](const Playing& playing) { return playing.game.move_count(); };
        const Plan plan{
            [&](const Playing& playing) {
                const int drawn = drawn_turn(playing);
                return turn(playing) < drawn ? 0 : turn(playing) == drawn ? uniform_policy : 1;
            },
            [&](const Playing& playing) { return turn(playing) == drawn_turn(playing) + 1; }};
        auto games = play_games(together, size(), seed, networks_, plan, workers_);
        std::vector<records::Game> kept;
        for (auto& playing : games)
            if (!playing.record.shares.empty()) kept.push_back(std::move(playing.record));
        archive_.append(kept);
        return kept.size();
    }

    const StageInput& input_;
    const ValueSettings& settings_;
    const Watch& watch_;
    records::Archive archive_;
    nn::training::Workers workers_;
    Networks networks_;
};

training::ReplaySettings replay_settings(const ValueSettings& settings) {
    training::ReplaySettings replay;
    replay.window = 100'000'000;
    replay.held_out = 0.1f;
    replay.fast_searches = settings.positions == Taught::all;
    return replay;
}

using Terms = std::span<const nn::training::Term>;

// What a value network learns from, and what is held out to judge it by.
class ValueLessons {
   public:
    virtual ~ValueLessons() = default;
    // How much of each there is, in words.
    virtual std::string extent() const = 0;
    // Shown until the next call.
    virtual const nn::training::Samples& draw(bool held_out, int count, Terms terms,
                                              engine::Random& random) = 0;
};

class PlayedLessons final : public ValueLessons {
   public:
    PlayedLessons(std::vector<records::Game> games, const ValueSettings& settings, int threads)
        : replay_(replay_settings(settings), value_encoding, threads) {
        std::uint64_t played = 0;
        for (auto& game : games) replay_.add(std::move(game), ++played);
        if (replay_.lessons().positions() == 0 || replay_.held_out().positions() == 0)
            engine::fail("expected games to learn from and to judge by, found {}", played);
    }

    std::string extent() const override {
        return fmt::format("{} positions to learn from, {} held out", replay_.lessons().positions(),
                           replay_.held_out().positions());
    }
    const nn::training::Samples& draw(bool held_out, int count, Terms terms,
                                      engine::Random& random) override {
        return held_out ? replay_.draw_held_out(count, terms, random)
                        : replay_.draw(count, terms, random);
    }

   private:
    training::Replay<go::Go> replay_;
};

class ExpertLessons final : public ValueLessons {
   public:
    ExpertLessons(ExpertGames games, const ValueSettings& settings, int threads)
        : settings_(settings), games_(std::move(games)), batches_(value_encoding, threads) {}

    std::string extent() const override {
        return fmt::format("{} games to learn from, {} held out", games_.lessons.size(),
                           games_.held_out.size());
    }
    const nn::training::Samples& draw(bool held_out, int count, Terms terms,
                                      engine::Random& random) override {
        constexpr int symmetries = 8;
        const auto& games = held_out ? games_.held_out : games_.lessons;
        places_.clear();
        turns_.clear();
        for (int i = 0; i < count; ++i) {
            const auto number = random.below(static_cast<int>(games.size()));
            places_.push_back(place_in(games[static_cast<std::size_t>(number)], number, random));
            turns_.push_back(random.below(symmetries));
        }
        return batches_.make(places_, turns_, terms);
    }

   private:
    ExpertPlace place_in(const ExpertGame& game, int number, engine::Random& random) const {
        const auto turns = static_cast<int>(game.moves.size());
        if (settings_.positions == Taught::all)
            return {&game, static_cast<std::size_t>(random.below(turns))};
        engine::Random once(engine::mixed(static_cast<std::uint64_t>(settings_.seed),
                                          static_cast<std::uint64_t>(number)));
        return {&game, static_cast<std::size_t>(once.below(turns))};
    }

    const ValueSettings& settings_;
    ExpertGames games_;
    ExpertBatches batches_;
    std::vector<ExpertPlace> places_;
    std::vector<int> turns_;
};

class ValueStage {
   public:
    ValueStage(const StageInput& input, const ValueSettings& settings,
               const training::LearnSettings& learning, const nn::Graph& fresh,
               ValueLessons& lessons, const Watch& watch)
        : input_(input),
          settings_(settings),
          learning_(learning),
          watch_(watch),
          folder_(settings.positions == Taught::all ? input.folder / "all" : input.folder),
          state_(folder_.state()),
          lessons_(lessons),
          student_(begin(fresh), learning, input.threads, folder_, input.say),
          random_(engine::mixed(static_cast<std::uint64_t>(settings.seed),
                                static_cast<std::uint64_t>(student_.steps()))) {}

    void run() {
        input_.say(lessons_.extent());
        double reported = watch_.seconds();
        while (!watch_.over() && !done()) {
            student_.learn(draw(false, random_));
            if (watch_.seconds() < reported + settings_.report_seconds) continue;
            report();
            reported = watch_.seconds();
        }
        report();
    }

   private:
    bool done() const { return settings_.steps > 0 && student_.steps() >= settings_.steps; }

    nn::Graph begin(const nn::Graph& fresh) {
        engine::Random random(static_cast<std::uint64_t>(settings_.seed));
        auto normed = with_norms(fresh, folder_, learning_, input_.threads,
                                 [&](Terms terms) -> const nn::training::Samples& {
                                     return lessons_.draw(false, learning_.batch, terms, random);
                                 });
        // The layers of a policy say so much that tanh would answer +-1 throughout, and not learn.
        standardise(normed, "layer13");
        return settings_.norms ? normed : nn::fold_batch_norms(std::move(normed));
    }

    const nn::training::Samples& draw(bool held_out, engine::Random& random) {
        return lessons_.draw(held_out, learning_.batch, student_.terms(), random);
    }

    // Of positions that are learned from or held out. The network that plays is asked: what the
    // learner's running statistics make of weights that change is worse, at times than nothing.
    double error_of(nn::training::Learner& playing, bool held_out) {
        engine::Random random(1);
        training::QualityTally tally;
        for (int judged = 0; judged < settings_.judged; judged += learning_.batch) {
            const auto& samples = draw(held_out, random);
            tally.add(playing.evaluate(samples), student_.terms(), samples.size);
        }
        return tally.mean().value_error;
    }

    void report() {
        student_.save();
        auto graph = student_.playable(draw(false, random_));
        nn::training::Learner playing(graph,
                                      training::learner_settings(learning_, graph, input_.threads));
        nn::save(nn::fold_batch_norms(std::move(graph)), folder_.latest());
        student_.take_quality();
        auto now = state_;
        now.seconds += watch_.seconds();
        folder_.keep(now);
        const nlohmann::ordered_json line{
            {"stage", "value"},
            {"positions", taught_names[static_cast<std::size_t>(settings_.positions)]},
            {"minutes", now.seconds / 60},
            {"steps", student_.steps()},
            {"samples", student_.steps() * learning_.batch},
            {"train_error", error_of(playing, false)},
            {"test_error", error_of(playing, true)}};
        tell(input_, folder_.path() / "value.jsonl", line.dump());
    }

    const StageInput& input_;
    const ValueSettings& settings_;
    const training::LearnSettings& learning_;
    const Watch& watch_;
    training::RunFolder folder_;
    training::RunState state_;  // before this call
    ValueLessons& lessons_;
    training::Student student_;
    engine::Random random_;
};

}  // namespace

void learn_value(const StageInput& input, const ValuePlayers& players,
                 const ValueSettings& settings, const training::LearnSettings& learning,
                 const std::stop_token& stop) {
    const Watch watch(input, stop);
    ValueGames games(input, players, settings, watch);
    games.play();
    if (watch.over()) return;
    PlayedLessons lessons(games.read(), settings, input.threads);
    const auto fresh = new_value(shape_of(games.facts()), static_cast<std::uint64_t>(settings.seed),
                                 settings.pooled);
    ValueStage(input, settings, learning, fresh, lessons, watch).run();
}

void learn_value_from_records(const StageInput& input, const nn::Graph& fresh,
                              const ValueSettings& settings,
                              const training::LearnSettings& learning,
                              const std::stop_token& stop) {
    const Watch watch(input, stop);
    ExpertSelection selection;
    selection.size = fresh.facts.board;
    selection.most_games = settings.games;
    selection.finished = true;
    ExpertLessons lessons(read_expert_games(input.records, selection, input.say), settings,
                          input.threads);
    ValueStage(input, settings, learning, fresh, lessons, watch).run();
}

}  // namespace selfplay::alphago
