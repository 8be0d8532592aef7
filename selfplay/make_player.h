// Players from what the user wrote: which class speaks which protocol.
#pragma once

#include <memory>
#include <stop_token>

#include "selfplay/match.h"

namespace selfplay {

// Starts the player and waits for its first answers. Fails with engine::Error when it cannot be
// started, with Fault when it then fails.
std::unique_ptr<Player> make_player(const PlayerSettings& settings, const std::string& game,
                                    Milliseconds timeout, std::stop_token stop);

}  // namespace selfplay
