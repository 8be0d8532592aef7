#include "selfplay/training/settings.h"

#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/games.h"

namespace selfplay::training {

namespace {

using Json = nlohmann::ordered_json;
using engine::fail;
using engine::OptionRow;

template <class All, class Visit>
void for_tables(All& settings, Visit visit) {
    visit(settings.network);
    visit(settings.actors);
    visit(settings.run);
    visit(settings.replay);
    visit(settings.learn);
}

template <class Table>
bool has_row(const Table& table, std::string_view name) {
    for (const auto& row : engine::option_rows(table))
        if (row.name == name) return true;
    return false;
}

Json value_of(const OptionRow& row) {
    if (row.kind == OptionRow::Kind::flag) return row.value == "true";
    if (row.kind == OptionRow::Kind::choice) return row.value;
    return Json::parse(row.value);
}

std::string text_of(const std::string& name, const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number() || value.is_boolean()) return value.dump();
    fail("{} must be a number, a word, true or false, not {}", name, value.dump());
}

std::filesystem::path file_in(const std::filesystem::path& folder) {
    return folder / "settings.json";
}

// What two settings of one run must have in common.
void check_same_network(const Settings& old, const Settings& wanted,
                        const std::filesystem::path& folder) {
    const auto was = engine::option_rows(old.network), is = engine::option_rows(wanted.network);
    for (std::size_t i = 0; i < was.size(); ++i)
        if (was[i].value != is[i].value)
            fail("{} is a run with {} {}, which cannot become {}; name another folder",
                 folder.string(), was[i].name, was[i].value, is[i].value);
    if (old.network.heads == HeadKind::flat && old.actors.size != wanted.actors.size)
        fail("{} is a run on {}x{} with flat heads, which serve no other size; name another folder",
             folder.string(), old.actors.size, old.actors.size);
}

}  // namespace

std::vector<OptionRow> setting_rows(const Settings& settings) {
    std::vector<OptionRow> rows;
    for_tables(settings, [&](const auto& table) {
        for (auto& row : engine::option_rows(table)) rows.push_back(std::move(row));
    });
    return rows;
}

void set_setting(Settings& settings, std::string_view name, std::string_view text) {
    bool known = false;
    for_tables(settings, [&](auto& table) {
        if (!has_row(table, name)) return;
        engine::set_option(table, name, text);
        known = true;
    });
    if (!known) fail("there is no setting {}; sanban train --help lists them", name);
}

void check(const Settings& settings) {
    check(settings.actors);
    const bool go = settings.game == "go";
    if (!go && settings.network.encoding == EncodingName::katago_v7)
        fail("the encoding katago-v7 is of Go; take attacks or alphazero for {}", settings.game);
    if (go && settings.network.encoding == EncodingName::attacks)
        fail("the encoding attacks is of chess and shogi; take katago-v7 or alphazero for go");
    if (go && settings.network.heads == HeadKind::flat && settings.actors.least_size > 0)
        fail("flat heads serve one board size; take pooled heads or least-size 0");
    if (settings.learn.micro_batch > settings.learn.batch)
        fail("micro-batch ({}) must not exceed learn-batch ({})", settings.learn.micro_batch,
             settings.learn.batch);
    if (settings.run.last_simulations > 0 && settings.run.growth_games == 0)
        fail("last-simulations wants growth-games: over how many games simulations grow");
    learner_settings(settings.learn, {}, 1);
}

std::string to_json(const Settings& settings) {
    Json json{{"game", settings.game}, {"preset", settings.preset}};
    for (const auto& row : setting_rows(settings)) json[std::string(row.name)] = value_of(row);
    return json.dump(1) + '\n';
}

Settings settings_from_json(std::string_view text) {
    const auto json = Json::parse(text, nullptr, false);
    if (!json.is_object()) fail("not JSON, expected an object of settings");
    const auto word = [&](const char* name, const char* otherwise) {
        return json.contains(name) ? text_of(name, json[name]) : std::string(otherwise);
    };
    const auto size = engine::parse_number<int>(word("size", "9"));
    auto settings = preset_settings(word("preset", "laptop"), word("game", "go"), size);
    for (const auto& [name, value] : json.items())
        if (name != "game" && name != "preset") set_setting(settings, name, text_of(name, value));
    return settings;
}

Settings settings_for(const std::filesystem::path& folder, const Wanted& wanted) {
    const auto file = file_in(folder);
    Settings settings, old;
    const bool resumed = !folder.empty() && std::filesystem::exists(file);
    if (resumed) {
        try {
            old = settings_from_json(engine::read_file(file));
        } catch (const engine::Error& error) {
            fail("{}: {}", file.string(), error.what());
        }
        if (wanted.game && *wanted.game != old.game)
            fail("{} is a run of {}, not of {}; name another folder", folder.string(), old.game,
                 *wanted.game);
        if (wanted.preset && *wanted.preset != old.preset)
            fail("{} is a run of preset {}, not of {}; name another folder", folder.string(),
                 old.preset, *wanted.preset);
        settings = old;
        if (wanted.size) settings.actors.size = *wanted.size;
    } else {
        settings = preset_settings(wanted.preset.value_or("laptop"), wanted.game.value_or("go"),
                                   wanted.size.value_or(9));
        if (wanted.taught) settings.run.rollout_games = 0;
    }
    for (const auto& [name, text] : wanted.changes) set_setting(settings, name, text);
    check(settings);
    if (resumed) check_same_network(old, settings, folder);
    return settings;
}

void keep_settings(const std::filesystem::path& folder, const Settings& settings) {
    engine::write_file(file_in(folder), to_json(settings));
}

}  // namespace selfplay::training
