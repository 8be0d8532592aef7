#include "engine/go/rollouts.h"

#include "engine/go/rollout_board.h"
#include "engine/go/score.h"

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

// Returns Black's lead in area, and leaves the owners behind.
template <int most_size>
int Rollouts::play_on(const Go& from, engine::Random& random) {
    RolloutBoard<most_size> board(from);
    const int size = from.size(), most_moves = 3 * size * size;
    // The generator's state stays in registers.
    engine::Random local = random;
    bool black = from.to_play() == Player::first;
    for (int moves = 0, passes = from.consecutive_passes(); moves < most_moves && passes < 2;
         ++moves, black = !black) {
        const int played = black ? board.template play_random<Colour::black>(local)
                                 : board.template play_random<Colour::white>(local);
        passes = played != 0 ? 0 : passes + 1;
    }
    random = local;
    int lead = 0;
    std::size_t next = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            firsts_[static_cast<std::size_t>(from.board().index(x, y))] = board.first(x, y);
            lead += owners_[next++] = board.owner(x, y);
        }
    return lead;
}

engine::RolloutResult Rollouts::play(const Go& from, engine::Random& random) {
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

engine::RolloutResult Rollouts::finished(const Go& game) {
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

}  // namespace go
