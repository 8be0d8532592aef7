#include "protocols/gtp_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace protocols {

namespace {

using engine::Player;
using search::Milliseconds;

long per_ten_thousand(double share) { return std::lround(10000 * share); }

struct Parser {
    Words& words;
    const go::Go& game;
    AnalysisRequest request;
    bool allowed[2] = {false, false};

    void take_interval() {
        const double centiseconds = words.number("the interval", 0, 1e7);
        request.every = Milliseconds(std::max(std::llround(10 * centiseconds), 10LL));
    }
    void take_least() { request.least_moves = words.whole("minmoves", 0, 1000); }
    void take_most() { request.most_moves = words.whole("maxmoves", 1, 1000); }
    void take_avoid() { take_restriction(request.avoid); }
    void take_allow() {
        const auto before = words;
        const auto player = words.colour();
        words = before;
        if (std::exchange(allowed[static_cast<std::size_t>(player)], true))
            engine::fail("allow can be given once a player");
        const bool any = take_restriction(request.only);
        if (player == request.player && !any) engine::fail("no allowed move is legal");
    }
    void take_root_info() { request.root_info = words.yes_or_no("rootInfo"); }
    void take_ownership() { request.ownership = words.yes_or_no("ownership"); }
    void take_visits() { request.variation_visits = words.yes_or_no("pvVisits"); }
    void take_edge_visits() { request.variation_edge_visits = words.yes_or_no("pvEdgeVisits"); }
    void take_nothing() { words.yes_or_no("its value"); }

    // COLOUR V,V,... DEPTH; whether anything was added.
    bool take_restriction(std::vector<go::Move>& moves) {
        const auto player = words.colour();
        const std::string list(words.take("the list of vertices"));
        words.whole("the depth", 1, 1'000'000);
        std::vector<go::Move> found;
        for (std::size_t start = 0; start <= list.size();) {
            const auto end = std::min(list.find(',', start), list.size());
            if (const auto move = move_of(std::string_view(list).substr(start, end - start)))
                found.push_back(*move);
            start = end + 1;
        }
        if (player != request.player) return false;
        moves.insert(moves.end(), found.begin(), found.end());
        return !found.empty();
    }

    // Empty for a point where the player cannot play.
    std::optional<go::Move> move_of(std::string_view text) const {
        go::Go asked = game;
        asked.set_to_play(request.player);
        const auto move = asked.move_from_text(text);
        if (!move && !go::point_from_vertex(text, game.size()))
            engine::fail("{} is no point of this board", text.substr(0, 20));
        return move;
    }
};

struct Key {
    std::string_view name;
    void (Parser::*take)();
    bool kata_only = false;
};

constexpr Key keys[] = {
    {"interval", &Parser::take_interval},
    {"minmoves", &Parser::take_least},
    {"maxmoves", &Parser::take_most},
    {"avoid", &Parser::take_avoid},
    {"allow", &Parser::take_allow},
    {"rootInfo", &Parser::take_root_info, true},
    {"ownership", &Parser::take_ownership, true},
    {"pvVisits", &Parser::take_visits, true},
    {"pvEdgeVisits", &Parser::take_edge_visits, true},
    // Figures that this search does not have.
    {"ownershipStdev", &Parser::take_nothing, true},
    {"movesOwnership", &Parser::take_nothing, true},
    {"movesOwnershipStdev", &Parser::take_nothing, true},
    {"noResultValue", &Parser::take_nothing, true},
};

void take_pair(Parser& parser) {
    const std::string name(parser.words.take("the key"));
    for (const auto& key : keys) {
        if (key.name != name) continue;
        if (key.kata_only && parser.request.dialect == AnalysisDialect::leela_zero) break;
        return (parser.*key.take)();
    }
    engine::fail("{} is no argument of an analysis", name.substr(0, 60));
}

std::string list(std::string_view key, const std::vector<std::uint64_t>& numbers) {
    std::string text = fmt::format(" {}", key);
    for (const auto number : numbers) text += fmt::format(" {}", number);
    return text;
}

std::string move_text(const search::MoveAnalysis& move, const go::Go& game, int order,
                      const AnalysisRequest& request) {
    auto text = fmt::format("info move {} visits {}", game.move_to_text(move.move), move.visits);
    switch (request.dialect) {
        case AnalysisDialect::leela_zero:
            text +=
                fmt::format(" winrate {} prior {} lcb {}", per_ten_thousand(winrate(move.value)),
                            per_ten_thousand(move.prior), per_ten_thousand(winrate(move.lcb)));
            break;
        case AnalysisDialect::kata:
            text += fmt::format(" edgeVisits {} utility {:.6f}", move.visits, move.value);
            [[fallthrough]];
        case AnalysisDialect::plain:
            text += fmt::format(" winrate {:.6f} prior {:.6f} lcb {:.6f}", winrate(move.value),
                                move.prior, winrate(move.lcb));
    }
    if (request.dialect == AnalysisDialect::kata)
        text += fmt::format(" utilityLcb {:.6f}", move.lcb);
    text += fmt::format(" order {} pv {}", order, variation_text(game, move.variation));
    if (request.variation_visits) text += list("pvVisits", move.variation_visits);
    if (request.variation_edge_visits) text += list("pvEdgeVisits", move.variation_visits);
    return text;
}

// Rows from the top, each from the left.
std::string ownership_text(const std::vector<float>& owners, std::size_t size) {
    std::string text = " ownership";
    for (std::size_t y = size; y-- > 0;)
        for (std::size_t x = 0; x < size; ++x) text += fmt::format(" {:.6f}", owners[y * size + x]);
    return text;
}

}  // namespace

double winrate(float value) { return std::clamp((static_cast<double>(value) + 1) / 2, 0.0, 1.0); }

std::string variation_text(const go::Go& game, const std::vector<go::Move>& moves) {
    std::string text;
    for (const auto move : moves) text.append(text.empty() ? "" : " ") += game.move_to_text(move);
    return text;
}

AnalysisRequest parse_analysis(Words& words, const go::Go& game, AnalysisDialect dialect) {
    Parser parser{words, game, {}};
    parser.request.dialect = dialect;
    parser.request.player = game.to_play();
    if (words.at_colour()) parser.request.player = words.colour();
    if (words.at_number()) parser.take_interval();
    while (!words.empty()) take_pair(parser);
    return parser.request;
}

std::string analysis_line(const search::Analysis& picture, const go::Go& game,
                          const AnalysisRequest& request) {
    std::string line;
    int order = 0;
    for (const auto& move : picture.moves) {
        if (order >= request.most_moves) break;
        if (move.visits == 0 && order >= std::max(request.least_moves, 1)) break;
        line.append(line.empty() ? "" : " ") += move_text(move, game, order++, request);
    }
    if (line.empty()) return line;
    if (request.root_info) {
        line += fmt::format(" rootInfo visits {} utility {:.6f} winrate {:.6f}", picture.visits,
                            picture.value, winrate(picture.value));
        if (!picture.owners.empty()) line += fmt::format(" scoreLead {:.6f}", picture.lead);
    }
    if (request.ownership && !picture.owners.empty())
        line += ownership_text(picture.owners, static_cast<std::size_t>(game.size()));
    return line;
}

}  // namespace protocols
