// How often something can be done a second: what every `bench` is made of.
#pragma once

#include <chrono>

namespace engine {

// Calls run() over and over for about `seconds`, `batch` times between two looks at the clock.
template <class Run>
double calls_per_second(double seconds, Run run, int batch = 64) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    double calls = 0;
    for (; elapsed() < seconds; calls += batch)
        for (int i = 0; i < batch; ++i) run();
    return calls / elapsed();
}

}  // namespace engine
