#include "selfplay/alphago/stage_network.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "nn/builders.h"
#include "nn/passes.h"
#include "nn/training/norms.h"
#include "selfplay/training/student.h"

namespace selfplay::alphago {

namespace {

nn::Facts facts_of(const StageNetwork& network, std::string_view encoding, std::string_view kind) {
    nn::Facts facts;
    facts.game = go::Go::name;
    facts.encoding = encoding;
    facts.name = fmt::format("alphago {} {}x{}", kind, network.layers, network.filters);
    facts.source = fmt::format("sanban learn {}", kind);
    facts.board = network.size;
    facts.blocks = network.layers;
    facts.channels = network.filters;
    return facts;
}

int planes_of(const nn::Facts& facts) {
    return engine::find_encoding<go::Go>(facts.encoding).shape(go::Go(facts.board)).planes;
}

// The weights of a convolution; planes that it did not see begin without influence.
void take_over(const nn::Node& from, nn::Node& to) {
    const auto& weights = from.weights[0];
    auto& all = to.weights[0];
    const auto rows = static_cast<std::size_t>(all.shape[0]);
    const auto had = weights.values.size() / rows, has = all.values.size() / rows;
    if (weights.shape[0] != all.shape[0] || weights.shape[2] != all.shape[2] || had > has)
        engine::fail("the policy network's {} does not fit a value network", from.name);
    std::fill(all.values.begin(), all.values.end(), 0.0f);
    for (std::size_t row = 0; row < rows; ++row)
        std::copy_n(weights.values.begin() + static_cast<std::ptrdiff_t>(row * had), had,
                    all.values.begin() + static_cast<std::ptrdiff_t>(row * has));
    for (std::size_t i = 1; i < to.weights.size() && i < from.weights.size(); ++i)
        to.weights[i] = from.weights[i];
}

}  // namespace

nn::Graph new_policy(const StageNetwork& network, std::uint64_t seed) {
    engine::Random random(seed);
    const auto facts = facts_of(network, network.encoding(), "policy");
    return nn::build_alphago_policy(facts, planes_of(facts), random);
}

nn::Graph new_value(const StageNetwork& network, std::uint64_t seed, int pooled) {
    engine::Random random(seed);
    const auto facts = facts_of(network, "alphago49", "value");
    return nn::build_alphago_value(facts, planes_of(facts), random, pooled);
}

StageNetwork shape_of(const nn::Facts& facts) {
    StageNetwork network;
    network.layers = facts.blocks;
    network.filters = facts.channels;
    network.size = facts.board;
    return network;
}

nn::Graph value_upon(const nn::Graph& policy, std::uint64_t seed, int pooled) {
    auto value = new_value(shape_of(policy.facts), seed, pooled);
    for (auto& node : value.nodes) {
        const auto same = [&](const nn::Node& other) {
            return other.operation == nn::Operation::convolution && other.name == node.name;
        };
        const auto found = std::find_if(policy.nodes.begin(), policy.nodes.end(), same);
        if (node.operation == nn::Operation::convolution && found != policy.nodes.end())
            take_over(*found, node);
    }
    return value;
}

nn::Graph with_norms(
    const nn::Graph& fresh, const training::RunFolder& folder,
    const training::LearnSettings& learning, int threads,
    const std::function<const nn::training::Samples&(std::span<const nn::training::Term>)>& draw) {
    auto normed = nn::unfold_batch_norms(fresh);
    if (folder.has_checkpoint()) return normed;
    const auto learner = training::learner_settings(learning, normed, threads);
    return nn::training::fit_norms(std::move(normed), draw(learner.terms), learner);
}

void standardise(nn::Graph& normed, std::string_view convolution) {
    for (auto& node : normed.nodes) {
        if (node.operation != nn::Operation::batch_norm) continue;
        if (normed.nodes[static_cast<std::size_t>(node.inputs[0])].name != convolution) continue;
        auto &scale = node.weights[2].values, &shift = node.weights[3].values;
        std::fill(scale.begin(), scale.end(), 1.0f);
        std::fill(shift.begin(), shift.end(), 0.0f);
    }
}

const nn::training::Samples& ExpertBatches::make(std::span<const ExpertPlace> places,
                                                 std::span<const int> symmetries,
                                                 std::span<const nn::training::Term> terms) {
    lessons_.resize(places.size());
    const auto threads = static_cast<std::size_t>(workers_.count());
    workers_.run([&](int worker) {
        for (auto i = static_cast<std::size_t>(worker); i < places.size(); i += threads)
            training::write_lesson(record_of(places[i]), places[i].turn, encoding_, symmetries[i],
                                   {}, lessons_[i]);
    });
    batch_.fill(lessons_, places[0].game->size, terms);
    return batch_.samples();
}

}  // namespace selfplay::alphago
