// A game on a text board against the engine, for a person at a terminal: Go, chess or shogi over
// one session.
#pragma once

#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "protocols/session.h"

namespace protocols {

struct TerminalSettings {
    engine::Player human = engine::Player::first;
    double seconds = 2;             // a move
    std::uint64_t simulations = 0;  // a move; 0: as time allows
    std::string record;             // file that always holds the game so far; empty: none
};

// What a game shows and saves beyond what every session does.
struct TerminalView {
    std::function<std::string()> board;   // as text
    std::function<std::string()> result;  // of a game that is over
    // Writes the game to a file; `resigned`: the player to move has given it up. Fails with
    // engine::Error.
    std::function<void(const std::string& path, bool resigned)> save;
    // The engine's move when it should not simply be the search's best (a pass in Go).
    std::function<std::string(const search::Analysis&)> choose;
    std::string first_name, second_name, move_example;
};

class Terminal {
   public:
    Terminal(const TerminalSettings& settings, Session& session, TerminalView view,
             std::istream& in, std::ostream& out);

    // Until `quit` or the end of input.
    void run();

   private:
    bool human_turn();  // false: the game is left
    bool obey(const std::string& line);
    void engine_turn();
    void hint();
    void take_back();
    search::Analysis think();
    std::string name_of(engine::Player player) const;

    TerminalSettings settings_;
    Session& session_;
    TerminalView view_;
    std::istream& in_;
    std::ostream& out_;
    bool resigned_ = false;
};

}  // namespace protocols
