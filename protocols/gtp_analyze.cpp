// GTP commands that show what the search sees.
#include <fmt/format.h>

#include "protocols/gtp.h"

namespace protocols {

// Prints reports on a position that does not change while it is searched.
Session::Report Gtp::printer(const AnalysisRequest& request) {
    go::Go game = now();
    game.set_to_play(request.player);
    return [this, request, game](const search::Analysis& picture) {
        const auto line = analysis_line(picture, game, request);
        if (!line.empty()) out_.line(line);
    };
}

std::string Gtp::analyze(Words& words, AnalysisDialect dialect) {
    const auto request = parse_analysis(words, now(), dialect);
    search::Limits limits;
    limits.report_every = request.every;
    limits.only = request.only;
    limits.avoid = request.avoid;
    begin_stream();
    analysing_ = true;
    last_root_ = root_for(request.player);
    session_.searcher().set_position(*last_root_);
    session_.searcher().start(limits, printer(request), {});
    return "";
}

std::string Gtp::lz_analyze(Words& words) { return analyze(words, AnalysisDialect::leela_zero); }
std::string Gtp::kata_analyze(Words& words) { return analyze(words, AnalysisDialect::kata); }
std::string Gtp::any_analyze(Words& words) { return analyze(words, AnalysisDialect::plain); }

std::string Gtp::genmove_analyze(Words& words, AnalysisDialect dialect) {
    const auto request = parse_analysis(words, now(), dialect);
    if (!result_.empty()) engine::fail("the game is over: {}", result_);
    begin_stream();
    out_.line(fmt::format("play {}\n", genmove({request.player, true, false, &request})));
    return "";
}

std::string Gtp::lz_genmove_analyze(Words& words) {
    return genmove_analyze(words, AnalysisDialect::leela_zero);
}
std::string Gtp::kata_genmove_analyze(Words& words) {
    return genmove_analyze(words, AnalysisDialect::kata);
}
std::string Gtp::any_genmove_analyze(Words& words) {
    return genmove_analyze(words, AnalysisDialect::plain);
}

std::string Gtp::search_analyze(Words& words, Cut cut) {
    const auto request = parse_analysis(words, now(), AnalysisDialect::kata);
    begin_stream();
    was_cut_ = false;
    const auto text = genmove({request.player, false, false, &request, cut});
    out_.line(fmt::format("play {}\n", cut == Cut::by_any && was_cut_ ? "cancelled" : text));
    return "";
}

std::string Gtp::kata_search_analyze(Words& words) {
    return search_analyze(words, Cut::by_interrupt);
}
std::string Gtp::kata_search_cancellable(Words& words) {
    return search_analyze(words, Cut::by_any);
}

const search::Analysis& Gtp::last_search() const {
    if (!last_root_ || last_picture_.moves.empty()) engine::fail("nothing has been searched yet");
    return last_picture_;
}

std::string Gtp::top_moves(Words&) {
    constexpr std::size_t most = 10;
    if (!last_root_) return "";
    const auto& moves = last_picture_.moves;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, moves.size()) && moves[i].visits > 0; ++i)
        text += fmt::format("{}{} {:.4f}", text.empty() ? "" : " ",
                            last_root_->move_to_text(moves[i].move), winrate(moves[i].value));
    return text;
}

std::string Gtp::debug_moves(Words&) {
    std::string text;
    for (const auto& move : last_search().moves)
        text += fmt::format("{}{} visits {} winrate {:.4f} lcb {:.4f} prior {:.4f} pv {}",
                            text.empty() ? "" : "\n", last_root_->move_to_text(move.move),
                            move.visits, winrate(move.value), winrate(move.lcb), move.prior,
                            variation_text(*last_root_, move.variation));
    return text;
}

std::string Gtp::explain_last_move(Words&) {
    const auto& picture = last_search();
    const auto& best = picture.moves.front();
    return fmt::format("{} visits {} of {} winrate {:.4f} depth {} time {:.3f} pv {}",
                       last_root_->move_to_text(best.move), best.visits, picture.visits,
                       winrate(best.value), picture.depth,
                       static_cast<double>(picture.elapsed.count()) / 1000,
                       variation_text(*last_root_, best.variation));
}

}  // namespace protocols
