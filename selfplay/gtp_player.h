// An external engine that speaks the Go Text Protocol, version 2.
#pragma once

#include <set>

#include "selfplay/player.h"
#include "selfplay/process.h"

namespace selfplay {

class GtpPlayer final : public Player {
   public:
    // Starts the engine and asks what it knows. Fails with engine::Error when it cannot be started.
    GtpPlayer(const PlayerSettings& settings, std::stop_token stop, Deadline deadline);
    ~GtpPlayer() override;

    std::string name() const override { return name_; }
    void new_game(const GameSetup& setup, engine::Player side, Deadline deadline) override;
    void play(engine::Player mover, std::string_view move, Deadline deadline) override;
    Answer think(engine::Player mover, const Clocks& clocks, Deadline deadline) override;
    std::optional<std::vector<std::string>> dead_stones(Deadline deadline) override;

   private:
    struct Response {
        bool accepted;
        std::string text;  // lines joined by '\n', without the status sign
    };
    Response ask(std::string_view command, Deadline deadline);
    // Throws Fault when the engine refuses.
    std::string demand(std::string_view command, Deadline deadline);
    bool knows(const std::string& command) const { return commands_.contains(command); }

    void set_rules(const GoConditions& conditions, Deadline deadline);
    void set_handicap(const GoConditions& conditions, Deadline deadline);
    void set_time(const search::TimeControl& time, Deadline deadline);
    std::string time_command(const search::TimeControl& time) const;
    void set_visits(std::uint64_t visits, Deadline deadline);
    void tell_time(engine::Player player, const search::TimeLeft& left, Deadline deadline);

    Process process_;
    std::set<std::string> commands_;
    std::string name_;
    bool has_answered_ = false;
    bool timed_ = false;
};

}  // namespace selfplay
