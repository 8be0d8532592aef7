// Games that a network plays against itself by drawing moves from its policy: the positions that
// networks are calibrated on, and compared over, when nobody brings others.
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include "engine/base/random.h"
#include "search/evaluator.h"

namespace search {

// Positions on the way of one player against itself, a new game where one ends.
template <engine::Game G>
using Line = std::vector<G>;

namespace sampling {

inline int drawn(std::span<const float> priors, engine::Random& random) {
    constexpr int units = 1 << 24;
    float left = static_cast<float>(random.below(units)) / static_cast<float>(units);
    for (std::size_t i = 0; i + 1 < priors.size(); ++i)
        if ((left -= priors[i]) < 0) return static_cast<int>(i);
    return static_cast<int>(priors.size()) - 1;
}

template <engine::Game G>
void advance(Evaluator<G>& evaluator, std::vector<Line<G>>& lines, engine::Random& random) {
    std::vector<engine::MoveList> moves;
    std::vector<Evaluation> answers(lines.size());
    std::vector<Query<G>> queries;
    moves.reserve(lines.size());
    for (const auto& line : lines) {
        moves.push_back(line.back().legal_moves());
        queries.push_back({&line.back(), &moves.back(), 0, &answers[queries.size()]});
    }
    evaluator.evaluate(queries);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        G next = lines[i].back();
        next.play(moves[i][drawn(answers[i].priors, random)]);
        const bool over = next.outcome() != engine::Outcome::ongoing;
        lines[i].push_back(over ? lines[i].front() : next);
    }
}

}  // namespace sampling

// Where to begin: in games with boards of several sizes a new game on a small and on a large one
// that a network for `board` (0: any) serves, and on the given game's.
template <engine::Game G>
std::vector<G> sample_starts([[maybe_unused]] int board, [[maybe_unused]] const G& game) {
    if constexpr (requires {
                      { game.size() } -> std::convertible_to<int>;
                      G(9);
                  }) {
        if (board != 0) return {G(board)};
        std::vector<G> starts{G(9), G(19)};
        if (const int own = game.size(); own != 9 && own != 19) starts.emplace_back(own);
        return starts;
    } else {
        return {G()};
    }
}

// `count` lines of `plies` moves each, all evaluated together move by move.
template <engine::Game G>
std::vector<Line<G>> sample_lines(Evaluator<G>& evaluator, const G& start, int count, int plies,
                                  engine::Random& random) {
    std::vector<Line<G>> lines(static_cast<std::size_t>(count), Line<G>{start});
    for (int ply = 0; ply < plies; ++ply) sampling::advance(evaluator, lines, random);
    return lines;
}

// Some `most` of the positions, evenly spread.
template <engine::Game G>
void pick(const Line<G>& line, std::size_t most, std::vector<G>& to) {
    const std::size_t stride = std::max<std::size_t>(line.size() / most, 1);
    for (std::size_t i = stride / 2; i < line.size(); i += stride) to.push_back(line[i]);
}

}  // namespace search
