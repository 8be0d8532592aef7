#include "nn/training/learner.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/error.h"
#include "nn/training/tape.h"

namespace nn::training {

namespace {

using engine::fail;

LearnerSettings checked(const Graph& graph, LearnerSettings settings) {
    if (settings.terms.empty()) settings.terms = usual_terms(graph);
    if (settings.terms.empty()) fail("no output of this network has a loss");
    if (settings.threads < 1 || settings.threads > 1024)
        fail("expected 1 to 1024 threads, found {}", settings.threads);
    if (settings.micro_batch < 1)
        fail("expected micro-batches of 1 sample or more, found {}", settings.micro_batch);
    for (const float share : {settings.average, settings.norm_average})
        if (!(share >= 0 && share < 1))
            fail("expected an average of 0 to under 1, found {}", share);
    return settings;
}

std::vector<int> outputs_of(const Graph& graph, const std::vector<Term>& terms) {
    std::vector<int> places;
    for (const auto& term : terms) {
        const auto found =
            std::find_if(graph.outputs.begin(), graph.outputs.end(),
                         [&](const Output& output) { return output.name == term.output; });
        if (found == graph.outputs.end()) fail("the network has no output \"{}\"", term.output);
        places.push_back(static_cast<int>(found - graph.outputs.begin()));
    }
    return places;
}

}  // namespace

// What one thread works with. Its trainer is made on its own thread.
struct Learner::Replica {
    std::unique_ptr<Trainer> trainer;
    std::vector<float> gradients;
    std::vector<std::vector<float>> outputs, output_gradients;
    std::vector<Cost> costs;
};

Learner::Learner(Graph graph, LearnerSettings settings)
    : graph_(std::move(graph)),
      settings_(checked(graph_, std::move(settings))),
      parameters_(graph_),
      optimiser_(parameters_, settings_.optimiser),
      term_outputs_(outputs_of(graph_, settings_.terms)),
      weights_(parameters_.read(graph_)),
      average_(weights_),
      workers_(settings_.threads) {
    for (int i = 0; i < settings_.threads; ++i) replicas_.push_back(std::make_unique<Replica>());
    workers_.run(
        [&](int i) { replicas_[at(i)]->trainer = make_trainer(graph_, settings_.precision); });
}

Learner::~Learner() {
    workers_.run([&](int i) { replicas_[at(i)]->trainer.reset(); });
}

Report Learner::step(const Samples& samples) {
    auto report = pass(samples, weights_, Purpose::learn);
    sum_gradients();
    const auto& gradients = replicas_[0]->gradients;
    report.gradient_norm = norm_of(gradients, parameters_);
    find_fault(report, gradients);
    if (report.fault.empty()) apply(gradients, samples.size);
    return report;
}

Report Learner::evaluate(const Samples& samples) { return pass(samples, weights_, Purpose::judge); }

Report Learner::pass(const Samples& samples, std::span<const float> weights, Purpose purpose) {
    assert(samples.targets.size() == settings_.terms.size());
    infer_shapes(graph_, samples.board);
    loaded_ = weights;
    workers_.run([&](int i) { run_share(*replicas_[at(i)], samples, i, purpose); });
    return summary(samples);
}

void Learner::run_share(Replica& replica, const Samples& samples, int share, Purpose purpose) {
    const int first = samples.size * share / settings_.threads;
    const int end = samples.size * (share + 1) / settings_.threads;
    replica.costs.assign(settings_.terms.size(), {});
    replica.gradients.assign(parameters_.size(), 0.0f);
    replica.trainer->load(loaded_);
    // Parts as even as can be: a batch norm of few samples learns little.
    const int parts = (end - first + settings_.micro_batch - 1) / settings_.micro_batch;
    for (int part = 0; part < parts; ++part) {
        const int from = first + (end - first) * part / parts;
        const int to = first + (end - first) * (part + 1) / parts;
        run_part(replica, samples, from, to - from, purpose);
    }
    if (purpose != Purpose::judge) replica.trainer->collect(replica.gradients);
}

void Learner::run_part(Replica& replica, const Samples& samples, int first, int count,
                       Purpose purpose) {
    std::vector<std::span<const float>> inputs, output_gradients(graph_.outputs.size());
    for (const auto& input : samples.inputs) {
        const auto width = input.size() / at(samples.size);
        inputs.push_back(input.subspan(at(first) * width, at(count) * width));
    }
    const auto shapes = infer_shapes(graph_, samples.board);
    std::vector<std::span<float>> outputs;
    replica.outputs.resize(graph_.outputs.size());
    replica.output_gradients.resize(graph_.outputs.size());
    for (std::size_t o = 0; o < graph_.outputs.size(); ++o) {
        const auto width = shapes[at(graph_.outputs[o].node)].size(samples.board * samples.board);
        replica.outputs[o].resize(width * at(count));
        replica.output_gradients[o].resize(width * at(count));
        outputs.emplace_back(replica.outputs[o]);
    }
    replica.trainer->forward({count, samples.board, inputs, outputs}, purpose == Purpose::judge
                                                                          ? Statistics::running
                                                                          : Statistics::of_batch);
    for (std::size_t t = 0; t < settings_.terms.size(); ++t) {
        const auto o = at(term_outputs_[t]);
        const float factor = settings_.terms[t].weight / static_cast<float>(samples.size);
        replica.costs[t] += measure(settings_.terms[t].loss, replica.outputs[o], samples.targets[t],
                                    {count, first, factor}, replica.output_gradients[o]);
        output_gradients[o] = replica.output_gradients[o];
    }
    if (purpose == Purpose::learn) replica.trainer->backward(output_gradients);
}

Report Learner::summary(const Samples& samples) const {
    Report report;
    report.costs.resize(settings_.terms.size());
    for (const auto& replica : replicas_)
        for (std::size_t t = 0; t < report.costs.size(); ++t) report.costs[t] += replica->costs[t];
    for (std::size_t t = 0; t < report.costs.size(); ++t)
        report.loss += settings_.terms[t].weight * report.costs[t].loss / samples.size;
    return report;
}

void Learner::sum_gradients() {
    auto& sum = replicas_[0]->gradients;
    for (std::size_t r = 1; r < replicas_.size(); ++r)
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += replicas_[r]->gradients[i];
}

void Learner::find_fault(Report& report, std::span<const float> gradients) const {
    for (std::size_t t = 0; t < report.costs.size(); ++t)
        if (!std::isfinite(report.costs[t].loss)) {
            report.fault = fmt::format("the loss of \"{}\" is {}", settings_.terms[t].output,
                                       report.costs[t].loss);
            return;
        }
    for (const auto& slot : parameters_.slots())
        for (const float x : gradients.subspan(slot.offset, slot.size))
            if (!std::isfinite(x)) {
                report.fault = fmt::format("the gradient of \"{}\" holds {}",
                                           graph_.nodes[at(slot.node)].name, x);
                return;
            }
}

void Learner::apply(std::span<const float> gradients, int samples) {
    optimiser_.step(graph_.facts.steps, gradients, weights_);
    observe(gradients, samples, settings_.norm_average, weights_);
    const float old = settings_.average;
    for (std::size_t i = 0; i < average_.size(); ++i)
        average_[i] = old * average_[i] + (1 - old) * weights_[i];
    ++graph_.facts.steps;
}

// `sums` hold what trainers collect in the places of statistics.
void Learner::observe(std::span<const float> sums, int samples, float kept,
                      std::span<float> weights) {
    const auto count = static_cast<float>(samples);
    for (const auto& slot : parameters_.slots()) {
        if (slot.role != Role::statistic) continue;
        const bool variance = slot.weight == 1;
        for (std::size_t i = 0; i < slot.size; ++i) {
            const auto place = slot.offset + i;
            float seen = sums[place] / count;
            // The slot of the mean comes just before that of the variance.
            const float mean = variance ? sums[place - slot.size] / count : 0;
            if (variance) seen = std::max(seen - mean * mean, 0.0f);
            weights[place] = kept * weights[place] + (1 - kept) * seen;
        }
    }
}

Graph Learner::averaged_on(const Samples& samples) {
    pass(samples, average_, Purpose::observe);
    sum_gradients();
    auto weights = average_;
    observe(replicas_[0]->gradients, samples.size, 0, weights);
    Graph graph = graph_;
    parameters_.write(weights, graph);
    return graph;
}

Graph Learner::newest() const {
    Graph graph = graph_;
    parameters_.write(weights_, graph);
    return graph;
}

Graph Learner::averaged() const {
    Graph graph = graph_;
    parameters_.write(average_, graph);
    return graph;
}

}  // namespace nn::training
