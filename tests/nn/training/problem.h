// A network with a batch of random samples that it can learn by heart.
#pragma once

#include <string>
#include <vector>

#include "../naive.h"
#include "nn/builders.h"
#include "nn/training/learner.h"

namespace nn::training {

struct Problem {
    std::vector<std::vector<float>> inputs, targets;
    std::vector<int> starts, moves;
    Samples samples;

    Problem(const Graph& graph, int board, int size, std::uint64_t seed = 1) {
        engine::Random random(seed);
        samples.size = size;
        samples.board = board;
        const auto shapes = infer_shapes(graph, board);
        const auto width = [&](int n) { return shapes[naive::at(n)].size(board * board); };
        for (const int n : graph.input_nodes()) {
            inputs.emplace_back(width(n) * naive::at(size));
            for (auto& x : inputs.back()) x = static_cast<float>(random.below(2));
        }
        for (const auto& term : usual_terms(graph))
            add_target(term.loss, width(*graph.output(term.output)), random);
        for (const auto& input : inputs) samples.inputs.emplace_back(input);
        for (std::size_t t = 0; t < targets.size(); ++t)
            samples.targets.push_back({targets[t], starts, moves, true, {}});
    }
    Problem(const Problem&) = delete;
    Problem& operator=(const Problem&) = delete;

   private:
    void add_target(Loss loss, std::size_t width, engine::Random& random) {
        auto& target = targets.emplace_back();
        for (int i = 0; i < samples.size; ++i) switch (loss) {
                case Loss::policy:  // every third move is legal, one of them is played
                    starts.push_back(static_cast<int>(moves.size()));
                    for (int m = i % 3; m < static_cast<int>(width); m += 3) moves.push_back(m);
                    target.resize(moves.size());
                    target[naive::at(starts.back()) +
                           naive::at(random.below(static_cast<int>(width) / 3))] = 1;
                    break;
                case Loss::distribution:
                    target.resize(target.size() + width);
                    target[target.size() - naive::at(random.below(static_cast<int>(width))) - 1] =
                        1;
                    break;
                case Loss::square:
                case Loss::ownership:
                    for (std::size_t j = 0; j < width; ++j)
                        target.push_back(static_cast<float>(random.below(2) * 2 - 1));
                    break;
                case Loss::score:
                case Loss::moves_left:
                    target.push_back(static_cast<float>(random.below(10)));
                    break;
            }
        if (loss == Loss::policy) starts.push_back(static_cast<int>(moves.size()));
    }
};

inline TowerDescription small_tower() {
    TowerDescription about;
    about.facts.board = 5;
    about.facts.blocks = 1;
    about.facts.channels = 16;
    about.planes = 4;
    about.policy_size = 26;
    about.value_width = 32;
    return about;
}

inline Graph built(const TowerDescription& about, std::uint64_t seed = 1) {
    engine::Random random(seed);
    return build_tower(about, random);
}

}  // namespace nn::training
