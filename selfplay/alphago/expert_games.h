// Games of Go by others, read from SGF files, to learn moves from. What teaches no even game
// between two players is left out and counted. Kept small: some hundred bytes a game. Values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/go/go.h"
#include "selfplay/records/game.h"

namespace selfplay::alphago {

// Told what happened, one line each.
using Say = std::function<void(const std::string&)>;

struct ExpertGame {
    int size = 19;
    go::Komi komi;
    std::vector<std::uint16_t> moves;  // codes, Black first, in turn; passes at the end left out
    engine::Outcome outcome = engine::Outcome::ongoing;  // unknown
};

struct ExpertCounts {
    std::uint64_t games = 0, kept = 0, positions = 0;
    // Left out: handicap or set-up stones, colours out of turn; too few moves; what cannot be read
    // or played; boards of another size; without a result.
    std::uint64_t handicap = 0, brief = 0, broken = 0, other_size = 0, unfinished = 0;
};

struct ExpertGames {
    std::vector<ExpertGame> lessons, held_out;  // every tenth of those kept is held out
    ExpertCounts counts;
};

struct ExpertSelection {
    int size = 19;
    int least_moves = 30;
    int most_games = 0;     // of those kept; 0: all
    bool finished = false;  // only games with a result
};

// The .sgf, .sgfs and their .gz files behind the paths, in their order, folders with all that is
// below them. Fails with engine::Error on a path that is not there.
std::vector<std::filesystem::path> sgf_files(std::span<const std::filesystem::path> paths);

// Fails with engine::Error when no game is left to learn from or none to be held out.
ExpertGames read_expert_games(std::span<const std::filesystem::path> paths,
                              const ExpertSelection& selection, const Say& say);

// A position of a game in a list: the one before move number `turn`.
struct ExpertPlace {
    const ExpertGame* game = nullptr;
    std::size_t turn = 0;
};

// All positions of a list of games, which must outlive it, each with the same chance.
class ExpertPositions {
   public:
    explicit ExpertPositions(const std::vector<ExpertGame>& games);
    std::uint64_t count() const { return ends_.empty() ? 0 : ends_.back(); }
    ExpertPlace operator[](std::uint64_t number) const;
    ExpertPlace draw(engine::Random& random) const;

   private:
    const std::vector<ExpertGame>& games_;
    std::vector<std::uint64_t> ends_;  // positions up to and with each game
};

go::Go start_of(const ExpertGame& game);
// As a record that teaches the move made there, and how the game ended.
records::Game record_of(const ExpertPlace& place);

}  // namespace selfplay::alphago
