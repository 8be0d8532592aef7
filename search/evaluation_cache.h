// A table of answers shared by all workers without locks. An answer lies in as many words as it
// needs, from a place that its key gives; what was there before is overwritten. The first word is
// the key with a checksum over the others in it, so an answer that two threads wrote at once, or
// that another has overwritten in part, is taken for none.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "search/evaluator.h"
#include "search/memory.h"

namespace search {

class EvaluationCache {
   public:
    static constexpr std::size_t most_words = 512;  // of one answer

    // Of less when the system grants no more; memory is taken as it fills. Fails with engine::Error
    // when there is none at all.
    explicit EvaluationCache(std::size_t bytes);

    // Priors come back in 16 bits (pack_prior), owners in 8.
    void store(std::uint64_t key, const Evaluation& evaluation);
    // False, `to` being undefined, when there is none.
    bool load(std::uint64_t key, Evaluation& to) const;
    void clear();

   private:
    using Word = std::atomic<std::uint64_t>;
    std::size_t place(std::uint64_t key) const { return (key >> 8) % places_ * stride; }

    static constexpr std::size_t stride = 8;  // words between places: one cache line
    static constexpr std::size_t least_bytes = (most_words + stride) * sizeof(Word);
    std::size_t places_;
    Memory memory_;
    Word* words_;  // in it
};

}  // namespace search
