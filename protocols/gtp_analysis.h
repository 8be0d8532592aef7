// Analysis over GTP in the dialects of Leela Zero (lz-) and KataGo (kata-): what is asked for, and
// the lines that answer. All values are as the player to move sees them. Fields that this search
// has no figure for (standard deviations, moves' own leads and ownership) are left out.
#pragma once

#include <string>
#include <vector>

#include "engine/go/go.h"
#include "protocols/words.h"
#include "search/searcher.h"

namespace protocols {

// Leela Zero writes probabilities as whole numbers of ten-thousandths, the others with a point;
// `plain` is for GUIs that tell the two apart by that point.
enum class AnalysisDialect : std::uint8_t { leela_zero, kata, plain };

struct AnalysisRequest {
    AnalysisDialect dialect = AnalysisDialect::kata;
    engine::Player player = engine::Player::first;
    search::Milliseconds every{1000};
    int least_moves = 0, most_moves = 1000;
    std::vector<go::Move> only, avoid;  // first moves; the plies behind them are free
    bool root_info = false, ownership = false;
    bool variation_visits = false, variation_edge_visits = false;
};

// [COLOUR] [CENTISECONDS] {KEY VALUE}, `game` being the present one.
AnalysisRequest parse_analysis(Words& words, const go::Go& game, AnalysisDialect dialect);

// One report, without line end; empty before there is anything to tell. `game` has been searched
// with the request's player to move.
std::string analysis_line(const search::Analysis& picture, const go::Go& game,
                          const AnalysisRequest& request);

// In 0..1.
double winrate(float value);
// Moves separated by blanks.
std::string variation_text(const go::Go& game, const std::vector<go::Move>& moves);

}  // namespace protocols
