// The arguments of GTP's analysis commands, and what they print.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "protocols/gtp.h"

namespace protocols {

namespace {

using engine::Player;
using search::Analysis;
using search::Milliseconds;

// Arguments of kata-analyze that GUIs send and whose figures may be left out.
constexpr std::string_view unserved[] = {"ownershipStdev", "movesOwnership", "movesOwnershipStdev",
                                         "pvEdgeVisits", "noResultValue"};

double winrate(float value) { return (value + 1) / 2; }
int per_ten_thousand(float value) { return static_cast<int>(std::lround(10000 * winrate(value))); }

bool is_colour(std::string_view word) {
    const char c = static_cast<char>(word[0] | 32);
    return (c == 'b' || c == 'w') && (word.size() == 1 || word.size() == 5);
}

Milliseconds take_interval(Words& words) {
    const double centiseconds = words.number("the interval", 0, 1e7);
    return Milliseconds(std::max<std::int64_t>(std::llround(10 * centiseconds), 10));
}

// Rows from the top, as KataGo prints them.
std::string ownership_text(const std::vector<float>& owners, std::size_t size) {
    std::string text = " ownership";
    for (std::size_t y = size; y-- > 0;)
        for (std::size_t x = 0; x < size; ++x) text += fmt::format(" {:.3f}", owners[y * size + x]);
    return text;
}

}  // namespace

// The grammar of lz-analyze and kata-analyze: [COLOUR] [CENTISECONDS] {KEY VALUE}.
Gtp::AnalysisRequest Gtp::parse_analysis(Words& words, bool kata, bool floats) const {
    AnalysisRequest request;
    request.kata = kata;
    request.floats = floats;
    request.player = now().to_play();
    request.limits.report_every = Milliseconds(1000);
    if (!words.empty() && is_colour(words.peek())) request.player = words.colour();
    if (!words.empty() && words.peek().find_first_not_of("0123456789.") == std::string::npos)
        request.limits.report_every = take_interval(words);
    while (!words.empty()) {
        const std::string key(words.take("the key"));
        parse_key(key, words, request);
    }
    return request;
}

void Gtp::parse_key(std::string_view key, Words& words, AnalysisRequest& request) const {
    if (key == "interval")
        request.limits.report_every = take_interval(words);
    else if (key == "minmoves")
        request.least_moves = words.whole("minmoves", 0, 1000);
    else if (key == "maxmoves")
        request.most_moves = words.whole("maxmoves", 1, 1000);
    else if (key == "avoid" || key == "allow")
        parse_restriction(words, key == "allow", request);
    else
        parse_switch(key, words.take("true or false"), request);
}

void Gtp::parse_switch(std::string_view key, std::string_view value, AnalysisRequest& request) {
    if (value != "true" && value != "false")
        engine::fail("{} must be true or false, not {}", key, value);
    const bool yes = value == "true";
    if (key == "rootInfo")
        request.root_info = yes;
    else if (key == "ownership")
        request.ownership = yes;
    else if (key == "pvVisits")
        request.visits_of_variation = yes;
    else if (std::find(std::begin(unserved), std::end(unserved), key) == std::end(unserved))
        engine::fail("{} is no argument of an analysis", key);
}

// avoid COLOUR V,V,... DEPTH: a ban on the first move of the side to move; deeper plies are free.
void Gtp::parse_restriction(Words& words, bool allow, AnalysisRequest& request) const {
    const auto player = words.colour();
    const std::string list(words.take("the vertices"));
    words.whole("the depth", 1, 1000);
    if (player != request.player) return;
    go::Go game = now();
    game.set_to_play(player);
    std::size_t start = 0;
    while (start <= list.size()) {
        const auto end = std::min(list.find(',', start), list.size());
        const auto text = list.substr(start, end - start);
        const auto move = game.move_from_text(text);
        if (!move && text != "pass") vertex_of(text);
        if (move) (allow ? request.limits.only : request.limits.avoid).push_back(*move);
        start = end + 1;
    }
}

std::string Gtp::move_info(const search::MoveAnalysis& move, int order,
                           const AnalysisRequest& request) const {
    auto text = fmt::format("info move {} visits {} ", now().move_to_text(move.move), move.visits);
    if (request.floats)
        text += fmt::format("winrate {:.6f} prior {:.6f} lcb {:.6f}", winrate(move.value),
                            move.prior, winrate(move.lcb));
    else
        text += fmt::format("winrate {} prior {} lcb {}", per_ten_thousand(move.value),
                            std::lround(10000 * move.prior), per_ten_thousand(move.lcb));
    if (request.kata)
        text += fmt::format(" utility {:.6f} utilityLcb {:.6f}", move.value, move.lcb);
    text += fmt::format(" order {}", order);
    if (request.visits_of_variation)
        text += fmt::format(" pvVisits {}", fmt::join(move.variation_visits, " "));
    text += " pv";
    for (const auto step : move.variation) text.append(" ").append(now().move_to_text(step));
    return text;
}

void Gtp::print_analysis(const Analysis& picture, const AnalysisRequest& request) {
    if (picture.moves.empty()) return;
    std::string line;
    int order = 0;
    for (const auto& move : picture.moves) {
        if (order >= request.most_moves) break;
        if (move.visits == 0 && order >= std::max(request.least_moves, 1)) break;
        line.append(line.empty() ? "" : " ").append(move_info(move, order++, request));
    }
    if (request.root_info)
        line += fmt::format(" rootInfo visits {} utility {:.6f} winrate {:.6f} scoreLead {:.3f}",
                            picture.visits, picture.value, winrate(picture.value), picture.lead);
    if (request.ownership && !picture.owners.empty())
        line += ownership_text(picture.owners, static_cast<std::size_t>(now().size()));
    out_.line(line);
}

}  // namespace protocols
