#include "search/evaluation_cache.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "engine/encoding.h"
#include "search/relaxed.h"
#include "search/tree.h"

namespace search {

namespace {

constexpr std::size_t numbers = 3 + figure_count;
constexpr std::size_t fixed_words = 1 + (numbers + 1) / 2;  // sizes, then the numbers

// Of the key, beside the sizes, so that most answers to other questions are seen to be so at once.
constexpr std::uint64_t tag_bits = 0xffffffff00000000;

constexpr std::size_t words_for(std::size_t priors, std::size_t owners) {
    return fixed_words + (priors + 3) / 4 + (owners + 7) / 8;
}

// Items of `bits` bits each, packed into words.
class Packer {
   public:
    explicit Packer(std::uint64_t* words) : words_(words) {}
    void put(std::uint64_t item, int bits) {
        if (used_ == 64) ++words_, used_ = 0;
        if (used_ == 0) *words_ = 0;
        *words_ |= item << used_;
        used_ += bits;
    }
    std::uint64_t take(int bits) {
        if (used_ == 64) ++words_, used_ = 0;
        const auto item = *words_ >> used_ & ((std::uint64_t{1} << bits) - 1);
        used_ += bits;
        return item;
    }

   private:
    std::uint64_t* words_;
    int used_ = 0;
};

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
    data[0] = (key & tag_bits) | priors << 16 | owners;
    Packer values(&data[1]);
    for (const float number : numbers_of(evaluation))
        values.put(std::bit_cast<std::uint32_t>(number), 32);
    Packer shares(&data[fixed_words]);
    for (const float prior : evaluation.priors) shares.put(pack_prior(prior), 16);
    Packer points(&data[fixed_words + (priors + 3) / 4]);
    for (const float owner : evaluation.owners)
        points.put(static_cast<std::uint8_t>(std::lround(127 * std::clamp(owner, -1.0f, 1.0f))), 8);
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
    Packer values(&data[1]);
    const auto number = [&] {
        return std::bit_cast<float>(static_cast<std::uint32_t>(values.take(32)));
    };
    to.win = number();
    to.draw = number();
    to.loss = number();
    for (float& figure : to.figures) figure = number();
    Packer shares(&data[fixed_words]);
    to.priors.resize(priors);
    for (float& prior : to.priors)
        prior = unpack_prior(static_cast<std::uint16_t>(shares.take(16)));
    Packer points(&data[fixed_words + (priors + 3) / 4]);
    to.owners.resize(owners);
    for (float& owner : to.owners)
        owner = static_cast<float>(static_cast<std::int8_t>(points.take(8))) / 127;
    return true;
}

}  // namespace search
