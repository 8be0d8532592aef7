// A match between two players: the schedule, the threads that play it, the running result, and the
// files it is written to. Finished games survive whatever happens; the same match goes on from
// them. Passive towards its caller: run() blocks until the match is over or stopped.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <stop_token>
#include <string>

#include "selfplay/match_game.h"
#include "selfplay/rating.h"

namespace selfplay {

struct OpeningSettings {
    std::filesystem::path file;  // games to begin with
    int plies = 8;               // how many of their moves
    int random_plies = 0;        // without a file: so many random legal moves
    std::uint64_t seed = 1;      // of the random moves and of the order of the file's games
    bool operator==(const OpeningSettings&) const = default;
};

struct MatchSettings {
    std::string game = "go";
    GoConditions go;
    bool agree_on_dead = true;                   // Go
    std::string declaration_rule = "CSARule27";  // shogi
    std::array<PlayerSettings, 2> players;
    int games = 100;
    bool alternate = true;  // each opening is played twice, colours exchanged
    int concurrency = 1;
    GameRules rules;
    OpeningSettings openings;
    std::optional<Sprt> sprt;
    std::filesystem::path out;  // folder for games.jsonl and the game file; empty: nothing written
};

// Everything that makes two runs parts of one match, as one line of JSON; the number of games and
// the concurrency may change on resuming.
std::string identity(const MatchSettings& settings);

struct Standing {
    Tally tally;  // from engine 0's side
    int faults[2] = {0, 0};
    std::optional<double> llr;
    Sprt::Verdict verdict = Sprt::Verdict::undecided;
    int games_wanted = 0;
};

// Starts engine 0 or 1. Fails with engine::Error when that cannot be done.
using PlayerFactory = std::function<std::unique_ptr<Player>(int engine, std::stop_token stop)>;
// Called after each game, one call at a time, from a thread of the match.
using GameReport = std::function<void(const GameRecord&, const Standing&)>;

class Match {
   public:
    // Reads openings and, in `out`, the games already played. Fails with engine::Error on
    // impossible settings or when `out` holds another match.
    Match(MatchSettings settings, PlayerFactory factory);
    ~Match();

    // As it was when the match was resumed, or as it is after run().
    const Standing& standing() const;
    // Plays what is left. Returns early when `stop` is requested (games under way are dropped) or
    // the test is decided. Rethrows what a player's start or our disk made impossible.
    void run(const std::stop_token& stop, const GameReport& report);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace selfplay
