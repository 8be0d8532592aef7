// What plays a game from what a user names: a weight file, a folder of AlphaGo's networks, or what
// this program carries.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

#include "search/alphago_networks.h"
#include "search/embedded_weights.h"
#include "search/load_network.h"
#include "search/params.h"

namespace search {

// What of it plays best on this board, as measured (weights/README.md), searched so: a name among
// embedded_weights, or embedded_alphago; nothing where games played out are stronger.
template <engine::Encoded G>
std::string_view embedded_choice(const G& game, Method method) {
    if constexpr (std::is_same_v<G, go::Go>) {
        constexpr int least_size = 7;
        if (game.size() < least_size && method == Method::automatic) return {};
        if (game.size() == 19 && method == Method::alphago &&
            !embedded_weights(fmt::format("{}/policy", embedded_alphago)).empty())
            return embedded_alphago;
        for (const auto& [size, name] : embedded_large_go)
            if (game.size() >= size && !embedded_weights(name).empty()) return name;
    }
    return G::name;
}

// By a name that embedded_choice says; null for none. Fails and blocks as source_of, and when this
// build carries no such network.
template <engine::Encoded G>
std::shared_ptr<const EvaluatorSource<G>> load_embedded(std::string_view name,
                                                        PrecisionChoice precision, const G& game) {
    if (name.empty()) return nullptr;
    if constexpr (std::is_same_v<G, go::Go>)
        if (name == embedded_alphago) return load_embedded_alphago(precision, game);
    const auto bytes = embedded_weights(name);
    if (bytes.empty()) engine::fail("this build carries no network for {}", G::name);
    return source_of(nn::contents_from_bytes(bytes), precision, game);
}

// Null where embedded_name stands for games played out. Fails and blocks as load_network,
// load_alphago and load_embedded.
template <engine::Encoded G>
std::shared_ptr<const EvaluatorSource<G>> load_player(const std::string& name,
                                                      PrecisionChoice precision, const G& game,
                                                      Method method = Method::automatic) {
    if (name == embedded_name) return load_embedded(embedded_choice(game, method), precision, game);
    if constexpr (std::is_same_v<G, go::Go>)
        if (std::filesystem::is_directory(name)) return load_alphago(name, precision, game);
    return load_network(name, precision, game);
}

}  // namespace search
