// From a network's outputs to an Evaluation, for any game: which output is which, softmax over the
// moves asked about, values as probabilities. Pure arithmetic on spans.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "nn/graph.h"
#include "search/evaluator.h"

namespace search {

// Where a graph's outputs have what search reads.
struct OutputMap {
    explicit OutputMap(const nn::Graph& graph);
    // Fails with engine::Error, naming the network, when there is no policy or no value.
    void check(std::string_view name) const;

    std::optional<std::size_t> policy, wdl, value, ownership;
    std::array<std::optional<std::size_t>, figure_count> figures;
};

// Index of the point that a turned board shows at `point`: symmetry 4 exchanges rows and columns,
// then 2 mirrors the columns and 1 the rows.
std::size_t turned_point(std::size_t point, std::size_t size, int symmetry);
// Planes of size * size points each, as the turned board shows them.
void turn_planes(std::span<const float> planes, std::size_t size, int symmetry,
                 std::span<float> turned);

// `logits` to probabilities in place; false when they are no numbers.
bool softmax(std::span<float> logits);
// Three logits (win, draw or no result, loss) to probabilities; without `draws` the middle one has
// none. False when they are no numbers.
bool set_outcomes(std::span<const float> logits, bool draws, Evaluation& to);
// A value in [-1, 1]; false when it is no number.
bool set_value(float value, Evaluation& to);
// The same seen by the other player.
void exchange_players(Evaluation& evaluation);
// Adds `weight` times `part`, whose vectors have the same sizes as those of `sum` or `sum` none.
void add_weighted(const Evaluation& part, float weight, Evaluation& sum);

}  // namespace search
