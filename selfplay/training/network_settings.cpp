#include "selfplay/training/network_settings.h"

#include <string>

#include "nn/builders.h"

namespace selfplay::training {

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

}  // namespace selfplay::training
