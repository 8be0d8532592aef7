// An external engine that speaks UCI, or USI, its dialect for shogi.
#pragma once

#include <string>
#include <vector>

#include "selfplay/player.h"
#include "selfplay/process.h"

namespace selfplay {

// Where the two protocols use different words.
struct UciDialect {
    std::string_view greeting, greeted;  // "uci", "uciok"
    std::string_view new_game;           // "ucinewgame"
    std::string_view position;           // "fen" or "sfen"
    std::string_view first, second;      // the sides' letters in "wtime", "binc"
    bool byoyomi;                        // has a word for overtime, and none for sessions
    bool tells_result;                   // "gameover win"
};
const UciDialect& uci_dialect();
const UciDialect& usi_dialect();

class UciPlayer final : public Player {
   public:
    // Starts the engine and waits until it is ready. Fails with engine::Error when it cannot be
    // started.
    UciPlayer(const PlayerSettings& settings, const UciDialect& dialect, std::stop_token stop,
              Deadline deadline);
    ~UciPlayer() override;

    std::string name() const override { return name_; }
    void new_game(const GameSetup& setup, engine::Player side, Deadline deadline) override;
    void play(engine::Player mover, std::string_view move, Deadline deadline) override;
    Answer think(engine::Player mover, const Clocks& clocks, Deadline deadline) override;
    void game_over(engine::Outcome outcome, Deadline deadline) override;

   private:
    void await(std::string_view word, Deadline deadline);
    void note_greeting(std::string_view line);
    std::string go_command(engine::Player mover, const Clocks& clocks) const;
    std::string clock_words(engine::Player mover, const Clocks& clocks) const;
    Answer read_answer(Deadline deadline);

    const UciDialect& dialect_;
    Process process_;
    std::optional<std::uint64_t> nodes_;
    std::string name_;
    std::string position_;  // "position startpos moves e2e4 …"
    bool any_moves_ = false;
    bool knows_chess960_ = false;
    engine::Player side_ = engine::Player::first;
};

}  // namespace selfplay
