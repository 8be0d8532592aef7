#include "protocols/setting_flags.h"

#include "protocols/flags.h"

namespace protocols {

void add_setting_flags(CLI::App& app, SettingTexts& texts) {
    for (const auto& row : selfplay::training::setting_rows({})) {
        const std::string name(row.name);
        app.add_option("--" + name, texts[name], help_of(row))
            ->default_str(row.value)
            ->group("Settings; defaults are those of the preset laptop");
    }
}

selfplay::training::Wanted wanted_of(const SettingTexts& texts) {
    selfplay::training::Wanted wanted;
    for (const auto& [name, text] : texts) {
        if (text.empty()) continue;
        wanted.changes.emplace_back(name, text);
        if (name == "size") wanted.size = engine::parse_number<int>(text);
    }
    return wanted;
}

}  // namespace protocols
