// GTP commands about the engine itself and its settings.
#include <fmt/format.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "protocols/gtp.h"

namespace protocols {

namespace {

// A parameter under the names that other engines gave it. The search's own rows come on top.
struct Parameter {
    std::string_view kata, lz;
    std::string (*read)(const GtpSettings&);
    void (*write)(GtpSettings&, std::string_view);
};

template <class T>
T within(std::string_view name, std::string_view text, T least, T most) {
    const T value = engine::parse_number<T>(text);
    if (value < least || value > most)
        engine::fail("{} must lie in {}..{}, not {}", name, least, most, text);
    return value;
}

constexpr std::uint64_t most_visits = 1'000'000'000'000;

constexpr Parameter parameters[] = {
    {"maxVisits", "Visits", [](const GtpSettings& s) { return fmt::format("{}", s.visits); },
     [](GtpSettings& s, std::string_view text) {
         s.visits = within<std::uint64_t>("maxVisits", text, 0, most_visits);
     }},
    {"maxPlayouts", "Playouts",
     [](const GtpSettings& s) { return fmt::format("{}", s.simulations); },
     [](GtpSettings& s, std::string_view text) {
         s.simulations = within<std::uint64_t>("maxPlayouts", text, 0, most_visits);
     }},
    {"maxTime", "", [](const GtpSettings& s) { return fmt::format("{:g}", s.seconds); },
     [](GtpSettings& s, std::string_view text) {
         s.seconds = within<double>("maxTime", text, 0.001, 1e6);
     }},
    {"Precision", "Precision",
     [](const GtpSettings& s) { return std::string(search::name_of(s.precision)); },
     [](GtpSettings& s, std::string_view text) { s.precision = search::precision_choice(text); }},
    {"ponderingEnabled", "Pondering",
     [](const GtpSettings& s) { return std::string(s.ponder ? "true" : "false"); },
     [](GtpSettings& s, std::string_view text) {
         s.ponder = Words(text).yes_or_no("ponderingEnabled");
     }},
    {"resignThreshold", "",
     [](const GtpSettings& s) { return fmt::format("{:g}", 2 * s.resign_below - 1); },
     [](GtpSettings& s, std::string_view text) {
         s.resign_below = (within<double>("resignThreshold", text, -1, 0) + 1) / 2;
     }},
    {"", "Resign Percentage",
     [](const GtpSettings& s) { return fmt::format("{:g}", 100 * s.resign_below); },
     [](GtpSettings& s, std::string_view text) {
         s.resign_below = within<double>("Resign Percentage", text, 0, 50) / 100;
     }},
};

// Settings of the search by foreign names.
constexpr std::pair<std::string_view, std::string_view> search_names[] = {
    {"numSearchThreads", "threads"},
    {"Maximum Memory Use (MiB)", "memory"},
    {"Lagbuffer", "lag"},
    {"cpuctExploration", "cpuct"},
    {"cpuctExplorationBase", "cpuct-base"},
    {"fpuReductionMax", "fpu-reduction"},
    {"rootFpuReductionMax", "root-fpu-reduction"},
    {"numVirtualLossesPerThread", "virtual-loss"},
    {"nnPolicyTemperature", "policy-temperature"},
    {"rootPolicyTemperature", "root-policy-temperature"},
    {"chosenMoveTemperature", "temperature"},
    {"useLcbForSelection", "lower-bound"},
};

std::string_view row_of(std::string_view name) {
    for (const auto& [foreign, row] : search_names)
        if (foreign == name) return row;
    return name;
}

}  // namespace

std::string Gtp::protocol_version(Words&) { return "2"; }
std::string Gtp::name(Words&) { return settings_.name; }
std::string Gtp::version(Words&) { return SANBAN_VERSION; }
std::string Gtp::nothing(Words&) { return ""; }

std::string Gtp::stop(Words&) {
    ponder_on_.reset();
    return "";
}

std::string Gtp::known_command(Words& words) {
    return !words.empty() && find(words.take("the command")) ? "true" : "false";
}

std::string Gtp::list_commands(Words&) {
    std::string text;
    for (const auto& command : commands())
        text.append(text.empty() ? "" : "\n").append(command.name);
    return text;
}

std::string Gtp::help(Words& words) {
    const auto line = [](const Command& command) {
        return fmt::format("{}{}{}: {}", command.name, command.arguments.empty() ? "" : " ",
                           command.arguments, command.help);
    };
    if (!words.empty()) {
        const auto name = words.take("the command");
        if (const Command* command = find(name)) return line(*command);
        engine::fail("there is no command {}", name);
    }
    std::string text;
    for (const auto& command : commands()) text.append(text.empty() ? "" : "\n") += line(command);
    return text;
}

std::string Gtp::quit(Words&) {
    quitting_ = true;
    return "";
}

std::string Gtp::clear_cache(Words&) {
    session_.new_game();
    judge_.forget();
    forget();
    return "";
}

// What the views show of the last search.
void Gtp::forget() {
    last_picture_ = {};
    last_root_.reset();
}

std::string Gtp::cpu_time(Words&) {
    timespec used{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return fmt::format("{:.3f}",
                       static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec));
}

std::string Gtp::chat(Words& words) {
    words.take("the kind");
    words.take("the name");
    return fmt::format("I am {} {}, playing by tree search", settings_.name, SANBAN_VERSION);
}

std::string Gtp::level(Words& words) {
    change_params("level", words.take("the level"));
    return "";
}

std::string Gtp::random_seed(Words&) { return fmt::format("{}", session_.params().seed); }

std::string Gtp::set_random_seed(Words& words) {
    change_params("seed", words.take("the seed"));
    // The same seed again starts the same random numbers again.
    return clear_cache(words);
}

std::string Gtp::memory_report(Words&) {
    return fmt::format("{:.1f} % of {} MiB in use",
                       100 * session_.searcher().analysis(0).memory_used,
                       session_.params().memory_mib);
}

std::string Gtp::set_option(Words& words) {
    if (words.take("name") != "name") engine::fail("usage: lz-setoption name NAME value VALUE");
    std::string name, value;
    while (!words.empty() && words.peek() != "value")
        name.append(name.empty() ? "" : " ").append(words.take("the name"));
    if (!words.empty()) words.take("value");
    value = words.rest();
    for (const auto& parameter : parameters)
        if (parameter.lz == name && !name.empty())
            return parameter.write(settings_, value), renew_network(), "";
    if (name == "WeightsFile") return load_weights(value), "";
    // In centiseconds.
    if (name == "Lagbuffer") value = std::to_string(10 * within<int>(name, value, 0, 1000));
    change_params(row_of(name), value);
    return "";
}

std::string Gtp::list_params(Words&) {
    std::string text;
    for (const auto& parameter : parameters)
        if (!parameter.kata.empty()) text.append(parameter.kata).append("\n");
    for (const auto& row : engine::option_rows(session_.params()))
        text.append(row.name).append("\n");
    for (const auto& [foreign, row] : search_names)
        if (foreign.find(' ') == foreign.npos) text.append(foreign).append("\n");
    return text.substr(0, text.size() - 1);
}

std::string Gtp::all_params(Words&) {
    nlohmann::ordered_json all;
    for (const auto& parameter : parameters)
        if (!parameter.kata.empty()) all[std::string(parameter.kata)] = parameter.read(settings_);
    for (const auto& row : engine::option_rows(session_.params()))
        all[std::string(row.name)] = row.value;
    return all.dump();
}

std::string Gtp::param(Words& words) {
    const auto name = words.take("the name");
    for (const auto& parameter : parameters)
        if (parameter.kata == name) return parameter.read(settings_);
    for (const auto& row : engine::option_rows(session_.params()))
        if (row.name == row_of(name)) return row.value;
    engine::fail("there is no parameter {}", name);
}

std::string Gtp::set_param(Words& words) {
    const auto name = words.take("the name");
    if (name == "WeightsFile") return load_weights(std::string(words.rest())), "";
    const auto value = words.take("the value");
    for (const auto& parameter : parameters)
        if (parameter.kata == name) return parameter.write(settings_, value), renew_network(), "";
    change_params(row_of(name), value);
    return "";
}

std::string Gtp::set_params(Words& words) {
    const auto json = nlohmann::json::parse(words.rest(), nullptr, false);
    if (!json.is_object()) engine::fail("not a JSON object: {}", words.rest().substr(0, 60));
    const auto settings = settings_;
    const auto params = session_.params();
    try {
        for (const auto& [name, value] : json.items()) {
            Words pair(name + " " + (value.is_string() ? value.get<std::string>() : value.dump()));
            set_param(pair);
        }
    } catch (const engine::Error&) {
        settings_ = settings;
        session_.set_params(params);
        throw;
    }
    return "";
}

// By an empty name none.
void Gtp::load_weights(const std::string& file) {
    session_.load_network(file, settings_.precision);
    settings_.weights = file;
    network_precision_ = settings_.precision;
}

// After a change of settings.
void Gtp::renew_network() {
    if (!settings_.weights.empty() && settings_.precision != network_precision_)
        load_weights(settings_.weights);
}

void Gtp::change_params(std::string_view row, std::string_view value) {
    auto params = session_.params();
    engine::set_option(params, row, value);
    session_.set_params(params);
    judge_.set_params(params);
}

}  // namespace protocols
