// Learns AlphaGo's two linear policies from moves played: softmax regression over the features of
// move_features.h, by gradient steps whose size falls for each feature as it is met (Duchi et al.
// 2011). One owner, one thread.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/go/feature_list.h"
#include "search/linear_network.h"

namespace selfplay::alphago {

struct LinearQuality {
    double loss = 0;      // mean of -log p of the moves played
    double accuracy = 0;  // how often the likeliest was the one played
};

class LinearLearner {
   public:
    LinearLearner();

    // One step on the move played in `game`; none where it is a pass or fills an own eye.
    void learn(const go::Go& game, go::Move played, float rate);

    // Of what was judged since the last call: the rollout policy, then the tree policy.
    void judge(const go::Go& game, go::Move played);
    std::array<LinearQuality, 2> take_quality();

    std::uint64_t steps() const { return steps_; }

    // The file is also a network (search/linear_network.h).
    void save(const std::filesystem::path& path) const;
    // Fails with engine::Error on a file of something else.
    void restore(const std::filesystem::path& path);

   private:
    struct Policy {
        std::vector<float> logits, squares;  // a feature
        LinearQuality sums;
    };

    // Probabilities of the listed moves, in chances_; the place of `played` or nothing.
    std::optional<std::size_t> list(const go::Go& game, go::Move played);
    void spread(const Policy& policy, const std::vector<int>& ends, int ends_from);
    void step(Policy& policy, std::size_t played, const std::vector<int>& ends, int ends_from,
              float rate);
    void tally(Policy& policy, std::size_t played) const;

    std::array<Policy, 2> policies_;
    std::uint64_t steps_ = 0, judged_ = 0;
    go::FeatureList list_;
    std::vector<float> chances_;
};

}  // namespace selfplay::alphago
