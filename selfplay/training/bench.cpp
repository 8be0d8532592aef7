#include "selfplay/training/bench.h"

#include <time.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <string>
#include <thread>

#include "engine/games.h"
#include "nn/backend.h"
#include "nn/bench.h"
#include "nn/builders.h"
#include "search/calibrate.h"
#include "search/network_evaluator.h"
#include "selfplay/training/actor.h"

namespace selfplay::training {

namespace {

constexpr int rounds = 3;

double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <engine::Encoded G>
nn::Graph new_network(const G& start) {
    const auto& encoding = G::encodings()[0];
    const auto shape = encoding.shape(start);
    nn::TowerDescription tower;
    tower.facts.game = G::name;
    tower.facts.encoding = encoding.name;
    tower.facts.board = shape.height;
    tower.facts.blocks = 5;
    tower.facts.channels = 64;
    tower.planes = shape.planes;
    tower.policy_size = shape.policy_size;
    if (shape.symmetries == 1) {
        tower.policy = nn::PolicyHead::planes;
        tower.move_planes = shape.policy_size / static_cast<int>(shape.points());
    }
    engine::Random random(1);
    return nn::build_tower(tower, random);
}

// Of games of random moves.
template <engine::Encoded G>
std::vector<G> some_positions(const G& start, std::size_t wanted) {
    constexpr int stride = 5;
    engine::Random random(1);
    std::vector<G> positions;
    G game = start;
    for (int ply = 0; positions.size() < wanted; ++ply) {
        if (game.outcome() != engine::Outcome::ongoing) game = start;
        if (ply % stride == 0) positions.push_back(game);
        const auto legal = game.legal_moves();
        game.play(legal[random.below(legal.size())]);
    }
    return positions;
}

// Evaluations a second of the calling thread, over so many seconds of it.
template <engine::Encoded G>
double play_for(double seconds, Actor<G>& actor) {
    const auto before = actor.counts().evaluations;
    const double start = thread_seconds();
    double now = start;
    while (now < start + seconds) {
        actor.advance();
        now = thread_seconds();
    }
    return static_cast<double>(actor.counts().evaluations - before) / (now - start);
}

template <engine::Encoded G>
class Measurement {
   public:
    Measurement(const SelfPlayBench& settings, std::string prefix)
        : settings_(settings), prefix_(std::move(prefix)) {
        engine::Random random(1);
        const auto start = first_position<G>(settings.actors, random);
        graph_ = new_network<G>(start);
        board_ = G::encodings()[0].shape(start).height;
        precision_ = nn::served_precision(graph_, nn::Precision::int16, board_);
        const auto size = static_cast<std::size_t>(settings.actors.batch);
        const auto positions = some_positions<G>(start, std::max<std::size_t>(size, 64));
        calibration_ = search::calibrate<G>(graph_, positions);
        std::vector<const G*> first;
        for (std::size_t i = 0; i < size; ++i) first.push_back(&positions[i]);
        const auto& encoding = G::encodings()[0];
        batch_ = search::calibration::encoded<G>(graph_, encoding, encoding.shape(start), first);
        network_ = std::make_shared<search::NetworkSource<G>>(
            std::make_shared<search::Network>(graph_, precision_, calibration_));
        for (int i = 0; i < settings.threads; ++i)
            actors_.push_back(std::make_unique<Actor<G>>(settings.actors,
                                                         static_cast<std::uint64_t>(i), network_, 0,
                                                         [](const records::Game&) {}));
    }

    std::vector<engine::Figure> run() {
        play(settings_.seconds / rounds);  // games of all lengths under way
        std::vector<double> shares, evaluations, alone;
        for (int round = 0; round < rounds; ++round) {
            alone.push_back(network_alone());
            evaluations.push_back(play(settings_.seconds / rounds));
            shares.push_back(100 * evaluations.back() / alone.back());
        }
        return {{prefix_ + "_evals", median(evaluations), "evals/s"},
                {prefix_ + "_nn_evals", median(alone), "evals/s"},
                {prefix_ + "_share", median(shares), "%"}};
    }

   private:
    static double median(std::vector<double> values) {
        std::sort(values.begin(), values.end());
        return values[values.size() / 2];
    }

    double network_alone() const {
        nn::BenchSettings settings;
        settings.board = board_;
        settings.precision = precision_;
        settings.threads = settings_.threads;
        settings.batch = settings_.actors.batch;
        settings.seconds = settings_.seconds / rounds;
        return nn::bench_network(graph_, settings, batch_, calibration_).at(0).value;
    }

    double play(double seconds) {
        std::vector<double> rates(actors_.size());
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < actors_.size(); ++i)
            threads.emplace_back([&, i] { rates[i] = play_for(seconds, *actors_[i]); });
        for (auto& thread : threads) thread.join();
        return std::accumulate(rates.begin(), rates.end(), 0.0);
    }

    const SelfPlayBench& settings_;
    std::string prefix_;
    nn::Graph graph_;
    int board_ = 0;
    nn::Precision precision_{};
    nn::Calibration calibration_;
    nn::Positions batch_;
    typename Actor<G>::Source network_;
    std::vector<std::unique_ptr<Actor<G>>> actors_;
};

}  // namespace

std::vector<engine::Figure> bench_self_play(const SelfPlayBench& settings) {
    std::vector<engine::Figure> figures;
    const auto add = [&](auto measurement) {
        for (auto& figure : measurement.run()) figures.push_back(std::move(figure));
    };
    add(Measurement<go::Go>(settings, "go9"));
    add(Measurement<chess::Chess>(settings, "chess"));
    add(Measurement<shogi::Shogi>(settings, "shogi"));
    return figures;
}

}  // namespace selfplay::training
