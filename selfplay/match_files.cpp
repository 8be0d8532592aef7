#include "selfplay/match_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "engine/base/error.h"
#include "engine/base/files.h"

namespace selfplay {

namespace {

nlohmann::json parse_identity(const std::filesystem::path& path, std::string_view line) {
    auto json = nlohmann::json::parse(line, nullptr, false);
    if (json.is_discarded() || !json.is_object())
        engine::fail("{}: does not begin with the settings of a match", path.string());
    return json;
}

// The settings in which they differ, with both values.
std::string differences(const nlohmann::json& old, const nlohmann::json& now) {
    const auto flat_old = old.flatten(), flat_now = now.flatten();
    std::string text;
    const auto note = [&](const std::string& key) {
        const auto show = [&](const nlohmann::json& json) {
            return json.contains(key) ? json[key].dump() : std::string("nothing");
        };
        text += fmt::format("{}{}: {} there, {} here", text.empty() ? "" : "; ", key.substr(1),
                            show(flat_old), show(flat_now));
    };
    for (const auto& [key, value] : flat_old.items())
        if (!flat_now.contains(key) || flat_now[key] != value) note(key);
    for (const auto& [key, value] : flat_now.items())
        if (!flat_old.contains(key)) note(key);
    return text;
}

}  // namespace

MatchFiles::MatchFiles(std::filesystem::path folder, const std::string& identity,
                       const Rulebook& rulebook)
    : folder_(std::move(folder)), rulebook_(rulebook) {
    if (folder_.empty()) return;
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) engine::fail("{}: cannot make the folder: {}", folder_.string(), error.message());
    if (std::filesystem::exists(lines_path())) resume(identity);
    rewrite(identity);
}

std::filesystem::path MatchFiles::games_path() const {
    return folder_ / fmt::format("games.{}", rulebook_.extension());
}

void MatchFiles::resume(const std::string& identity) {
    const auto text = engine::read_file(lines_path());
    bool first = true;
    for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos;
         begin = end + 1) {
        const auto line = std::string_view(text).substr(begin, end - begin);
        if (!std::exchange(first, false)) {
            resumed_.push_back(record_from_json(line));
            continue;
        }
        const auto old = parse_identity(lines_path(), line), now = nlohmann::json::parse(identity);
        if (old != now)
            engine::fail("{}: holds a match of other settings ({}); take another folder",
                         lines_path().string(), differences(old, now));
    }
}

void MatchFiles::rewrite(const std::string& identity) const {
    std::string lines = identity + '\n', games;
    for (const auto& record : resumed_) {
        lines += to_json(record) + '\n';
        games += rulebook_.to_text(record);
    }
    engine::write_file(lines_path(), lines);
    engine::write_file(games_path(), games);
}

void MatchFiles::add(const GameRecord& record) {
    if (folder_.empty()) return;
    engine::append_file(lines_path(), to_json(record) + '\n');
    engine::append_file(games_path(), rulebook_.to_text(record));
}

}  // namespace selfplay
