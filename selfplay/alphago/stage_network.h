// AlphaGo's networks as the stages build them, and the batches of positions they learn from.
#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/base/option.h"
#include "nn/graph.h"
#include "nn/training/workers.h"
#include "selfplay/alphago/expert_games.h"
#include "selfplay/training/batch.h"
#include "selfplay/training/folder.h"
#include "selfplay/training/learn_settings.h"

namespace selfplay::alphago {

// `raw`: stones and their past alone, as the paper compares with.
enum class Planes : std::uint8_t { all, raw };
inline constexpr std::array<std::string_view, 2> planes_names = {"all", "raw"};

struct StageNetwork {
    int layers = 12, filters = 64, size = 19;
    Planes planes = Planes::all;

    std::string_view encoding() const { return planes == Planes::raw ? "alphazero" : "alphago48"; }

    static constexpr auto options() {
        using engine::Choice;
        using engine::Option;
        using P = StageNetwork;
        return std::tuple{
            Option<P, int>{"layers", &P::layers, 1, 80, "convolutions before the head"},
            Option<P, int>{"filters", &P::filters, 1, 1024, "of each; the paper: 192"},
            Option<P, int>{"size", &P::size, go::min_size, go::max_size, "of the board"},
            Choice<P, Planes>{"planes", &P::planes, planes_names,
                              "what it sees: all 48 planes, or raw: stones and their past"},
        };
    }
};

// With random weights.
nn::Graph new_policy(const StageNetwork& network, std::uint64_t seed);
// `pooled`: filters of a head that is pooled; 0: the paper's, which is not.
nn::Graph new_value(const StageNetwork& network, std::uint64_t seed, int pooled = 0);
// The layers and filters of a network that a stage made.
StageNetwork shape_of(const nn::Facts& facts);
// A value network that begins with the convolutions of a policy network, its head random.
nn::Graph value_upon(const nn::Graph& policy, std::uint64_t seed, int pooled = 0);

// A network with batch norms to learn with, fitted to the samples that `draw` yields for such terms
// so that it computes what it did. Where the folder has a checkpoint, whose weights come in place
// of these, nothing is fitted.
nn::Graph with_norms(
    const nn::Graph& fresh, const training::RunFolder& folder,
    const training::LearnSettings& learning, int threads,
    const std::function<const nn::training::Samples&(std::span<const nn::training::Term>)>& draw);

// Has the norm behind that convolution answer with mean 0 and deviation 1.
void standardise(nn::Graph& normed, std::string_view convolution);

// Positions of expert games as batches, encoded on threads of its own. One owner, one thread.
class ExpertBatches {
   public:
    ExpertBatches(std::string_view encoding, int threads)
        : encoding_(engine::find_encoding<go::Go>(encoding)), workers_(threads) {}

    // One symmetry a place. Shown until the next call.
    const nn::training::Samples& make(std::span<const ExpertPlace> places,
                                      std::span<const int> symmetries,
                                      std::span<const nn::training::Term> terms);

   private:
    const engine::Encoding<go::Go>& encoding_;
    nn::training::Workers workers_;
    std::vector<training::Lesson> lessons_;
    training::Batch batch_;
};

}  // namespace selfplay::alphago
