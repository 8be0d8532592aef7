#include "nn/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "engine/base/measure.h"
#include "nn/backend.h"
#include "nn/builders.h"
#include "nn/peak.h"
#if defined(SANBAN_ONEDNN)
#include "nn/onednn/bare.h"
#endif

namespace nn {

namespace {

constexpr int repeats = 5;

// How much of `run`'s yield comes about in a second of this thread.
template <class Run>
double rate(double seconds, Run run) {
    const double start = engine::processor_seconds();
    double done = 0, now = start;
    do {
        done += run();
        now = engine::processor_seconds();
    } while (now - start < seconds);
    return done / (now - start);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() / 2];
}

Positions sparse_positions(const Graph& graph, int board, int size) {
    engine::Random random(1);
    Positions positions{size, board, {}};
    const auto shapes = infer_shapes(graph, board);
    for (const int n : graph.input_nodes()) {
        auto& values =
            positions.inputs.emplace_back(shapes[static_cast<std::size_t>(n)].size(board * board) *
                                          static_cast<std::size_t>(size));
        for (auto& value : values) value = random.below(8) == 0 ? 1.0f : 0.0f;
    }
    return positions;
}

struct Rates {
    std::vector<double> evals, peak, bare;  // a second, per repeat
    std::vector<double> bf16_peak;          // of an int8 network
    double int8_operations = 0;
};

// One thread with an executor of its own.
class Worker {
   public:
    Worker(const Graph& graph, const Program& program, const Positions& positions)
        : positions_(positions), executor_(program.make_executor()) {
        const auto shapes = infer_shapes(graph, positions.board);
        for (const auto& output : graph.outputs)
            outputs_.emplace_back(shapes[static_cast<std::size_t>(output.node)].size(
                                      positions.board * positions.board) *
                                  static_cast<std::size_t>(positions.size));
        in_.assign(positions.inputs.begin(), positions.inputs.end());
        out_.assign(outputs_.begin(), outputs_.end());
    }

    double run() {
        executor_->run({positions_.size, positions_.board, in_, out_});
        return positions_.size;
    }

   private:
    const Positions& positions_;
    std::unique_ptr<Executor> executor_;
    std::vector<std::vector<float>> outputs_;
    std::vector<std::span<const float>> in_;
    std::vector<std::span<float>> out_;
};

struct Measurement {
    const Graph& graph;
    const BenchSettings& settings;
    const Calibration& calibration;
    const Program& program;
    const Positions& positions;
    Precision served;
};

Rates measure(const Measurement& c) {
    Worker worker(c.graph, c.program, c.positions);
    const double share = c.settings.seconds / repeats / 3;
#if defined(SANBAN_ONEDNN)
    std::unique_ptr<onednn::BareConvolutions> bare;
    if (c.served != Precision::int16)
        bare = std::make_unique<onednn::BareConvolutions>(c.graph, c.served, c.calibration,
                                                          c.positions);
#endif
    worker.run();
    Rates rates;
#if defined(SANBAN_ONEDNN)
    if (c.served == Precision::int8) rates.int8_operations = bare->int8_operations();
#endif
    for (int i = 0; i < repeats; ++i) {
        rates.evals.push_back(rate(share, [&] { return worker.run(); }));
        rates.peak.push_back(rate(share, [&] { return run_multiply_adds(c.served, 100000); }));
#if defined(SANBAN_ONEDNN)
        if (bare) rates.bare.push_back(rate(share, [&] { return bare->run(); }));
        if (c.served == Precision::int8)
            rates.bf16_peak.push_back(
                rate(share, [&] { return run_multiply_adds(Precision::bf16, 100000); }));
#endif
    }
    return rates;
}

}  // namespace

std::vector<engine::Figure> bench_network(const Graph& graph, const BenchSettings& settings,
                                          const Positions& positions,
                                          const Calibration& calibration,
                                          const std::string& prefix) {
    const auto served = served_precision(graph, settings.precision, settings.board);
    const auto program = compile(graph, served, calibration, settings.board);
    const Measurement current{graph, settings, calibration, *program, positions, served};
    std::vector<Rates> rates(static_cast<std::size_t>(settings.threads));
    std::vector<std::thread> threads;
    threads.reserve(rates.size());
    for (auto& own : rates) threads.emplace_back([&] { own = measure(current); });
    for (auto& thread : threads) thread.join();

    double evals = 0, peak = 0, bare = 0, bf16_peak = 0;
    for (const auto& own : rates) {
        evals += median(own.evals);
        peak += median(own.peak);
        bare += median(own.bare);
        bf16_peak += median(own.bf16_peak);
    }
    const double flops = evals * static_cast<double>(flop_count(graph, settings.board));
    const double int8_flops = evals * rates[0].int8_operations;
    std::vector<engine::Figure> figures = {{prefix + "evals", evals, "evals/s"},
                                           {prefix + "gflops", flops * 1e-9, "GFLOP/s"}};
    if (peak > 0) figures.push_back({prefix + "peak_share", 100 * flops / peak, "%"});
    if (bare > 0) figures.push_back({prefix + "ceiling_share", 100 * evals / bare, "%"});
    if (bf16_peak > 0)
        figures.push_back({prefix + "mixed_share",
                           100 * (int8_flops / peak + (flops - int8_flops) / bf16_peak), "%"});
    return figures;
}

std::vector<engine::Figure> bench_standard_networks(const BenchSettings& settings) {
    TowerDescription go, chess;
    go.facts.board = 9;
    go.planes = 17;
    go.policy_size = 82;
    chess.facts.board = 8;
    chess.planes = 119;
    chess.policy = PolicyHead::planes;
    chess.move_planes = 73;
    std::vector<engine::Figure> figures;
    for (auto& [name, about] :
         {std::pair<const char*, TowerDescription&>{"go9_5x64", go}, {"chess_5x64", chess}}) {
        about.facts.blocks = 5;
        about.facts.channels = 64;
        engine::Random random(1);
        const auto graph = build_tower(about, random);
        for (const auto precision :
             {Precision::fp32, Precision::bf16, Precision::int8, Precision::int16}) {
            auto own = settings;
            own.board = about.facts.board;
            own.precision = precision;
            if (served_precision(graph, precision, own.board) != precision) continue;
            const auto prefix = fmt::format("{}_{}_", name, name_of(precision));
            const auto positions = sparse_positions(graph, own.board, own.batch);
            const auto calibration = calibrate(graph, std::span(&positions, 1));
            for (auto& figure : bench_network(graph, own, positions, calibration, prefix))
                figures.push_back(figure);
        }
    }
    return figures;
}

}  // namespace nn
