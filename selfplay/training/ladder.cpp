#include "selfplay/training/ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/files.h"

namespace selfplay::training {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Networks of one run are believed to be somewhere about its weakest opponent.
constexpr Belief of_a_network{0, 600};

std::optional<fs::path> gnugo() {
    for (const auto* folder : {"/usr/games", "/usr/bin", "/usr/local/bin"})
        if (const auto path = fs::path(folder) / "gnugo"; fs::exists(path)) return path;
    return std::nullopt;
}

}  // namespace

Ladder::Ladder(const RunFolder& folder, const Settings& settings, int threads)
    : folder_(folder), settings_(settings), threads_(threads), fixed_(fixed_opponents()) {
    for (const auto& fixed : fixed_) rungs_.push_back({fixed.name, -1, 0, {fixed.belief.elo, 0}});
    fs::create_directories(folder.snapshots());
    read();
    rate();
}

std::vector<Ladder::Fixed> Ladder::fixed_opponents() const {
    std::vector<Fixed> fixed;
    for (const int simulations : {1000, 10'000, 100'000})
        fixed.push_back({fmt::format("UCT {}", simulations),
                         rollout_player(simulations),
                         {250 * (std::log10(simulations) - 3), 200}});
    const auto program = gnugo();
    if (settings_.game != "go" || settings_.actors.size < 7 || !program) return fixed;
    Fixed player{"GNU Go 10", {}, {400, 400}};
    player.player.command = program->string() +
                            " --mode gtp --level 10 --chinese-rules --capture-all-dead "
                            "--positional-superko";
    fixed.push_back(std::move(player));
    return fixed;
}

fs::path Ladder::file_of(const std::string& name) const {
    return folder_.snapshots() / (name.substr(name.find(' ') + 1) + ".safetensors");
}

PlayerSettings Ladder::player_of(std::size_t rung) const {
    if (rung < fixed_.size()) return fixed_[rung].player;
    return network_player(file_of(rungs_[rung].name), settings_.run.ladder_simulations, settings_);
}

std::size_t Ladder::rung_named(const std::string& name, double seconds) {
    for (std::size_t i = 0; i < rungs_.size(); ++i)
        if (rungs_[i].name == name) return i;
    rungs_.push_back({name, seconds, 0, {}});
    return rungs_.size() - 1;
}

// A line is a network that was kept, or the result of some games. What does not read is a torn end.
void Ladder::read() {
    if (!fs::exists(folder_.ladder())) return;
    const auto text = engine::read_file(folder_.ladder());
    for (std::size_t at = 0; at < text.size();) {
        const auto end = std::min(text.find('\n', at), text.size());
        const auto json = Json::parse(text.substr(at, end - at), nullptr, false);
        at = end + 1;
        if (!json.is_object()) continue;
        if (json.contains("kept")) {
            rung_named(json.value("kept", ""), json.value("seconds", 0.0));
        } else {
            const auto a = rung_named(json.value("a", ""), 0),
                       b = rung_named(json.value("b", ""), 0);
            add(a, b, {json.value("wins", 0), json.value("draws", 0), json.value("losses", 0)},
                json.value("took", 0.0));
        }
    }
    if (!text.empty() && text.back() != '\n') engine::append_file(folder_.ladder(), "\n");
}

void Ladder::add(std::size_t a, std::size_t b, const Tally& tally, double seconds) {
    pairings_.push_back({a, b, tally});
    rungs_[a].games += tally.games();
    rungs_[b].games += tally.games();
    if (seconds > 0) {
        rungs_[b].timed_games += tally.games();
        rungs_[b].timed_seconds += seconds;
    }
    played_ += static_cast<std::uint64_t>(tally.games());
}

void Ladder::rate() {
    std::vector<Belief> beliefs;
    for (std::size_t i = 0; i < rungs_.size(); ++i)
        beliefs.push_back(i < fixed_.size() ? fixed_[i].belief : of_a_network);
    const auto rated = strengths(beliefs, pairings_);
    for (std::size_t i = 0; i < rungs_.size(); ++i) rungs_[i].strength = rated[i];
}

void Ladder::keep(std::int64_t steps, double seconds) {
    const auto name = fmt::format("step {}", steps);
    engine::write_file(file_of(name), engine::read_file(folder_.latest()));
    const Json json{{"kept", name}, {"seconds", seconds}};
    engine::append_file(folder_.ladder(), json.dump() + '\n');
    rung_named(name, seconds);
    rate();
}

const Rung* Ladder::newest() const {
    return rungs_.size() > fixed_.size() ? &rungs_.back() : nullptr;
}

// Often at first, when much changes.
bool Ladder::wants_snapshot(double seconds) const {
    if (!newest()) return true;
    const double most = 60.0 * settings_.run.snapshot_minutes;
    return seconds - newest()->seconds >= std::min(most, std::max(120.0, seconds / 5));
}

int Ladder::games_between(std::size_t a, std::size_t b) const {
    int games = 0;
    for (const auto& pairing : pairings_)
        if ((pairing.a == a && pairing.b == b) || (pairing.a == b && pairing.b == a))
            games += pairing.tally.games();
    return games;
}

// Likely: as long as those that were timed. Where none was, UCT takes as much longer than a smaller
// UCT as it has more simulations; what nothing is known of is given the chance to be timed.
double Ladder::seconds_a_game(std::size_t opponent) const {
    const Rung& rung = rungs_[opponent];
    if (rung.timed_games > 0) return rung.timed_seconds / rung.timed_games;
    const auto simulations = [&](std::size_t fixed) {
        return static_cast<double>(fixed_[fixed].player.visits.value_or(0));
    };
    if (opponent >= fixed_.size() || simulations(opponent) == 0) return 0;
    for (std::size_t smaller = opponent; smaller-- > 0;)
        if (rungs_[smaller].timed_games > 0)
            return seconds_a_game(smaller) * simulations(opponent) / simulations(smaller);
    return 0;
}

// Whose result would tell most of those that can be paid for: neither too strong nor too weak, and
// not yet met often. The first, who costs least, where none can.
std::size_t Ladder::best_opponent(std::size_t rung, double most_seconds) const {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t i = 0; i < rungs_.size(); ++i) {
        if (i == rung) continue;
        if (i >= fixed_.size() && !fs::exists(file_of(rungs_[i].name))) continue;
        if (games_a_measure() * seconds_a_game(i) > most_seconds) continue;
        const double expected = share_of(rungs_[rung].strength.elo - rungs_[i].strength.elo);
        const double told = expected * (1 - expected) / (4 + games_between(rung, i));
        if (told > most) {
            most = told;
            best = i;
        }
    }
    return best;
}

void Ladder::measure(const std::stop_token& stop, double most_seconds) {
    if (!newest()) return;
    const std::size_t rung = rungs_.size() - 1, other = best_opponent(rung, most_seconds);
    Duel duel{player_of(rung), player_of(other), games_a_measure(), threads_, played_};
    const auto begun = std::chrono::steady_clock::now();
    const auto tally = play(settings_, duel, stop);
    if (tally.games() == 0) return;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    const Json json{{"a", rungs_[rung].name}, {"b", rungs_[other].name}, {"wins", tally.wins},
                    {"draws", tally.draws},   {"losses", tally.losses},  {"took", took.count()}};
    engine::append_file(folder_.ladder(), json.dump() + '\n');
    add(rung, other, tally, took.count());
    rate();
}

}  // namespace selfplay::training
