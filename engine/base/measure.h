// How often something can be done a second: what every `bench` is made of. What counts is the
// processor time of the calling thread, so that a figure hardly depends on who else uses the
// machine; work that several threads share is measured by the clock on the wall.
#pragma once

#include <time.h>

#include <chrono>

namespace engine {

// Of the calling thread, since its start.
inline double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Of all threads of this process together, since its start.
inline double process_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// Calls run() over and over for about `seconds` of `clock`, `batch` times between two looks at it
// (which take as long as some hundred instructions).
template <class Run>
double calls_per_second(double seconds, Run run, int batch = 64,
                        double (*clock)() = processor_seconds) {
    const double start = clock();
    double calls = 0, now = start;
    for (; now - start < seconds; calls += batch, now = clock())
        for (int i = 0; i < batch; ++i) run();
    return calls / (now - start);
}

}  // namespace engine
