// GTP commands that show what the network says of the position, in the forms of KataGo
// (kata-raw-nn) and Leela Zero (heatmap).
#include <fmt/format.h>

#include <algorithm>

#include "protocols/gtp.h"

namespace protocols {

namespace {

using engine::Player;
using search::Evaluation;
using search::Figure;

constexpr int symmetries = 8;

// The prior of a move, empty where it is illegal.
std::optional<float> prior_of(const engine::MoveList& moves, const Evaluation& answer,
                              go::Move move) {
    for (int i = 0; i < moves.size(); ++i)
        if (moves[i] == move) return answer.priors[static_cast<std::size_t>(i)];
    return std::nullopt;
}

std::string prior_text(std::optional<float> prior) {
    return prior ? fmt::format("{:8.6f} ", *prior) : "    NAN ";
}

// Rows from the top.
template <class Text>
std::string rows(const go::Go& game, Text text) {
    std::string all;
    for (int y = game.size() - 1; y >= 0; --y) {
        for (int x = 0; x < game.size(); ++x) all += text(go::Point{x, y});
        all += '\n';
    }
    return all;
}

std::string kata_text(const go::Go& game, const engine::MoveList& moves, int symmetry,
                      const Evaluation& answer) {
    const bool white = game.to_play() == Player::second;
    const float sign = white ? 1.0f : -1.0f;
    const float mean = answer[Figure::score], deviation = answer[Figure::score_deviation];
    // Both were multiplied by the chance of a result.
    const float squares =
        mean * mean / std::max(1 - answer.draw, 1e-9f) + deviation * deviation * (1 - answer.draw);
    auto text = fmt::format(
        "symmetry {}\nwhiteWin {:.6f}\nwhiteLoss {:.6f}\nnoResult {:.6f}\nwhiteLead {:.3f}\n"
        "whiteScoreSelfplay {:.3f}\nwhiteScoreSelfplaySq {:.3f}\nvarTimeLeft {:.3f}\n"
        "shorttermWinlossError {:.3f}\nshorttermScoreError {:.3f}\npolicy\n",
        symmetry, white ? answer.win : answer.loss, white ? answer.loss : answer.win, answer.draw,
        sign * answer[Figure::lead], sign * mean, squares, answer[Figure::variance_time],
        answer[Figure::winloss_error], answer[Figure::score_error]);
    text += rows(game, [&](go::Point point) {
        return prior_text(prior_of(moves, answer, game.move_at(point)));
    });
    text += fmt::format("policyPass {}\n", prior_text(prior_of(moves, answer, go::Go::pass)));
    if (answer.owners.empty()) return text;
    return text + "whiteOwnership\n" + rows(game, [&](go::Point point) {
               const int at = point.y * game.size() + point.x;
               return fmt::format("{:9.7f} ", sign * answer.owners[static_cast<std::size_t>(at)]);
           });
}

int thousandths(std::optional<float> prior) {
    return static_cast<int>(1000 * prior.value_or(0.0f));
}

std::string heatmap_text(const go::Go& game, const engine::MoveList& moves,
                         const Evaluation& answer) {
    auto text = rows(game, [&](go::Point point) {
        return fmt::format("{:3} ", thousandths(prior_of(moves, answer, game.move_at(point))));
    });
    return text + fmt::format("pass: {}\nwinrate: {:.6f}\n",
                              thousandths(prior_of(moves, answer, go::Go::pass)),
                              answer.win + answer.draw / 2);
}

}  // namespace

Evaluation Gtp::ask_network(const go::Go& game, const engine::MoveList& moves, int symmetry) const {
    const auto& network = session_.searcher().network();
    if (!network) engine::fail("there is no network: start with --weights FILE");
    network->check(game);
    search::SymmetryEvaluator<go::Go> evaluator(
        settings_.precision ? network->make_evaluator() : network->make_exact_evaluator(), 0);
    Evaluation answer;
    const search::Query<go::Go> query{&game, &moves, symmetry, &answer};
    evaluator.evaluate({&query, 1});
    return answer;
}

std::string Gtp::kata_raw_nn(Words& words) {
    go::Go game = now();
    if (words.at_colour()) game.set_to_play(words.colour());
    const bool all = !words.empty() && words.peek() == "all";
    const int only = all ? 0 : words.whole("the symmetry", 0, symmetries - 1);
    const auto moves = game.legal_moves();
    std::string text;
    for (int symmetry = only; symmetry <= (all ? symmetries - 1 : only); ++symmetry)
        text += kata_text(game, moves, symmetry, ask_network(game, moves, symmetry));
    return text.substr(0, text.size() - 1);
}

std::string Gtp::heatmap(Words& words) {
    const go::Go& game = now();
    const auto moves = game.legal_moves();
    const auto which = words.empty() ? "0" : std::string(words.take("the symmetry"));
    std::string text;
    if (which == "all")
        for (int symmetry = 0; symmetry < symmetries; ++symmetry)
            text += heatmap_text(game, moves, ask_network(game, moves, symmetry)) + "\n";
    else if (which == "average")
        text = heatmap_text(game, moves, ask_network(game, moves, search::all_symmetries));
    else
        text = heatmap_text(game, moves,
                            ask_network(game, moves, Words(which).whole("the symmetry", 0, 7)));
    return text.substr(0, text.find_last_not_of('\n') + 1);
}

}  // namespace protocols
