#include "engine/go/linear_policy.h"

#include <cassert>

namespace go {

Factors::Factors(const std::vector<float>& logits) : factors_(logits.size()) {
    assert(logits.size() == static_cast<std::size_t>(features::count));
    std::transform(logits.begin(), logits.end(), factors_.begin(),
                   [](float logit) { return std::exp(logit); });
    const auto& numbers = features::patterns_of_black();
    for (auto& patterns : patterns_) patterns.resize(numbers.size());
    for (std::size_t code = 0; code < numbers.size(); ++code) {
        const auto exchanged = features::colours_exchanged(static_cast<std::uint16_t>(code));
        patterns_[0][code] = factors_[numbers[code]];
        patterns_[1][code] = factors_[numbers[exchanged]];
    }
}

}  // namespace go
