// Self-play games for tests: random legal moves with policies and values that are random too.
#pragma once

#include "engine/base/random.h"
#include "selfplay/records/game.h"
#include "selfplay/training/terms.h"

namespace selfplay::training {

// Plays on from `game` for at most `plies` moves; every `taught`-th turn has a policy to teach.
template <class G>
records::Game random_record(G game, std::uint64_t seed, int plies = 60, int taught = 1) {
    engine::Random random(seed);
    records::Game record;
    record.game = G::name;
    record.start = game.to_text();
    record.steps = seed;
    record.ending = records::Ending::move_limit;
    for (int ply = 0; ply < plies && game.outcome() == engine::Outcome::ongoing; ++ply) {
        const auto legal = game.legal_moves();
        std::vector<engine::Move> moves;
        std::vector<float> policy;
        for (const auto move : legal) {
            moves.push_back(move);
            policy.push_back(1.0f / static_cast<float>(legal.size() * (1 + random.below(3))));
        }
        const bool teaches = ply % taught == 0;
        const auto move = legal[random.below(legal.size())];
        record.add(move, static_cast<float>(random.below(201) - 100) / 100, 8,
                   teaches ? std::span<const engine::Move>(moves) : std::span<const engine::Move>(),
                   policy);
        game.play(move);
    }
    write_result(game, record);
    return record;
}

}  // namespace selfplay::training
