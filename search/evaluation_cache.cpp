#include "search/evaluation_cache.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/encoding.h"
#include "search/relaxed.h"
#include "search/tree.h"

namespace search {

namespace {

constexpr std::size_t numbers = 3 + figure_count;
constexpr std::size_t fixed_words = 1 + (numbers + 1) / 2;  // sizes, then the numbers

// Of the key, beside the sizes, so that most answers to other questions are seen to be so at once.
constexpr std::uint64_t tag_bits = 0xffffffff00000000;

// Words from the start: the numbers, then the priors, then the owners.
constexpr std::size_t first_owner(std::size_t priors) { return fixed_words + (priors + 3) / 4; }
constexpr std::size_t words_for(std::size_t priors, std::size_t owners) {
    return first_owner(priors) + (owners + 7) / 8;
}
using Shares = std::array<std::uint16_t, 4 * EvaluationCache::most_words>;
using Points = std::array<std::int8_t, 8 * EvaluationCache::most_words>;

std::int8_t pack_owner(float owner) {
    return static_cast<std::int8_t>(std::lround(127 * std::clamp(owner, -1.0f, 1.0f)));
}

std::array<float, numbers> numbers_of(const Evaluation& evaluation) {
    std::array<float, numbers> all{evaluation.win, evaluation.draw, evaluation.loss};
    std::copy(evaluation.figures.begin(), evaluation.figures.end(), all.begin() + 3);
    return all;
}

}  // namespace

EvaluationCache::EvaluationCache(std::size_t bytes)
    : memory_(std::max(bytes, least_bytes), least_bytes),
      words_(reinterpret_cast<Word*>(memory_.data())) {
    places_ = (memory_.size() / sizeof(Word) - most_words) / stride;
}

void EvaluationCache::clear() {
    for (std::size_t i = 0; i < places_ * stride; ++i) words_[i].store(0, relaxed);
}

void EvaluationCache::store(std::uint64_t key, const Evaluation& evaluation) {
    const auto priors = evaluation.priors.size(), owners = evaluation.owners.size();
    const auto count = words_for(priors, owners);
    if (count + 1 > most_words) return;
    std::array<std::uint64_t, most_words> data;
    std::fill_n(data.begin(), count, 0);
    data[0] = (key & tag_bits) | priors << 16 | owners;
    const auto values = numbers_of(evaluation);
    std::memcpy(&data[1], values.data(), sizeof values);
    Shares shares;
    std::transform(evaluation.priors.begin(), evaluation.priors.end(), shares.begin(), pack_prior);
    std::memcpy(&data[fixed_words], shares.data(), priors * sizeof shares[0]);
    Points points;
    std::transform(evaluation.owners.begin(), evaluation.owners.end(), points.begin(), pack_owner);
    std::memcpy(&data[first_owner(priors)], points.data(), owners);
    Word* const at = &words_[place(key)];
    auto check = key;
    for (std::size_t i = 0; i < count; ++i) {
        check = engine::mixed(check, data[i]);
        at[i + 1].store(data[i], relaxed);
    }
    at[0].store(check, relaxed);
}

bool EvaluationCache::load(std::uint64_t key, Evaluation& to) const {
    const Word* const at = &words_[place(key)];
    const auto sizes = at[1].load(relaxed);
    if ((sizes & tag_bits) != (key & tag_bits)) return false;
    const auto priors = sizes >> 16 & 0xffff, owners = sizes & 0xffff;
    const auto count = words_for(priors, owners);
    if (count + 1 > most_words) return false;
    std::array<std::uint64_t, most_words> data;
    auto check = key;
    for (std::size_t i = 0; i < count; ++i) {
        data[i] = i == 0 ? sizes : at[i + 1].load(relaxed);
        check = engine::mixed(check, data[i]);
    }
    if (check != at[0].load(relaxed)) return false;
    std::array<float, numbers> values;
    std::memcpy(values.data(), &data[1], sizeof values);
    to.win = values[0];
    to.draw = values[1];
    to.loss = values[2];
    std::copy(values.begin() + 3, values.end(), to.figures.begin());
    Shares shares;
    std::memcpy(shares.data(), &data[fixed_words], priors * sizeof shares[0]);
    to.priors.resize(priors);
    std::transform(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(priors),
                   to.priors.begin(), unpack_prior);
    Points points;
    std::memcpy(points.data(), &data[first_owner(priors)], owners);
    to.owners.resize(owners);
    std::transform(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(owners),
                   to.owners.begin(),
                   [](std::int8_t owner) { return static_cast<float>(owner) / 127; });
    return true;
}

}  // namespace search
