// How large the numbers inside a network get in play: nn::calibrate on positions of a game.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "engine/encoding.h"
#include "nn/calibration.h"

namespace search {

namespace calibration {

template <engine::Encoded G>
nn::Positions encoded(const nn::Graph& graph, const engine::Encoding<G>& encoding,
                      const engine::EncodingShape& shape, std::span<const G* const> games) {
    const auto globals = static_cast<std::size_t>(shape.globals);
    nn::Positions positions{static_cast<int>(games.size()), shape.height, {}};
    std::vector<float> planes(games.size() * shape.planes_size()), others(games.size() * globals);
    for (std::size_t i = 0; i < games.size(); ++i)
        encoding.write(*games[i],
                       std::span(planes).subspan(i * shape.planes_size(), shape.planes_size()),
                       std::span(others).subspan(i * globals, globals));
    positions.inputs.push_back(std::move(planes));
    if (graph.input_nodes().size() > 1) positions.inputs.push_back(std::move(others));
    return positions;
}

}  // namespace calibration

// `positions` may be of several board sizes. `graph` plays G. Takes about as long as one evaluation
// in fp32 for each position.
template <engine::Encoded G>
nn::Calibration calibrate(const nn::Graph& graph, std::span<const G> positions) {
    const auto& encoding = engine::find_encoding<G>(graph.facts.encoding);
    std::vector<const G*> left;
    for (const G& game : positions) left.push_back(&game);
    std::vector<nn::Positions> batches;
    while (!left.empty()) {
        const auto shape = encoding.shape(*left.front());
        const auto others = std::stable_partition(left.begin(), left.end(), [&](const G* game) {
            return encoding.shape(*game) == shape;
        });
        const auto alike = static_cast<std::size_t>(others - left.begin());
        batches.push_back(calibration::encoded<G>(graph, encoding, shape,
                                                  std::span<const G* const>(left).first(alike)));
        left.erase(left.begin(), others);
    }
    return nn::calibrate(graph, batches);
}

}  // namespace search
