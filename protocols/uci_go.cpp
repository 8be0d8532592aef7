#include "protocols/uci_go.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>

namespace protocols {

namespace {

using search::Milliseconds;

std::optional<std::int64_t> number(std::string_view text) {
    std::int64_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status == std::errc::result_out_of_range && !text.empty())
        return text[0] == '-' ? 0 : std::numeric_limits<std::int64_t>::max();
    if (status != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

Milliseconds milliseconds(std::int64_t value) {
    return Milliseconds(std::clamp(value, std::int64_t{0}, std::int64_t{most_milliseconds}));
}

bool is_keyword(std::string_view word) {
    static constexpr std::string_view keywords[] = {
        "searchmoves", "ponder", "wtime", "btime",    "winc",     "binc",   "movestogo",
        "depth",       "nodes",  "mate",  "movetime", "infinite", "byoyomi"};
    return std::find(std::begin(keywords), std::end(keywords), word) != std::end(keywords);
}

void set_number(GoCommand& go, std::string_view word, std::int64_t value, bool white_first) {
    const std::size_t player = (word[0] == 'w') == white_first ? 0 : 1;
    const auto count = static_cast<std::uint64_t>(std::max<std::int64_t>(value, 0));
    const auto small = static_cast<int>(std::clamp<std::int64_t>(value, 0, 1'000'000));
    if (word == "wtime" || word == "btime") go.time[player] = milliseconds(value);
    if (word == "winc" || word == "binc") go.increment[player] = milliseconds(value);
    if (word == "byoyomi") go.byoyomi = milliseconds(value);
    if (word == "movetime") go.move_time = milliseconds(value);
    if (word == "movestogo") go.moves_to_go = small;
    if (word == "depth") go.depth = small;
    if (word == "nodes") go.nodes = count;
    if (word == "mate") go.mate = count;
}

// The word behind `keyword`, which is a number, or "infinite" behind "mate". False: there is none.
bool read_number(std::istream& in, GoCommand& go, std::string_view keyword, bool white_first) {
    if (keyword == "mate") go.mate = std::numeric_limits<std::uint64_t>::max();
    std::string text;
    if (!(in >> text)) return false;
    if (keyword == "mate" && text == "infinite") return true;
    if (const auto value = number(text)) set_number(go, keyword, *value, white_first);
    return true;
}

}  // namespace

GoCommand parse_go(std::string_view arguments, bool white_first) {
    GoCommand go;
    std::istringstream in{std::string(arguments)};
    bool listing_moves = false;
    for (std::string word; in >> word;) {
        const bool keyword = is_keyword(word);
        if (listing_moves && !keyword) go.search_moves.push_back(word);
        if (!keyword) continue;
        listing_moves = word == "searchmoves";
        if (word == "infinite") go.infinite = true;
        if (word == "ponder") go.ponder = true;
        if (listing_moves || word == "infinite" || word == "ponder") continue;
        if (!read_number(in, go, word, white_first)) break;
    }
    return go;
}

void ClockLag::shown(const search::TimeLeft& left) {
    // More is another game, or a clock that was set.
    constexpr Milliseconds none{0}, most{2000};
    constexpr double share = 0.25;
    if (last_ && thought_ && left.main > none) {
        const auto lag = last_->main + last_->control.increment - *thought_ - left.main;
        if (lag >= none && lag <= most) mean_ += share * (static_cast<double>(lag.count()) - mean_);
    }
    last_ = left;
    thought_.reset();
}

Milliseconds ClockLag::mean() const { return Milliseconds(static_cast<std::int64_t>(mean_)); }

search::TimeLeft ClockLag::without_lag(search::TimeLeft left) const {
    left.main = std::max(left.main - mean(), Milliseconds(left.main.count() > 0));
    left.control.increment -= mean();
    return left;
}

search::Limits limits_of(const GoCommand& go, engine::Player mover) {
    search::Limits limits;
    limits.ponder = go.ponder;
    if (go.infinite) return limits;
    limits.simulations = go.nodes;
    limits.time = go.move_time;
    if (!go.has_clock()) return limits;
    // A GUI that sends one side's time only (`go wtime 100`) means both.
    const auto me = static_cast<std::size_t>(mover);
    search::TimeLeft left;
    left.control.unlimited = false;
    left.control.main = go.time[me].value_or(go.time[1 - me].value_or(Milliseconds(0)));
    left.control.increment = go.increment[me];
    left.control.period = go.byoyomi;
    left.control.periods = go.byoyomi.count() > 0 ? 1 : 0;
    left.control.moves_per_session = go.moves_to_go;
    left.main = left.control.main;
    left.period = go.byoyomi;
    left.periods = left.control.periods;
    left.moves = left.main.count() > 0 ? go.moves_to_go : 1;
    limits.clock = left;
    return limits;
}

}  // namespace protocols
