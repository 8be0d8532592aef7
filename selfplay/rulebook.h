// What a match must know of its game, as text: who referees, which openings a file holds, how a
// finished game is written down. One Rulebook serves all threads of a match.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "selfplay/game_record.h"
#include "selfplay/player.h"
#include "selfplay/referee.h"

namespace selfplay {

class Rulebook {
   public:
    virtual ~Rulebook() = default;

    // Of a game from `start` (empty: the first position). Fails with engine::Error on a bad one.
    virtual std::unique_ptr<Referee> referee(const std::string& start) const = 0;
    // What every player is told of a game from `start`; the time is the match's to fill in.
    virtual GameSetup setup(const std::string& start) const = 0;
    // The games or positions of a file, each cut after `plies` moves. Those that do not fit the
    // conditions (size, set-up stones, illegal moves, a finished game) are left out; none left is
    // an engine::Error.
    virtual std::vector<Opening> openings(const std::filesystem::path& path, int plies) const = 0;
    // The game in its field's file format, of the ending `extension` ("sgf").
    virtual std::string to_text(const GameRecord& record) const = 0;
    virtual std::string_view extension() const = 0;
    // A length that no sensible game reaches; 0 where the rules end every game themselves.
    virtual int usual_move_limit() const = 0;
};

// Go. With `agree`, stones that both players call dead come off before counting; without, the
// board is counted as it stands.
std::unique_ptr<Rulebook> go_rulebook(const GoConditions& conditions, bool agree);
// Chess, Chess960 where a position asks for it. Openings from EPD, FEN and PGN files.
std::unique_ptr<Rulebook> chess_rulebook();

// Shogi; `declaration_rule` by the name that USI engines give it ("CSARule27"). Openings from
// files of SFEN or "startpos moves …" lines.
std::unique_ptr<Rulebook> shogi_rulebook(const std::string& declaration_rule);

}  // namespace selfplay
