// The settings of training as flags, for the subcommands that train.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "selfplay/training/settings.h"

namespace protocols {

// Values by the names of settings; empty where the command line says nothing.
using SettingTexts = std::map<std::string, std::string>;

// A flag for every setting of every table. `texts` must outlive `app`.
void add_setting_flags(CLI::App& app, SettingTexts& texts);

// What was said on the command line.
selfplay::training::Wanted wanted_of(const SettingTexts& texts);

}  // namespace protocols
