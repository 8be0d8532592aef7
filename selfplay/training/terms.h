// What self-play must know of each game beside its rules: the first position, when a game is cut
// off, what is counted at its end. Functions on values, from any thread.
#pragma once

#include "engine/base/random.h"
#include "engine/chess/chess.h"
#include "engine/go/go.h"
#include "engine/shogi/shogi.h"
#include "selfplay/records/game.h"
#include "selfplay/training/actor_settings.h"

namespace selfplay::training {

// Go: of a drawn size and komi, scored as the board stands (Tromp-Taylor without suicide).
template <class G>
G first_position(const ActorSettings& settings, engine::Random& random);
template <>
go::Go first_position<go::Go>(const ActorSettings& settings, engine::Random& random);
template <>
chess::Chess first_position<chess::Chess>(const ActorSettings& settings, engine::Random& random);
template <>
shogi::Shogi first_position<shogi::Shogi>(const ActorSettings& settings, engine::Random& random);

// The usual one, on the largest of the boards that they are played on.
template <class G>
G largest_position(ActorSettings settings) {
    settings.small_share = settings.scattered_share = 0;
    engine::Random random(0);
    return first_position<G>(settings, random);
}

// Moves of both after which the game is cut off.
int move_limit(const ActorSettings& settings, const go::Go& game);
int move_limit(const ActorSettings& settings, const chess::Chess& game);
int move_limit(const ActorSettings& settings, const shogi::Shogi& game);

// Legal moves of a typical position, by which room is reckoned.
int typical_moves(const go::Go& game);
int typical_moves(const chess::Chess& game);
int typical_moves(const shogi::Shogi& game);

// Side of a board whose size varies from game to game; else 0.
int board_of(const go::Go& game);
int board_of(const chess::Chess& game);
int board_of(const shogi::Shogi& game);

// Outcome, lead and owners of a game that ended by its rules or was cut off.
void write_result(const go::Go& game, records::Game& record);
void write_result(const chess::Chess& game, records::Game& record);
void write_result(const shogi::Shogi& game, records::Game& record);

}  // namespace selfplay::training
