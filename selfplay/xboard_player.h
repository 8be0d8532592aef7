// An external engine that speaks the protocol of xboard (Chess Engine Communication Protocol),
// version 2 or 1. It is kept in force mode and told to move by "go", so that it never thinks
// unasked.
#pragma once

#include <map>
#include <string>

#include "selfplay/player.h"
#include "selfplay/process.h"

namespace selfplay {

class XboardPlayer final : public Player {
   public:
    // Starts the engine and hears its features. Fails with engine::Error when it cannot be started.
    XboardPlayer(const PlayerSettings& settings, std::stop_token stop, Deadline deadline);
    ~XboardPlayer() override;

    std::string name() const override { return feature("myname"); }
    void new_game(const GameSetup& setup, engine::Player side, Deadline deadline) override;
    void play(engine::Player mover, std::string_view move, Deadline deadline) override;
    Answer think(engine::Player mover, const Clocks& clocks, Deadline deadline) override;

   private:
    std::string feature(const std::string& name, const std::string& otherwise = "") const;
    void hear_features(Deadline deadline);
    bool note_features(std::string_view text);
    void set_level(const search::TimeControl& time, Deadline deadline);
    void synchronise(Deadline deadline);
    Answer read_answer(engine::Player mover, Deadline deadline);

    Process process_;
    std::map<std::string, std::string> features_;
    int pings_ = 0;
};

}  // namespace selfplay
