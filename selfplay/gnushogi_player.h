// GNU Shogi by its own line protocol (`gnushogi -X`): it takes a move as "7g7f" and answers
// "1. ... 3a3b 299590", its clock in milliseconds last. It is kept in force mode and told to move
// by "go", so that it never thinks unasked.
#pragma once

#include <string>

#include "selfplay/player.h"
#include "selfplay/process.h"

namespace selfplay {

class GnushogiPlayer final : public Player {
   public:
    // Starts the engine. Fails with engine::Error when it cannot be started.
    GnushogiPlayer(const PlayerSettings& settings, std::stop_token stop, Deadline deadline);
    ~GnushogiPlayer() override;

    std::string name() const override { return name_; }
    void new_game(const GameSetup& setup, engine::Player side, Deadline deadline) override;
    void play(engine::Player mover, std::string_view move, Deadline deadline) override;
    Answer think(engine::Player mover, const Clocks& clocks, Deadline deadline) override;

   private:
    Process process_;
    std::string name_;
};

}  // namespace selfplay
