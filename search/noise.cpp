#include "search/noise.h"

#include <cmath>

namespace search {

namespace {

constexpr double pi = 3.14159265358979323846;

}  // namespace

double open_unit(engine::Random& random) {
    return (static_cast<double>(random() >> 11) + 0.5) / static_cast<double>(1ull << 53);
}

double normal(engine::Random& random) {
    const double radius = std::sqrt(-2 * std::log(open_unit(random)));
    return radius * std::cos(2 * pi * open_unit(random));
}

float gumbel(engine::Random& random) {
    return static_cast<float>(-std::log(-std::log(open_unit(random))));
}

double gamma(engine::Random& random, double alpha) {
    if (alpha < 1) return gamma(random, alpha + 1) * std::pow(open_unit(random), 1 / alpha);
    const double d = alpha - 1.0 / 3, c = 1 / std::sqrt(9 * d);
    while (true) {
        const double x = normal(random), cube_root = 1 + c * x;
        if (cube_root <= 0) continue;
        const double v = cube_root * cube_root * cube_root;
        if (std::log(open_unit(random)) < x * x / 2 + d - d * v + d * std::log(v)) return d * v;
    }
}

std::vector<float> dirichlet(engine::Random& random, std::size_t count, float alpha) {
    std::vector<double> drawn(count);
    double sum = 0;
    for (double& share : drawn) sum += share = gamma(random, double{alpha});
    // With a small alpha all may be too small for a number: then one has everything.
    if (sum == 0 && count > 0)
        drawn[static_cast<std::size_t>(random.below(static_cast<int>(count)))] = sum = 1;
    std::vector<float> shares;
    shares.reserve(count);
    for (const double share : drawn) shares.push_back(static_cast<float>(share / sum));
    return shares;
}

}  // namespace search
