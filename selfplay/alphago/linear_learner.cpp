#include "selfplay/alphago/linear_learner.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "nn/safetensors.h"

namespace selfplay::alphago {

namespace {

constexpr auto features = static_cast<std::size_t>(go::features::count);
constexpr std::array<const char*, 2> rows = {"squares.rollout", "squares.tree"};

}  // namespace

LinearLearner::LinearLearner() {
    for (auto& policy : policies_) {
        policy.logits.assign(features, 0);
        policy.squares.assign(features, 0);
    }
}

std::optional<std::size_t> LinearLearner::list(const go::Go& game, go::Move played) {
    go::list_features(game, list_);
    const auto found = std::find(list_.moves.begin(), list_.moves.end(), played);
    if (found == list_.moves.end()) return {};
    return static_cast<std::size_t>(found - list_.moves.begin());
}

void LinearLearner::spread(const Policy& policy, const std::vector<int>& ends, int ends_from) {
    chances_.assign(list_.moves.size(), 0);
    for (std::size_t i = 0; i < chances_.size(); ++i) {
        const auto end = ends[i + static_cast<std::size_t>(ends_from)];
        for (int f = list_.starts[i]; f < end; ++f)
            chances_[i] +=
                policy
                    .logits[static_cast<std::size_t>(list_.features[static_cast<std::size_t>(f)])];
    }
    const float most = *std::max_element(chances_.begin(), chances_.end());
    float sum = 0;
    for (float& chance : chances_) sum += chance = std::exp(chance - most);
    for (float& chance : chances_) chance /= sum;
}

void LinearLearner::step(Policy& policy, std::size_t played, const std::vector<int>& ends,
                         int ends_from, float rate) {
    constexpr float least = 1e-5f, floor = 1e-2f;
    spread(policy, ends, ends_from);
    for (std::size_t i = 0; i < chances_.size(); ++i) {
        const float gradient = chances_[i] - (i == played ? 1.0f : 0.0f);
        if (std::abs(gradient) < least) continue;
        const auto end = ends[i + static_cast<std::size_t>(ends_from)];
        for (int f = list_.starts[i]; f < end; ++f) {
            const auto feature =
                static_cast<std::size_t>(list_.features[static_cast<std::size_t>(f)]);
            policy.squares[feature] += gradient * gradient;
            policy.logits[feature] -= rate * gradient / std::sqrt(policy.squares[feature] + floor);
        }
    }
}

void LinearLearner::learn(const go::Go& game, go::Move played, float rate) {
    const auto place = list(game, played);
    if (!place) return;
    ++steps_;
    step(policies_[0], *place, list_.rollout_ends, 0, rate);
    step(policies_[1], *place, list_.starts, 1, rate);
}

void LinearLearner::tally(Policy& policy, std::size_t played) const {
    const auto best = std::max_element(chances_.begin(), chances_.end()) - chances_.begin();
    policy.sums.accuracy += static_cast<std::size_t>(best) == played ? 1 : 0;
    policy.sums.loss -= std::log(std::max(double{chances_[played]}, 1e-12));
}

void LinearLearner::judge(const go::Go& game, go::Move played) {
    const auto place = list(game, played);
    if (!place) return;
    ++judged_;
    spread(policies_[0], list_.rollout_ends, 0);
    tally(policies_[0], *place);
    spread(policies_[1], list_.starts, 1);
    tally(policies_[1], *place);
}

std::array<LinearQuality, 2> LinearLearner::take_quality() {
    std::array<LinearQuality, 2> quality;
    const auto count = static_cast<double>(std::max<std::uint64_t>(std::exchange(judged_, 0), 1));
    for (std::size_t i = 0; i < quality.size(); ++i) {
        const auto sums = std::exchange(policies_[i].sums, {});
        quality[i] = {sums.loss / count, sums.accuracy / count};
    }
    return quality;
}

void LinearLearner::save(const std::filesystem::path& path) const {
    auto graph = search::graph_of({policies_[0].logits, policies_[1].logits});
    graph.facts.steps = static_cast<std::int64_t>(steps_);
    nn::Extras extras;
    for (std::size_t i = 0; i < rows.size(); ++i) extras[rows[i]] = policies_[i].squares;
    engine::write_file(path, nn::to_safetensors(graph, extras));
}

void LinearLearner::restore(const std::filesystem::path& path) {
    const auto bytes = engine::read_file(path);
    try {
        const auto graph = nn::graph_from_safetensors(bytes);
        auto logits = search::logits_of(graph);
        auto extras = nn::extras_from_safetensors(bytes);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            auto& squares = extras[rows[i]];
            if (squares.size() != features)
                engine::fail("expected a row {} to go on from", rows[i]);
            policies_[i].squares = std::move(squares);
        }
        policies_[0].logits = std::move(logits.rollout);
        policies_[1].logits = std::move(logits.tree);
        steps_ = static_cast<std::uint64_t>(graph.facts.steps);
    } catch (const engine::Error& error) {
        engine::fail("{}: {}", path.string(), error.what());
    }
}

}  // namespace selfplay::alphago
