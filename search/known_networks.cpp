#include "search/known_networks.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "nn/backend.h"

namespace search {

namespace {

using Json = nlohmann::json;

std::optional<std::filesystem::path> place_of(const std::string& key) {
    const auto folder = engine::user_folder("XDG_CACHE_HOME", ".cache");
    if (!folder) return std::nullopt;
    return *folder / fmt::format("network-{}.json", key);
}

// Speeds hold for one version of the program and for processors that serve the same formats.
std::string circumstances(const nn::Graph& graph) {
    std::string text = SANBAN_VERSION;
    const int board = graph.facts.board > 0 ? graph.facts.board : 9;
    for (const auto precision : {nn::Precision::bf16, nn::Precision::int8, nn::Precision::int16})
        if (nn::served_precision(graph, precision, board) == precision)
            text.append(" ").append(nn::name_of(precision));
    return text;
}

std::map<int, nn::Precision> fastest_from(const Json& object) {
    std::map<int, nn::Precision> fastest;
    for (const auto& [board, name] : object.items())
        if (const auto precision = nn::precision_from(name.get<std::string>()))
            fastest[std::stoi(board)] = *precision;
    return fastest;
}

Json to_json(const std::map<int, nn::Precision>& fastest) {
    auto object = Json::object();
    for (const auto& [board, precision] : fastest)
        object[std::to_string(board)] = nn::name_of(precision);
    return object;
}

}  // namespace

KnownNetwork recall(const std::string& key, const nn::Graph& graph) {
    const auto path = place_of(key);
    std::error_code ignored;
    if (!path || !std::filesystem::is_regular_file(*path, ignored)) return {};
    try {
        const auto file = Json::parse(engine::read_file(*path));
        KnownNetwork known;
        known.calibration = nn::calibration_from(graph, file.at("maxima").get<nn::NamedMaxima>());
        if (file.at("circumstances") == circumstances(graph))
            known.fastest = fastest_from(file.at("fastest"));
        return known;
    } catch (const std::exception&) {
        return {};  // a damaged file is as good as none
    }
}

void remember(const std::string& key, const nn::Graph& graph, const KnownNetwork& known) {
    const auto path = place_of(key);
    if (!path) return;
    const Json file{{"circumstances", circumstances(graph)},
                    {"maxima", nn::named_maxima(graph, known.calibration)},
                    {"fastest", to_json(known.fastest)}};
    std::error_code ignored;
    std::filesystem::create_directories(path->parent_path(), ignored);
    try {
        engine::write_file(*path, file.dump());
    } catch (const engine::Error&) {
        return;  // the next start finds it out again
    }
}

}  // namespace search
