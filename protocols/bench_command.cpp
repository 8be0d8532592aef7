// `sanban bench`: what this machine does with the program, one figure a line: name value unit.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/chess/bench.h"
#include "engine/go/bench.h"
#include "engine/shogi/bench.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "search/bench.h"

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

}  // namespace

int run_bench(Arguments arguments) {
    CLI::App app("Speed of the rules and the search, a figure a line", "sanban bench");
    std::string wanted;
    double seconds = 1;
    app.add_option("group", wanted, "rules or search; both unless given")
        ->check(CLI::IsMember({"rules", "search"}));
    app.add_option("--seconds", seconds, "for each figure")
        ->check(CLI::Range(0.01, 3600.0))
        ->capture_default_str();
    if (const auto status = parse_flags(app, arguments)) return *status;
    for (const auto& [name, measure] : groups)
        if (wanted.empty() || wanted == name) print(measure(seconds));
    return 0;
}

}  // namespace protocols
