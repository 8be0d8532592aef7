// `sanban bench`: what this machine does with the program, one figure a line: name value unit.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/chess/bench.h"
#include "engine/go/bench.h"
#include "engine/shogi/bench.h"
#include "nn/bench.h"
#include "nn/training/bench.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "search/bench.h"
#include "search/network_bench.h"
#include "selfplay/training/bench.h"

namespace protocols {

namespace {

using Figures = std::vector<engine::Figure>;

struct Group {
    std::string_view name;
    Figures (*measure)(double seconds);
};

Figures measure_rules(double seconds) {
    Figures all;
    for (const auto measure : {go::bench_rules, chess::bench_rules, shogi::bench_rules})
        for (auto& figure : measure(seconds)) all.push_back(std::move(figure));
    return all;
}

constexpr Group groups[] = {{"rules", measure_rules}, {"search", search::bench_search}};

void print(const Figures& figures) {
    for (const auto& [name, value, unit] : figures) {
        // Whole numbers lose nothing: rates are large, sizes and signatures are whole.
        fmt::print("{} {:.0f} {}\n", name, value, unit);
        std::fflush(stdout);
    }
}

struct MeasuredNetwork {
    std::string weights;
    search::PrecisionChoice precision;
    nn::BenchSettings settings{.board = 0};
};

void add_measured_network(CLI::App& app, MeasuredNetwork& flags) {
    app.add_option("--weights", flags.weights, "nn: a network; several standard ones unless given");
    app.add_option("--board", flags.settings.board, "nn: its board; the network's own, or 19")
        ->check(CLI::Range(1, 25));
    app.add_option_function<std::string>(
           "--precision",
           [&flags](const std::string& text) { flags.precision = search::precision_choice(text); },
           "nn: as of play; the next more exact one where it is lacking")
        ->default_str("auto");
    app.add_option("--threads", flags.settings.threads,
                   "nn, selfplay: each with an executor of its own")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    app.add_option("--batch", flags.settings.batch, "nn: positions at once")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
}

void bench_networks(const MeasuredNetwork& flags, double seconds) {
    auto settings = flags.settings;
    settings.seconds = seconds;
    if (flags.weights.empty()) return print(nn::bench_standard_networks(settings));
    print(search::bench_weights(flags.weights, flags.precision, settings));
}

}  // namespace

int run_bench(Arguments arguments) {
    CLI::App app("Speed of rules, search, networks and learning, a figure a line", "sanban bench");
    std::string wanted;
    double seconds = 1;
    app.add_option("group", wanted,
                   "rules, search, nn, learn or selfplay; rules and search unless given")
        ->check(CLI::IsMember({"rules", "search", "nn", "learn", "selfplay"}));
    app.add_option("--seconds", seconds, "for each figure")
        ->check(CLI::Range(0.01, 3600.0))
        ->capture_default_str();
    MeasuredNetwork network;
    add_measured_network(app, network);
    if (const auto status = parse_flags(app, arguments)) return *status;
    for (const auto& [name, measure] : groups)
        if (wanted.empty() || wanted == name) print(measure(seconds));
    if (wanted == "nn") bench_networks(network, seconds);
    if (wanted == "selfplay")
        print(selfplay::training::bench_self_play({network.settings.threads, seconds, {}}));
    if (wanted == "learn") print(nn::training::bench_learner(seconds));
    return 0;
}

}  // namespace protocols
