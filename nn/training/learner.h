// A network that learns: hand it batches of samples and it steps, reports what they cost, and gives
// the network to play with. It keeps one trainer a core, each with its share of every batch, and
// sums their gradients in one order, so that equal batches give equal weights for a given number of
// threads. Calls come from one thread at a time and block until done.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nn/training/loss.h"
#include "nn/training/optimiser.h"
#include "nn/training/trainer.h"
#include "nn/training/workers.h"

namespace nn::training {

struct LearnerSettings {
    OptimiserSettings optimiser = {};
    std::vector<Term> terms = {};  // usual_terms of the graph when empty
    Precision precision = Precision::fp32;
    int threads = 1;
    int micro_batch = 64;  // samples that a trainer takes at once; batch norms see these alone
    // What of the averaged weights a step keeps; 0: play with the newest weights.
    float average = 0;
    float norm_average = 0.99f;  // alike, of the running statistics of batch norms
};

// A batch; whoever calls owns what the spans show. The gradient is that of the weighted sum of the
// terms over samples, divided by `size`: an absent target counts as zero.
struct Samples {
    int size = 0;
    int board = 0;                               // side
    std::vector<std::span<const float>> inputs;  // in the order of Graph::input_nodes
    std::vector<Target> targets;                 // in the order of the terms
};

struct Report {
    std::vector<Cost> costs;  // per term
    double loss = 0;          // the weighted sum of the terms' means over all samples
    double gradient_norm = 0;
    // Empty, or what is no finite number: then the weights are as they were.
    std::string fault;
};

class Learner {
   public:
    // `graph` must be valid. Fails with engine::Error on settings that cannot be.
    Learner(Graph graph, LearnerSettings settings);
    ~Learner();

    Report step(const Samples& samples);
    // What samples cost with running statistics; nothing is learned.
    Report evaluate(const Samples& samples);

    // The network as it stands, or with averaged weights, to play with.
    Graph newest() const;
    Graph averaged() const;
    // The averaged weights with the statistics of their batch norms measured on these samples: an
    // average of statistics belongs to no network (Izmailov et al. 2018).
    Graph averaged_on(const Samples& samples);

    std::int64_t steps() const { return graph_.facts.steps; }
    const std::vector<Term>& terms() const { return settings_.terms; }

    // Everything that a later step depends on, apart from the settings. The file is also a network:
    // the newest. Whatever fails, an old file stays whole.
    void save(const std::filesystem::path& path) const;
    // Fails with engine::Error on a file that is damaged, of another network or another optimiser.
    void restore(const std::filesystem::path& path);

   private:
    struct Replica;

    enum class Purpose : std::uint8_t { learn, judge, observe };  // observe: batch norms

    Report pass(const Samples& samples, std::span<const float> weights, Purpose purpose);
    void run_share(Replica& replica, const Samples& samples, int share, Purpose purpose);
    void run_part(Replica& replica, const Samples& samples, int first, int count, Purpose purpose);
    void sum_gradients();
    void observe(std::span<const float> sums, int samples, float kept, std::span<float> weights);
    Report summary(const Samples& samples) const;
    void find_fault(Report& report, std::span<const float> gradients) const;
    void apply(std::span<const float> gradients, int samples);

    Graph graph_;  // the newest weights are in weights_, not here
    LearnerSettings settings_;
    Parameters parameters_;
    Optimiser optimiser_;
    std::vector<int> term_outputs_;  // per term, the place in Graph::outputs
    std::vector<float> weights_, average_;
    std::span<const float> loaded_;  // the weights that a pass runs with
    std::vector<std::unique_ptr<Replica>> replicas_;
    Workers workers_;
};

}  // namespace nn::training
