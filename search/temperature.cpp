#include "search/temperature.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "search/noise.h"

namespace search {

namespace {

// Below this the most visited move is as good as certain, and the powers below lose their meaning.
constexpr float coldest = 0.01f;

}  // namespace

std::size_t draw_by_count(std::span<const std::uint64_t> counts, float temperature,
                          engine::Random& random) {
    assert(!counts.empty());
    const auto most = std::max_element(counts.begin(), counts.end());
    const auto first = static_cast<std::size_t>(most - counts.begin());
    if (temperature < coldest || *most == 0) return first;
    std::vector<double> up_to;
    up_to.reserve(counts.size());
    double sum = 0;
    for (const auto count : counts) {
        const double share = static_cast<double>(count) / static_cast<double>(*most);
        up_to.push_back(sum += std::pow(share, 1 / double{temperature}));
    }
    const auto drawn = std::upper_bound(up_to.begin(), up_to.end(), open_unit(random) * sum);
    return drawn == up_to.end() ? first : static_cast<std::size_t>(drawn - up_to.begin());
}

}  // namespace search
