#include "selfplay/training/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace selfplay::training {

namespace {

double rate(std::uint64_t now, std::uint64_t before, double seconds) {
    return seconds > 0 ? static_cast<double>(now - before) / seconds : 0;
}

std::string duration(double seconds) {
    const auto minutes = static_cast<long>(seconds / 60);
    if (minutes >= 60) return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
    return fmt::format("{} min {:02} s", minutes, static_cast<long>(seconds) % 60);
}

}  // namespace

std::optional<std::string> Progress::due(const Standing& now) {
    const double seconds = now.state.seconds - told_.state.seconds;
    if (seconds < interval) return std::nullopt;
    auto line = fmt::format(
        "{} | games {} ({:.0f}/h) | positions {} ({:.0f}/s) | evaluations {:.0f}/s | steps {} "
        "({:.0f} samples/s)",
        duration(now.state.seconds), now.state.games,
        3600 * rate(now.state.games, told_.state.games, seconds), now.state.positions,
        rate(now.state.positions, told_.state.positions, seconds),
        rate(now.evaluations, told_.evaluations, seconds), now.steps,
        rate(now.samples, told_.samples, seconds));
    if (held_out_.samples > 0)
        line += fmt::format(" | loss {:.3f} | policy {:.1f} % | value error {:.3f}", held_out_.loss,
                            100 * held_out_.policy_accuracy, held_out_.value_error);
    told_ = now;
    return line + time_left(now);
}

std::string Progress::time_left(const Standing& now) const {
    const double elapsed = now.state.seconds - first_.state.seconds;
    std::optional<double> left;
    if (bounds_.minutes) left = *bounds_.minutes * 60 - elapsed;
    const double games_rate = rate(now.state.games, first_.state.games, elapsed);
    if (bounds_.games && games_rate > 0) {
        const double by_games =
            (static_cast<double>(*bounds_.games) - static_cast<double>(now.state.games)) /
            games_rate;
        left = std::min(left.value_or(by_games), by_games);
    }
    return left ? fmt::format(" | left {}", duration(std::max(*left, 0.0))) : "";
}

Entry Progress::take_entry(const Standing& now) {
    const double seconds = now.state.seconds - entered_.state.seconds;
    Entry entry;
    entry.seconds = now.state.seconds;
    entry.games = now.state.games;
    entry.positions = now.state.positions;
    entry.steps = now.steps;
    entry.played = std::exchange(played_, {});
    entry.games_per_hour = 3600 * rate(now.state.games, entered_.state.games, seconds);
    entry.evaluations_per_second = rate(now.evaluations, entered_.evaluations, seconds);
    if (seconds > 0) entry.learner_share = (now.learn_seconds - entered_.learn_seconds) / seconds;
    const auto positions = now.positions - entered_.positions;
    if (positions > 0)
        entry.ratio =
            static_cast<double>(now.samples - entered_.samples) / static_cast<double>(positions);
    entered_ = now;
    return entry;
}

}  // namespace selfplay::training
