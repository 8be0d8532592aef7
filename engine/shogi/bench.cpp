#include "engine/shogi/bench.h"

#include "engine/base/measure.h"
#include "engine/base/random.h"
#include "engine/shogi/rollouts.h"

namespace shogi {
namespace {

engine::Figure perft_figure(double seconds) {
    const Shogi start;
    std::uint64_t nodes = 0;
    const double rate = engine::calls_per_second(
        seconds, [&] { nodes = start.perft(5); }, 1);
    return {"shogi_perft", rate * static_cast<double>(nodes), "nodes/s"};
}

engine::Figure rollouts_figure(double seconds) {
    const Shogi start;
    engine::Random random(1);
    Rollouts rollouts;
    const double rate = engine::calls_per_second(
        seconds, [&] { rollouts.play(start, random); }, 16);
    return {"shogi_rollouts", rate, "rollouts/s"};
}

}  // namespace

std::vector<engine::Figure> bench_rules(double seconds) {
    return {perft_figure(seconds), rollouts_figure(seconds)};
}

}  // namespace shogi
