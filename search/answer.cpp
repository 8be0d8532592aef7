#include "search/answer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"

namespace search {

namespace {

std::optional<std::size_t> find_output(const nn::Graph& graph, std::string_view name) {
    for (std::size_t i = 0; i < graph.outputs.size(); ++i)
        if (graph.outputs[i].name == name) return i;
    return std::nullopt;
}

void add_weighted(const std::vector<float>& part, float weight, std::vector<float>& sum) {
    sum.resize(part.size());
    for (std::size_t i = 0; i < part.size(); ++i) sum[i] += weight * part[i];
}

}  // namespace

OutputMap::OutputMap(const nn::Graph& graph)
    : policy(find_output(graph, "policy")),
      wdl(find_output(graph, "wdl")),
      value(find_output(graph, "value")),
      ownership(find_output(graph, "ownership")) {
    for (std::size_t i = 0; i < figure_count; ++i) figures[i] = find_output(graph, figure_names[i]);
    // Ours, and KataGo's first ones, know of the lead what they expect of the score.
    auto& lead = figures[static_cast<std::size_t>(Figure::lead)];
    if (!lead) lead = figures[static_cast<std::size_t>(Figure::score)];
}

void OutputMap::check(std::string_view name) const {
    if (!policy) engine::fail("the network \"{}\" has no policy", name);
    if (!wdl && !value) engine::fail("the network \"{}\" has no value", name);
}

std::size_t turned_point(std::size_t point, std::size_t size, int symmetry) {
    auto column = point % size, row = point / size;
    if ((symmetry & 4) != 0) std::swap(column, row);
    if ((symmetry & 2) != 0) column = size - 1 - column;
    if ((symmetry & 1) != 0) row = size - 1 - row;
    return row * size + column;
}

void turn_planes(std::span<const float> planes, std::size_t size, int symmetry,
                 std::span<float> turned) {
    const auto points = size * size;
    for (std::size_t point = 0; point < points; ++point) {
        const auto from = turned_point(point, size, symmetry);
        for (std::size_t at = 0; at < planes.size(); at += points)
            turned[at + point] = planes[at + from];
    }
}

bool softmax(std::span<float> logits) {
    if (logits.empty()) return true;
    const float most = *std::max_element(logits.begin(), logits.end());
    float sum = 0;
    for (float& logit : logits) sum += logit = std::exp(logit - most);
    for (float& share : logits) share /= sum;
    return std::isfinite(sum);
}

bool set_outcomes(std::span<const float> logits, bool draws, Evaluation& to) {
    std::array<float, 3> shares{logits[0], logits[2], logits[1]};
    if (!softmax(std::span(shares).first(draws ? 3 : 2))) return false;
    to.win = shares[0];
    to.loss = shares[1];
    to.draw = draws ? shares[2] : 0;
    return true;
}

bool set_value(float value, Evaluation& to) {
    if (!std::isfinite(value)) return false;
    to.win = (1 + value) / 2;
    to.loss = (1 - value) / 2;
    to.draw = 0;
    return true;
}

void exchange_players(Evaluation& evaluation) { std::swap(evaluation.win, evaluation.loss); }

void add_weighted(const Evaluation& part, float weight, Evaluation& sum) {
    add_weighted(part.priors, weight, sum.priors);
    add_weighted(part.owners, weight, sum.owners);
    sum.win += weight * part.win;
    sum.loss += weight * part.loss;
    sum.draw += weight * part.draw;
    for (std::size_t i = 0; i < figure_count; ++i) sum.figures[i] += weight * part.figures[i];
}

}  // namespace search
