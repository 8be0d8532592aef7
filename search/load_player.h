// What plays a game from what a user names: a weight file, or a folder of AlphaGo's networks.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>

#include "search/alphago_networks.h"
#include "search/load_network.h"

namespace search {

// Fails and blocks as load_network and load_alphago.
template <engine::Encoded G>
std::shared_ptr<const EvaluatorSource<G>> load_player(const std::string& name,
                                                      PrecisionChoice precision, const G& game) {
    if constexpr (std::is_same_v<G, go::Go>)
        if (std::filesystem::is_directory(name)) return load_alphago(name, precision, game);
    return load_network(name, precision, game);
}

}  // namespace search
