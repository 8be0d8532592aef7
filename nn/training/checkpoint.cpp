// A learner in a file and out of it again.
#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "nn/safetensors.h"
#include "nn/training/learner.h"

namespace nn::training {

namespace {

using engine::fail;

// What the rows of an optimiser's state are called.
std::string state_name(Method method, std::size_t row) {
    if (method == Method::sgd) return "momentum";
    return row == 0 ? "adamw.first" : "adamw.second";
}

// How many steps the optimiser's state is of; where a checkpoint does not say so, it is taken for
// as old as the network.
constexpr auto updates_name = "updates";

const std::vector<float>& row_of(const Extras& extras, const std::string& name, std::size_t size) {
    const auto found = extras.find(name);
    if (found == extras.end()) fail("expected a checkpoint with \"{}\", found none", name);
    if (found->second.size() != size)
        fail("expected {} numbers of \"{}\", found {}", size, name, found->second.size());
    return found->second;
}

// The same operations with weights of the same shapes.
bool alike(const Graph& a, const Graph& b) {
    if (a.outputs != b.outputs || a.nodes.size() != b.nodes.size()) return false;
    for (std::size_t n = 0; n < a.nodes.size(); ++n) {
        auto one = a.nodes[n], other = b.nodes[n];
        for (auto* node : {&one, &other})
            for (auto& tensor : node->weights) tensor.values.clear();
        if (one != other) return false;
    }
    return true;
}

void restore_from(const std::string& bytes, const std::filesystem::path& path, Graph& graph,
                  Extras& extras) {
    try {
        graph = graph_from_safetensors(bytes);
        extras = extras_from_safetensors(bytes);
    } catch (const engine::Error& error) {
        fail("{}: {}", path.string(), error.what());
    }
}

}  // namespace

void Learner::save(const std::filesystem::path& path) const {
    Extras extras{{"average", average_},
                  {updates_name, {static_cast<float>(optimiser_.updates())}}};
    for (std::size_t row = 0; row < optimiser_.state().size(); ++row)
        extras[state_name(optimiser_.settings().method, row)] = optimiser_.state()[row];
    engine::write_file(path, to_safetensors(newest(), extras));
}

void Learner::restore(const std::filesystem::path& path) {
    Graph stored;
    Extras extras;
    restore_from(engine::read_file(path), path, stored, extras);
    if (!alike(stored, graph_)) fail("{}: a checkpoint of another network", path.string());
    const auto size = parameters_.size();
    auto average = row_of(extras, "average", size);
    std::vector<std::vector<float>> state;
    for (std::size_t row = 0; row < optimiser_.state().size(); ++row)
        state.push_back(row_of(extras, state_name(optimiser_.settings().method, row), size));
    weights_ = parameters_.read(stored);
    average_ = std::move(average);
    const auto updates = extras.contains(updates_name)
                             ? static_cast<std::int64_t>(row_of(extras, updates_name, 1)[0])
                             : stored.facts.steps;
    optimiser_.restore(std::move(state), updates);
    graph_.facts.steps = stored.facts.steps;
}

}  // namespace nn::training
