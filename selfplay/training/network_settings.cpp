#include "selfplay/training/network_settings.h"

#include <algorithm>
#include <string>

#include "engine/base/error.h"
#include "nn/builders.h"
#include "nn/growth.h"
#include "nn/load.h"

namespace selfplay::training {

namespace {

bool same_shapes(const nn::Node& a, const nn::Node& b) {
    return a.operation == b.operation && a.inputs == b.inputs && a.activation == b.activation &&
           std::equal(a.weights.begin(), a.weights.end(), b.weights.begin(), b.weights.end(),
                      [](const auto& one, const auto& other) { return one.shape == other.shape; });
}

std::string description(const nn::Graph& graph) {
    return fmt::format("{}, {} blocks, {} channels, {}, {} parameters", graph.facts.game,
                       graph.facts.blocks, graph.facts.channels, graph.facts.encoding,
                       nn::parameter_count(graph));
}

}  // namespace

nn::Graph new_network(const NetworkSettings& settings, std::string_view game,
                      const engine::EncodingShape& shape, engine::Random& random) {
    const bool go = game == "go", flat = settings.heads == HeadKind::flat;
    nn::TowerDescription tower;
    tower.facts.game = game;
    tower.facts.encoding = settings.encoding_name();
    tower.facts.name = fmt::format("{} {}x{}", game, settings.blocks, settings.channels);
    tower.facts.source = "sanban train";
    tower.facts.board = go && !flat ? 0 : shape.height;
    tower.facts.blocks = settings.blocks;
    tower.facts.channels = settings.channels;
    tower.planes = shape.planes;
    tower.globals = shape.globals;
    tower.policy_size = shape.policy_size;
    tower.policy = !go    ? nn::PolicyHead::planes
                   : flat ? nn::PolicyHead::flat
                          : nn::PolicyHead::points;
    if (!go) tower.move_planes = shape.policy_size / static_cast<int>(shape.points());
    tower.attention = static_cast<nn::Attention>(settings.attention);
    tower.flat_value = flat;
    tower.value_width = settings.value_width;
    tower.wdl = settings.wdl;
    tower.ownership = go && settings.ownership;
    tower.score = go && settings.score;
    tower.moves_left = settings.moves_left;
    return nn::build_tower(tower, random);
}

nn::Graph network_like(const nn::Graph& fresh, const std::filesystem::path& file) {
    auto graph = nn::load(file);
    const bool same = graph.facts.game == fresh.facts.game &&
                      graph.facts.encoding == fresh.facts.encoding &&
                      graph.outputs == fresh.outputs &&
                      std::equal(graph.nodes.begin(), graph.nodes.end(), fresh.nodes.begin(),
                                 fresh.nodes.end(), same_shapes);
    if (same) return graph;
    if (auto larger = nn::grown(graph, fresh)) return *std::move(larger);
    engine::fail("{}: built otherwise than the settings say: {} and not {}", file.string(),
                 description(graph), description(fresh));
}

}  // namespace selfplay::training
