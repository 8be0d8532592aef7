// `sanban selfplay`: games of a network against itself, written to a folder.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/games.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "protocols/stop_on_signal.h"
#include "search/load_network.h"
#include "selfplay/training/network_settings.h"
#include "selfplay/training/self_play.h"

namespace protocols {

namespace {

namespace training = selfplay::training;

struct SelfPlayFlags {
    std::string game = "go", folder;
    NetworkFlags network;
    training::NetworkSettings fresh;
    training::SelfPlaySettings play;
};

// The progress of self-play on stderr: on a terminal one line that is written over, elsewhere a
// line now and then.
class ProgressLine {
   public:
    explicit ProgressLine(const training::SelfPlaySettings& settings) : settings_(settings) {}

    void show(const training::SelfPlayProgress& progress) {
        constexpr double between = 15;
        if (!terminal_ && progress.seconds < next_) return;
        next_ = progress.seconds + between;
        fmt::print(stderr, "{}{}{}", terminal_ ? "\r" : "", text(progress),
                   terminal_ ? "\x1b[K" : "\n");
    }
    void end() const {
        if (terminal_) fmt::print(stderr, "\n");
    }

   private:
    std::string text(const training::SelfPlayProgress& progress) const {
        const double seconds = std::max(progress.seconds, 0.001);
        auto line = fmt::format("{:.0f} s: {} games, {} positions ({:.0f}/s), {:.0f} evaluations/s",
                                progress.seconds, progress.games, progress.positions,
                                static_cast<double>(progress.positions) / seconds,
                                static_cast<double>(progress.evaluations) / seconds);
        const auto left = [&](std::uint64_t done, std::uint64_t wanted) {
            const double more = static_cast<double>(wanted - std::min(wanted, done));
            return more * seconds / static_cast<double>(done);
        };
        if (settings_.games && progress.games > 0)
            line += fmt::format(", {:.0f} s left", left(progress.games, *settings_.games));
        else if (settings_.positions && progress.positions > 0)
            line += fmt::format(", {:.0f} s left", left(progress.positions, *settings_.positions));
        return line;
    }

    const training::SelfPlaySettings& settings_;
    bool terminal_ = ::isatty(STDERR_FILENO) != 0;
    double next_ = 0;
};

template <engine::Encoded G>
struct Trainee {
    std::shared_ptr<const search::EvaluatorSource<G>> network;
    std::uint64_t steps = 0;
};

template <engine::Encoded G>
Trainee<G> new_player(const SelfPlayFlags& input) {
    const G start = training::largest_position<G>(input.play.actors);
    auto graph = training::new_network(input.fresh, start, input.play.seed);
    const int board = engine::find_encoding<G>(input.fresh.encoding_name()).shape(start).height;
    const auto precision =
        input.network.precision.value_or(nn::served_precision(graph, nn::Precision::int16, board));
    const search::Network exact(graph, nn::Precision::fp32);
    const auto calibration = precision >= nn::Precision::int8
                                 ? search::calibration_of<G>({graph, {}, {}}, start)
                                 : nn::Calibration();
    return {std::make_shared<search::NetworkSource<G>>(exact.in(precision, calibration)), 0};
}

template <engine::Encoded G>
Trainee<G> player_of(const SelfPlayFlags& input) {
    if (input.network.weights.empty()) return new_player<G>(input);
    auto network = search::load_network<G>(input.network.weights, input.network.precision,
                                           training::largest_position<G>(input.play.actors));
    const auto steps = network->network()->graph().facts.steps;
    return {std::move(network), static_cast<std::uint64_t>(steps)};
}

void print(const training::SelfPlayProgress& progress) {
    const double seconds = std::max(progress.seconds, 0.001);
    const auto rate = [&](std::uint64_t number) { return static_cast<double>(number) / seconds; };
    fmt::print(
        "games {} games\npositions {} positions\ntaught {} positions\nresigned {} games\n"
        "games_per_hour {:.0f} games/h\npositions_per_second {:.0f} positions/s\n"
        "evals {:.0f} evals/s\n",
        progress.games, progress.positions, progress.taught, progress.resigned,
        3600 * rate(progress.games), rate(progress.positions), rate(progress.evaluations));
}

template <engine::Encoded G>
void play(const SelfPlayFlags& input) {
    const auto player = player_of<G>(input);
    selfplay::records::Archive archive(input.folder);
    if (!archive.damage().empty()) fmt::print(stderr, "{}\n", archive.damage());
    const StopOnSignal signals;
    training::SelfPlay<G> run(input.play, player.network, player.steps, archive);
    ProgressLine line(input.play);
    const auto progress = run.run(
        signals.token(), [&](const training::SelfPlayProgress& so_far) { line.show(so_far); });
    line.end();
    print(progress);
}

void add_bounds(CLI::App& app, SelfPlayFlags& input) {
    app.add_option("--game", input.game, "what to play")
        ->check(CLI::IsMember({"go", "chess", "shogi"}))
        ->capture_default_str();
    app.add_option("--dir", input.folder, "folder that the games are added to")->required();
    app.add_option("--games", input.play.games, "end when so many are played");
    app.add_option("--positions", input.play.positions, "end when so many are written");
    app.add_option("--threads", input.play.threads, "each with games of its own")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--seed", input.play.seed, "of all randomness")->capture_default_str();
}

}  // namespace

int run_selfplay(Arguments arguments) {
    CLI::App app(
        "Plays a network against itself and writes the games, until stopped. Without --weights the "
        "network is a new one with random weights",
        "sanban selfplay");
    SelfPlayFlags input;
    input.play.threads = default_threads();
    add_bounds(app, input);
    add_network_flags(app, input.network);
    add_settings_flags(app, input.fresh, "A new network");
    add_settings_flags(app, input.play.actors, "How games are played");
    if (const auto status = parse_flags(app, arguments)) return *status;
    engine::Games::visit(input.game, [&]<class G>() { return play<G>(input), true; });
    return 0;
}

}  // namespace protocols
