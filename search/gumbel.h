// Root selection by Gumbel-top-k with sequential halving, and the policy that a search with it
// improves to (Danihelka et al. 2022). It looks at an expanded root of a Tree and says with which
// move the next descents must begin; the descents themselves are TreeSearch::gather's.
//
// next() may be called by any number of threads while descents go on, and waits for nobody; the
// rest by one at a time. The root must stay the same node; a Tree may be flipped.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/random.h"
#include "search/move_filter.h"
#include "search/tree.h"

namespace search {

struct GumbelParams {
    int considered = 16;      // root moves that take part
    float visit_offset = 50;  // c_visit
    float scale = 1;          // c_scale, for values turned to [0, 1]
    float noise = 1;          // times Gumbel's numbers; 0: the highest priors take part
};

// The improved policy over the root's edges, in their order, summing to 1: softmax of the logits of
// the priors plus sigma of the values, those of unvisited moves completed by the mixed value. Moves
// that `allowed` bars have none. The root must be expanded.
std::vector<float> improved_policy(const Tree& tree, const MoveFilter& allowed,
                                   const GumbelParams& params);

class GumbelRoot {
   public:
    // For `simulations` descents from now on (what the tree knows already counts for the values
    // only); without a number in rounds that double. At least one root move must be allowed.
    // `tree` must outlive this object.
    GumbelRoot(const Tree& tree, const MoveFilter& allowed,
               std::optional<std::uint64_t> simulations, const GumbelParams& params,
               engine::Random& random);

    // The root move that the next descent must begin with.
    engine::Move next();
    // The move to play as things stand.
    engine::Move best() const;

   private:
    struct Candidate {
        std::size_t edge;
        engine::Move move;
        float noise;
    };
    // Descents number `first` and later, in turn among the best of the phase before.
    struct Phase {
        std::uint64_t first;
        std::vector<Candidate> candidates;  // room for as many as there will be
        std::size_t count;
    };

    void plan_round(std::uint64_t first, std::uint64_t simulations);
    std::uint64_t end_of_plan() const;
    void begin(std::size_t phase);
    std::vector<Candidate> ranked(std::vector<Candidate> candidates) const;

    const Tree& tree_;
    GumbelParams params_;
    std::vector<Candidate> all_;  // that take part
    std::vector<Phase> phases_;
    std::atomic<std::uint64_t> taken_ = 0;
    std::atomic<std::size_t> begun_ = 0;      // the last phase whose candidates are known
    std::atomic<std::size_t> beginning_ = 0;  // likewise, or being worked out
};

}  // namespace search
