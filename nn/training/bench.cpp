#include "nn/training/bench.h"

#include <algorithm>
#include <string>
#include <thread>

#include "engine/base/measure.h"
#include "nn/builders.h"
#include "nn/peak.h"
#include "nn/training/learner.h"

namespace nn::training {

namespace {

constexpr int batch = 256, legal_moves = 40;

TowerDescription tower(int board, int planes) {
    TowerDescription about;
    about.facts.board = board;
    about.facts.blocks = 5;
    about.facts.channels = 64;
    about.planes = planes;
    about.value_width = 64;
    return about;
}

TowerDescription go_tower() {
    auto about = tower(9, 17);
    about.policy_size = 82;
    return about;
}

TowerDescription chess_tower() {
    auto about = tower(8, 119);
    about.policy = PolicyHead::planes;
    about.move_planes = 73;
    about.policy_size = 73 * 64;
    return about;
}

// Random planes; of a few dozen legal moves one is played.
struct Positions {
    std::vector<float> planes, played, values;
    std::vector<int> starts, moves;

    explicit Positions(const TowerDescription& about) {
        engine::Random random(1);
        const auto board = static_cast<std::size_t>(about.facts.board);
        planes.resize(batch * static_cast<std::size_t>(about.planes) * board * board);
        for (auto& x : planes) x = static_cast<float>(random.below(2));
        for (int i = 0; i <= batch; ++i) starts.push_back(i * legal_moves);
        for (int i = 0; i < batch; ++i) {
            const int first = random.below(about.policy_size - legal_moves);
            for (int move = 0; move < legal_moves; ++move) moves.push_back(first + move);
            values.push_back(static_cast<float>(random.below(3) - 1));
            played.resize(moves.size());
            played.back() = 1;
        }
    }
    Samples samples(int board) const {
        return {batch,
                board,
                {planes},
                {{played, starts, moves, true, {}}, {values, {}, {}, true, {}}}};
    }
};

struct Speed {
    double samples = 0;     // a second on the wall
    double peak_share = 0;  // of multiply-adds, by processor time; 0 where there is no peak
};

// A sample takes its network's operations three times: forward, and backward for what flows and for
// the weights.
double operations(const Graph& graph, int board) {
    return 3 * static_cast<double>(flop_count(graph, board));
}

Speed speed_of(const TowerDescription& about, Precision precision, double seconds) {
    engine::Random random(1);
    const Positions positions(about);
    const auto samples = positions.samples(about.facts.board);
    LearnerSettings settings;
    settings.precision = precision;
    settings.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    const auto graph = build_tower(about, random);
    Learner learner(graph, settings);
    learner.step(samples);  // makes what the batch size needs
    const double peak = peak_rate(precision, seconds / 4);
    double used = engine::process_seconds();
    int steps = 0;
    const double rate = batch * engine::calls_per_second(
                                    seconds,
                                    [&] {
                                        learner.step(samples);
                                        ++steps;
                                    },
                                    1, engine::wall_seconds);
    used = engine::process_seconds() - used;
    const double done = operations(graph, about.facts.board) * batch * steps;
    return {rate, peak > 0 ? 100 * done / used / peak : 0};
}

}  // namespace

std::vector<engine::Figure> bench_learner(double seconds) {
    std::vector<engine::Figure> figures;
    const auto measure = [&](const std::string& name, const TowerDescription& about,
                             Precision precision) {
        const auto speed = speed_of(about, precision, seconds);
        figures.push_back({name, speed.samples, "samples/s"});
        if (speed.peak_share > 0) figures.push_back({name + "_peak_share", speed.peak_share, "%"});
    };
    measure("learner_samples", go_tower(), Precision::bf16);
    measure("learner_samples_fp32", go_tower(), Precision::fp32);
    measure("learner_samples_chess", chess_tower(), Precision::bf16);
    measure("learner_samples_chess_fp32", chess_tower(), Precision::fp32);
    return figures;
}

}  // namespace nn::training
