#include "protocols/go_judge.h"

#include <utility>

namespace protocols {

namespace {

using search::Milliseconds;

constexpr std::uint64_t simulations = 3000, fewest_simulations = 500, quick_simulations = 200;
// Two walls that divide a board of 9x9 leave less.
constexpr double too_empty = 5.0 / 6;

search::SearchParams small(search::SearchParams params) {
    params.memory_mib = 16;
    params.early_end = false;
    return params;
}

// The position as it is searched: by area, where capturing what is dead costs nothing.
go::Go by_area(const go::Go& game) {
    auto bare = without_history(game);
    auto rules = game.rules();
    rules.scoring = go::Scoring::area;
    rules.tax = go::Tax::none;
    bare.set_rules(rules);
    bare.set_to_play(engine::Player::first);
    return bare;
}

}  // namespace

go::Go without_history(const go::Go& game) {
    go::Go bare(game.size(), game.komi(), game.rules());
    for (int y = 0; y < game.size(); ++y)
        for (int x = 0; x < game.size(); ++x)
            if (const auto stone = game.at({x, y})) bare.set_up({x, y}, stone);
    bare.set_handicap(game.handicap());
    bare.set_to_play(game.to_play());
    return bare;
}

bool bears_out(search::Searcher<go::Go>& searcher, const go::Go& root, const Reading& reading,
               const Ending& ending, std::optional<Milliseconds> time) {
    if (!searcher.has_network() || !ending.restricts()) return true;
    constexpr float even = 0, little = 0.05f;  // of the value, in [-1, 1]
    search::Limits limits;
    limits.simulations = quick_simulations;
    limits.time = time;
    searcher.set_position(root);
    const auto best = [&]() -> std::optional<float> {
        const auto picture = searcher.think(limits);
        const bool known = !picture.moves.empty() && picture.moves[0].visits > 0;
        return known ? std::optional(picture.moves[0].value) : std::nullopt;
    };
    const auto free = best();
    if (!free) return true;
    if ((*free > even) != (lead_of(root.to_play(), reading.played_out()) > 0)) return false;
    // Elsewhere two passes end no game, and the search does not know what is agreed after them.
    if (agrees_on_dead_stones(root.rules())) return true;
    limits.only = ending.pass ? std::vector{go::Go::pass} : ending.only;
    const auto bound = best();
    return !bound || *bound > *free - little;
}

GoJudge::GoJudge(const search::SearchParams& params) : searcher_(small(params)) {}

void GoJudge::set_params(const search::SearchParams& params) {
    searcher_.set_params(small(params));
}

Reading GoJudge::read(const go::Go& game, std::optional<Milliseconds> time) {
    const auto bare = by_area(game);
    if (!read_ || hasty_ || *read_ != bare) {
        search::Limits limits;
        limits.simulations = simulations;
        if (time) limits.time = *time / 2;
        hasty_ = false;
        looks_ = look(bare, limits);
        read_ = bare;
    }
    return {game, looks_};
}

bool GoJudge::looks_over(const go::Go& game, std::optional<Milliseconds> time) {
    if (is_emptier(game, too_empty)) return false;
    search::Limits limits;
    limits.simulations = quick_simulations;
    if (time) limits.time = *time / 2;
    const bool hasty = std::exchange(hasty_, false);
    const Reading reading(game, look(by_area(game), limits));
    hasty_ = hasty;
    return reading.borders_closed();
}

Looks GoJudge::look(const go::Go& game, const search::Limits& limits) {
    return {look_after(game, engine::Player::first, limits),
            look_after(game, engine::Player::second, limits)};
}

Look GoJudge::look_after(const go::Go& game, engine::Player mover, const search::Limits& limits) {
    go::Go root = game;
    root.set_to_play(mover);
    searcher_.set_position(root);
    searcher_.clear();
    const auto picture = searcher_.think(limits);
    hasty_ = hasty_ || picture.simulations < fewest_simulations;
    Look seen{picture.owners, picture.value};
    seen.owners.resize(static_cast<std::size_t>(game.size()) *
                       static_cast<std::size_t>(game.size()));
    if (mover == engine::Player::first) return seen;
    for (float& owner : seen.owners) owner = -owner;
    seen.value = -seen.value;
    return seen;
}

}  // namespace protocols
