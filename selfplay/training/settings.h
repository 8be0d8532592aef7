// All settings of a run: the recipes they start from, the file they are kept in, and their names,
// which are flags of the command line and keys of the file alike.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "selfplay/training/actor_settings.h"
#include "selfplay/training/learn_settings.h"
#include "selfplay/training/network_settings.h"
#include "selfplay/training/replay_settings.h"
#include "selfplay/training/run_settings.h"

namespace selfplay::training {

struct Settings {
    std::string game = "go", preset = "laptop";
    RunSettings run;
    NetworkSettings network;
    ActorSettings actors;
    ReplaySettings replay;
    LearnSettings learn;
};

// Silver et al. 2017 ("alphagozero"), 2018 ("alphazero"), and "laptop": what pays on few cores.
inline constexpr std::array<std::string_view, 3> preset_names = {"laptop", "alphazero",
                                                                 "alphagozero"};
// `size`: of a Go board. Fails with engine::Error, naming those there are, on another preset or
// game.
Settings preset_settings(std::string_view preset, std::string_view game, int size);

// Every row of every table, with its value.
std::vector<engine::OptionRow> setting_rows(const Settings& settings);
// Fails with engine::Error, one line, on a name that there is not and on a bad value.
void set_setting(Settings& settings, std::string_view name, std::string_view text);
// Fails with engine::Error on settings that do not fit each other or the game.
void check(const Settings& settings);

std::string to_json(const Settings& settings);
// What the text leaves out is as in the preset it names. Fails with engine::Error, one line.
Settings settings_from_json(std::string_view text);

// The settings in a folder of a run, `changes` (name and value) on top of them; fails when these
// would make another network or game of it. A folder without settings, or no folder, has those of
// the preset.
struct Wanted {
    std::optional<std::string> game, preset;
    std::optional<int> size;
    bool taught = false;  // a new run begins with a network that needs no rollouts to judge for it
    std::vector<std::pair<std::string, std::string>> changes;
};
Settings settings_for(const std::filesystem::path& folder, const Wanted& wanted);
// Keeps them there; whatever fails, the old file stays whole.
void keep_settings(const std::filesystem::path& folder, const Settings& settings);

}  // namespace selfplay::training
