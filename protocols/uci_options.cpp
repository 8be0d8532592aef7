// The options that UCI and USI offer, by the names that GUIs know.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "protocols/uci.h"

namespace protocols {

namespace {

constexpr std::uint64_t simulations_limit = 1'000'000'000;

template <class T>
T number_within(std::string_view name, std::string_view text, T least, T most) {
    const T value = engine::parse_number<T>(text);
    if (value < least || value > most)
        engine::fail("{} must lie in {}..{}, not {}", name, least, most, text);
    return value;
}

bool yes_or_no(std::string_view name, std::string_view text) {
    if (text != "true" && text != "false")
        engine::fail("{} must be true or false, not {}", name, text);
    return text == "true";
}

// What each kind of row is called in a declaration; GUIs know no broken numbers, so those are
// strings.
std::string declaration(const engine::OptionRow& row) {
    switch (row.kind) {
        case engine::OptionRow::Kind::whole_number:
            return fmt::format("type spin default {} min {} max {}", row.value, row.least,
                               row.most);
        case engine::OptionRow::Kind::flag:
            return fmt::format("type check default {}", row.value);
        case engine::OptionRow::Kind::choice:
            return fmt::format("type combo default {} var {}", row.value,
                               fmt::join(row.choices, " var "));
        case engine::OptionRow::Kind::number:
            break;
    }
    return fmt::format("type string default {}", row.value);
}

// The search's own under the names that lc0 gave them, where it has any.
constexpr std::pair<std::string_view, std::string_view> search_options[] = {
    {"SearchMethod", "search"},
    {"MinibatchSize", "batch"},
    {"CPuct", "cpuct"},
    {"CPuctBase", "cpuct-base"},
    {"CPuctFactor", "cpuct-factor"},
    {"FpuValue", "fpu-reduction"},
    {"FpuValueAtRoot", "root-fpu-reduction"},
    {"VirtualLoss", "virtual-loss"},
    {"PolicyTemperature", "policy-temperature"},
    {"Temperature", "temperature"},
    {"TemperaturePlies", "temperature-plies"},
    {"DirichletNoiseEpsilon", "noise"},
    {"DirichletNoiseAlpha", "noise-alpha"},
    {"DrawScore", "draw-score"},
    {"Lambda", "lambda"},
    {"LowerBound", "lower-bound"},
    {"Solver", "solver"},
};

}  // namespace

std::vector<UciOption> Uci::common_options() {
    const auto number = [this](std::string name, std::string_view row) {
        return row_option(std::move(name), row);
    };
    std::vector<UciOption> options{
        number("Threads", "threads"), number(std::string(dialect_.hash_option), "memory"),
        number(dialect_.knows_resignation ? "NetworkDelay" : "Move Overhead", "lag"),
        number("Seed", "seed")};
    options.push_back(
        {"VerboseMoveStats", "type check default false",
         [this](std::string_view text) { verbose_ = yes_or_no("VerboseMoveStats", text); }});
    options.push_back({"WeightsFile", "type string default <empty>", [this](std::string_view text) {
                           set_network(text == "<empty>" ? "" : std::string(text), precision_);
                       }});
    options.push_back({"Precision",
                       fmt::format("type combo default auto var {}",
                                   fmt::join(search::precision_choices(), " var ")),
                       [this](std::string_view text) {
                           const auto choice = search::precision_choice(text);
                           if (choice != precision_) set_network(weights_, choice);
                       }});
    options.push_back(
        {"MultiPV", "type spin default 1 min 1 max 256",
         [this](std::string_view text) { multi_pv_ = number_within("MultiPV", text, 1, 256); }});
    options.push_back({std::string(dialect_.ponder_option), "type check default true",
                       [this](std::string_view text) {
                           offers_ponder_ = yes_or_no(dialect_.ponder_option, text);
                       }});
    options.push_back({dialect_.knows_resignation ? "ClearHash" : "Clear Hash", "type button",
                       [this](std::string_view) { session_->new_game(); }});
    if (dialect_.knows_resignation)
        options.push_back({"ResignThreshold", "type spin default 0 min 0 max 1000",
                           [this](std::string_view text) {
                               resign_per_mille_ = number_within("ResignThreshold", text, 0, 1000);
                           }});
    else
        options.push_back(
            {"UCI_AnalyseMode", "type check default false", [this](std::string_view text) {
                 const bool analyse = yes_or_no("UCI_AnalyseMode", text);
                 change([&](auto& params) { params.early_end = !analyse; });
             }});
    options.push_back(
        {"Contempt", "type spin default 0 min -100 max 100", [this](std::string_view text) {
             const int contempt = number_within("Contempt", text, -100, 100);
             change([&](auto& params) { params.draw_score = static_cast<float>(-contempt) / 100; });
         }});
    options.push_back({"UCI_ShowWDL", "type check default false", [this](std::string_view text) {
                           shows_wdl_ = yes_or_no("UCI_ShowWDL", text);
                       }});
    options.push_back(
        {"UCI_ShowMovesLeft", "type check default false", [this](std::string_view text) {
             shows_moves_left_ = yes_or_no("UCI_ShowMovesLeft", text);
         }});
    for (const auto& [name, row] : search_options)
        options.push_back(number(std::string(name), row));
    add_strength(options);
    return options;
}

// A row of the search's parameters under a protocol's name for it.
UciOption Uci::row_option(std::string name, std::string_view row) {
    const auto rows = engine::option_rows(session_->params());
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.name == row; });
    return {std::move(name), declaration(*found), [this, row](std::string_view text) {
                change([&](auto& params) { engine::set_option(params, row, text); });
            }};
}

// Strength for people, by a level, by simulations, or by a rating that is turned into a level.
void Uci::add_strength(std::vector<UciOption>& options) {
    options.push_back(
        row_option(dialect_.knows_resignation ? "SkillLevel" : "Skill Level", "level"));
    options.push_back({"Simulations",
                       fmt::format("type spin default 0 min 0 max {}", simulations_limit),
                       [this](std::string_view text) {
                           limit_simulations(number_within<std::uint64_t>("Simulations", text, 0,
                                                                          simulations_limit));
                       }});
    if (dialect_.knows_resignation) return;
    options.push_back(
        {"UCI_LimitStrength", "type check default false", [this](std::string_view text) {
             limits_strength_ = yes_or_no("UCI_LimitStrength", text);
             limit_strength();
         }});
    options.push_back({"UCI_Elo",
                       fmt::format("type spin default {} min {} max {}", search::strongest_elo,
                                   search::weakest_elo, search::strongest_elo),
                       [this](std::string_view text) {
                           elo_ = number_within("UCI_Elo", text, search::weakest_elo,
                                                search::strongest_elo);
                           limit_strength();
                       }});
}

void Uci::limit_strength() {
    change([this](auto& params) {
        params.level = limits_strength_ ? search::level_of_elo(elo_) : search::full_level;
    });
}

}  // namespace protocols
