#include "protocols/uci_stats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace protocols {

namespace {

std::string head(std::string_view label, int index, std::uint64_t visits, float prior) {
    const int digits = prior >= 0.99995f ? 1 : 2;
    return fmt::format("info string {:<5} ({:<4}) N: {:>7} (+ 0) (P: {:>5.{}f}%) ", label, index,
                       visits, 100 * prior, digits);
}

// What the rule takes an unvisited move to be worth, as it stands.
float first_play_urgency(const search::Analysis& picture, const search::SearchParams& params) {
    float visited = 0;
    for (const auto& move : picture.moves)
        if (move.visits > 0) visited += move.prior;
    return picture.value - params.root_fpu_reduction * std::sqrt(visited);
}

// `value` less what draws count for, how likely a draw is, and the moves left (0: no word on them).
std::string expectations(float value, float draws, float draw_score, float plies_left) {
    return fmt::format("(WL: {:>8.5f}) (D: {:>5.3f}) (M: {:>4.1f}) ", value - draws * draw_score,
                       draws, plies_left);
}

std::string move_line(const Session& session, const search::Analysis& picture,
                      const search::MoveAnalysis& move) {
    const auto params = session.params();
    const auto n = static_cast<float>(picture.visits);
    const float c = params.cpuct +
                    params.cpuct_factor * std::log((1 + n + params.cpuct_base) / params.cpuct_base);
    const float u =
        c * move.prior * std::sqrt(std::max(n, 1.0f)) / static_cast<float>(1 + move.visits);
    const bool visited = move.visits > 0;
    const float q = visited ? move.value : first_play_urgency(picture, params);
    auto line = head(session.move_to_text(move.move), session.policy_index(move.move), move.visits,
                     move.prior);
    line += visited ? expectations(move.value, move.draws, picture.draw_score, 0)
                    : "(WL:  -.-----) (D: -.---) (M:  -.-) ";
    return line +
           fmt::format("(Q: {:>8.5f}) (U: {:>6.5f}) (S: {:>8.5f}) (V:  -.----)", q, u, q + u);
}

}  // namespace

std::vector<std::string> verbose_stats(const Session& session, const search::Analysis& picture) {
    std::vector<std::string> lines;
    for (auto move = picture.moves.rbegin(); move != picture.moves.rend(); ++move)
        lines.push_back(move_line(session, picture, *move));
    float visited = 0;
    for (const auto& move : picture.moves)
        if (move.visits > 0) visited += move.prior;
    lines.push_back(
        head("node", static_cast<int>(picture.moves.size()), picture.visits, visited) +
        expectations(picture.value, picture.draws, picture.draw_score, picture.plies_left) +
        fmt::format("(Q: {:>8.5f}) (V: {})", picture.value,
                    picture.visits == 1 ? fmt::format("{:>7.4f}", picture.value) : " -.----"));
    return lines;
}

}  // namespace protocols
