#include "engine/go/rollouts.h"

#include <algorithm>
#include <numeric>
#include <type_traits>

#include "engine/go/linear_policy.h"
#include "engine/go/rollout_board.h"
#include "engine/go/rollout_policy.h"
#include "engine/go/score.h"
#include "engine/go/softmax_policy.h"

namespace go {

namespace {

// What Black put on the board more than White: the difference between area and territory.
int more_played_by_black(const Go& game) {
    const auto played = [&](Player player) {
        const auto side = player == Player::first ? 0u : 1u;
        return static_cast<int>(game.board().stones()[side].count()) + game.captured_by(~player);
    };
    return played(Player::first) - played(Player::second);
}

}  // namespace

struct AtRandom {
    template <int most_size>
    class Game {
       public:
        using Board = RolloutBoard<most_size>;
        explicit Game(const Go& from) : board_(from) {}
        const Board& board() const { return board_; }
        template <Colour colour>
        int play(engine::Random& random) {
            return board_.template play_random<colour>(random);
        }

       private:
        Board board_;
    };
};

struct ByPolicy {
    template <int most_size>
    using Game = RolloutPolicy<most_size>;
};

namespace {

template <class Policy, int most_size>
auto start(const Policy* policy, const Go& from) {
    if constexpr (std::is_same_v<Policy, LinearPolicies>)
        return SoftmaxPolicy<most_size>(policy->rollout, from);
    else
        return typename Policy::template Game<most_size>(from);
}

}  // namespace

// Returns Black's lead in area, and leaves the owners behind.
template <class Policy>
template <int most_size>
int RolloutsBy<Policy>::play_on(const Go& from, engine::Random& random) {
    auto rollout = start<Policy, most_size>(policy_.get(), from);
    const int size = from.size(), most_moves = 3 * size * size;
    // The generator's state stays in registers.
    engine::Random local = random;
    bool black = from.to_play() == Player::first;
    for (int moves = 0, passes = from.consecutive_passes(); moves < most_moves && passes < 2;
         ++moves, black = !black) {
        const int played = black ? rollout.template play<Colour::black>(local)
                                 : rollout.template play<Colour::white>(local);
        passes = played != 0 ? 0 : passes + 1;
    }
    random = local;
    const auto& board = rollout.board();
    int lead = 0;
    std::size_t next = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            firsts_[static_cast<std::size_t>(from.board().index(x, y))] = board.first(x, y);
            lead += owners_[next++] = board.owner(x, y);
        }
    return lead;
}

template <class Policy>
engine::RolloutResult RolloutsBy<Policy>::play(const Go& from, engine::Random& random) {
    if (from.outcome() != Outcome::ongoing) return finished(from);
    const int area = from.size() <= 9    ? play_on<9>(from, random)
                     : from.size() <= 13 ? play_on<13>(from, random)
                     : from.size() <= 19 ? play_on<19>(from, random)
                                         : play_on<25>(from, random);
    const bool territory = from.rules().scoring == Scoring::territory;
    const int lead = area - from.white_bonus() - (territory ? more_played_by_black(from) : 0);
    const int halves = 2 * lead - from.komi().halves();
    const auto outcome = halves == 0  ? Outcome::draw
                         : halves > 0 ? Outcome::first_wins
                                      : Outcome::second_wins;
    const int points = from.size() * from.size();
    return {outcome,
            static_cast<float>(halves) / 2,
            {owners_.data(), static_cast<std::size_t>(points)},
            {firsts_.data(),
             static_cast<std::size_t>(from.board().index(from.size() - 1, from.size() - 1)) + 1}};
}

template <class Policy>
engine::RolloutResult RolloutsBy<Policy>::finished(const Go& game) {
    const auto result = score(game);
    for (std::size_t i = 0; i < result.owners.size(); ++i) {
        const auto owner = result.owners[i];
        owners_[i] = static_cast<std::int8_t>(!owner ? 0 : *owner == Player::first ? 1 : -1);
    }
    return {
        game.outcome(),
        static_cast<float>(result.lead_halves) / 2,
        {owners_.data(), result.owners.size()},
    };
}

template class RolloutsBy<AtRandom>;
template class RolloutsBy<ByPolicy>;
template class RolloutsBy<LinearPolicies>;

namespace {

template <int most_size>
void weigh_on(const Go& game, const MoveList& moves, std::vector<float>& weights) {
    const RolloutPolicy<most_size> policy(game);
    for (const Move move : moves)
        weights.push_back(policy.weight(move == Go::pass ? std::nullopt : game.point_of(move),
                                        colour_of(game.to_play())));
}

}  // namespace

void Rollouts::weigh(const Go& game, const MoveList& moves, std::vector<float>& weights) const {
    weights.clear();
    const auto weigh_on_board = game.size() <= 9    ? weigh_on<9>
                                : game.size() <= 13 ? weigh_on<13>
                                : game.size() <= 19 ? weigh_on<19>
                                                    : weigh_on<25>;
    weigh_on_board(game, moves, weights);
}

namespace {

template <int most_size, Colour colour>
void weigh_by_tree(const Factors& factors, const Go& game, const MoveList& moves,
                   std::vector<float>& weights) {
    using Board = RolloutBoard<most_size, true>;
    const FeatureBoard<most_size> position(game);
    std::vector<float> answers(static_cast<std::size_t>(Board::cell_count), 1.0f);
    position.template for_each_answer<colour>(
        [&](int at, int feature) { answers[static_cast<std::size_t>(at)] *= factors[feature]; });
    for (const Move move : moves) {
        float weight = 0;
        const int at = move == Go::pass ? 0 : Board::index(*game.point_of(move));
        if (const auto contact = at == 0 ? std::nullopt : position.template contact<colour>(at)) {
            weight = factors.of_pattern(position.board().surroundings(at), colour) *
                     factors[*contact] * answers[static_cast<std::size_t>(at)];
            if (const auto line = position.line(at)) weight *= factors[*line];
            position.template for_each_tree_feature<colour>(
                at, [&](int feature) { weight *= factors[feature]; });
        }
        weights.push_back(weight);
    }
}

}  // namespace

void LinearRollouts::weigh(const Go& game, const MoveList& moves,
                           std::vector<float>& weights) const {
    constexpr float least = 1e-4f;
    weights.clear();
    const bool black = game.to_play() == Player::first;
    const auto on = [&]<int size>() {
        (black ? weigh_by_tree<size, Colour::black>
               : weigh_by_tree<size, Colour::white>)(policy().tree, game, moves, weights);
    };
    game.size() <= 9    ? on.template operator()<9>()
    : game.size() <= 13 ? on.template operator()<13>()
    : game.size() <= 19 ? on.template operator()<19>()
                        : on.template operator()<25>();
    const float sum = std::accumulate(weights.begin(), weights.end(), 0.0f);
    for (float& weight : weights) weight = std::max(sum > 0 ? weight / sum : 0, least);
}

}  // namespace go
