#include "engine/go/rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/base/error.h"

namespace go {

namespace {

constexpr auto simple = Ko::simple;
constexpr auto positional = Ko::positional;
constexpr auto situational = Ko::situational;
constexpr auto area = Scoring::area;
constexpr auto territory = Scoring::territory;
constexpr auto none = HandicapBonus::none;
constexpr auto all = HandicapBonus::stones;
constexpr auto one_less = HandicapBonus::stones_less_one;

constexpr std::array<NamedRules, 13> table{{
    {"chinese", {simple, area, Tax::none, false, all, true}, 7.5},
    {"chinese-ogs", {positional, area, Tax::none, false, all, true}, 7.5},
    {"chinese-kgs", {positional, area, Tax::none, false, all, true}, 7.5},
    {"tromp-taylor", {positional, area, Tax::none, true, none, false}, 7.5},
    {"japanese", {simple, territory, Tax::seki, false, none, false}, 6.5},
    {"korean", {simple, territory, Tax::seki, false, none, false}, 6.5},
    {"stone-scoring", {simple, area, Tax::all, false, none, true}, 7.5},
    {"ancient-territory", {simple, territory, Tax::all, false, none, false}, 6.5},
    {"aga", {situational, area, Tax::none, false, one_less, true}, 7.5},
    {"bga", {situational, area, Tax::none, false, one_less, true}, 7.5},
    {"french", {situational, area, Tax::none, false, one_less, true}, 7.5},
    {"new-zealand", {situational, area, Tax::none, true, none, true}, 7},
    {"ing", {positional, area, Tax::none, true, none, true}, 7.5},
}};

// KataGo's other names, and SGF's. Case, "-", "_" and blanks make no difference.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> aliases{{
    {"nz", "newzealand"},
    {"goe", "ing"},
    {"ancientarea", "stonescoring"},
}};

// A word of KataGo's for each value of a field.
template <class T>
struct Words {
    std::array<std::pair<std::string_view, T>, 3> rows;
    std::size_t count = 3;

    std::optional<T> value_of(std::string_view word) const {
        for (std::size_t i = 0; i < count; ++i)
            if (rows[i].first == word) return rows[i].second;
        return {};
    }
    std::string_view word_for(T value) const {
        return std::find_if(rows.begin(), rows.end(),
                            [&](const auto& row) { return row.second == value; })
            ->first;
    }
};

constexpr Words<Ko> ko_words{
    {{{"SIMPLE", simple}, {"POSITIONAL", positional}, {"SITUATIONAL", situational}}}};
constexpr Words<Scoring> scoring_words{{{{"AREA", area}, {"TERRITORY", territory}}}, 2};
constexpr Words<Tax> tax_words{{{{"NONE", Tax::none}, {"SEKI", Tax::seki}, {"ALL", Tax::all}}}};
constexpr Words<HandicapBonus> bonus_words{{{{"0", none}, {"N", all}, {"N-1", one_less}}}};
constexpr Words<bool> truth_words{{{{"FALSE", false}, {"TRUE", true}}}, 2};

std::string upper(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

std::string plain_name(std::string_view text) {
    std::string result;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)))
            result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const auto& [alias, name] : aliases)
        if (result == alias) return std::string(name);
    return result;
}

template <class T>
void read_word(T& field, const Words<T>& words, std::string_view name, std::string_view text) {
    const auto value = words.value_of(upper(text));
    if (!value) {
        std::string known;
        for (std::size_t i = 0; i < words.count; ++i)
            known += (i == 0 ? "" : ", ") + std::string(words.rows[i].first);
        engine::fail("{} is one of {}, not {}", name, known, text);
    }
    field = *value;
}

Rules rules_from_json(std::string_view text, Rules rules) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) engine::fail("rules are not a JSON object: {}", text);
    for (const auto& [field, value] : json.items()) {
        if (value.is_structured() || value.is_null()) engine::fail("bad value of rule {}", field);
        set_rule(rules, field, value.is_string() ? value.get<std::string>() : value.dump());
    }
    return rules;
}

}  // namespace

std::span<const NamedRules> named_rules() { return table; }

std::string to_json(const Rules& rules) {
    const nlohmann::json json{
        {"friendlyPassOk", rules.friendly_pass},
        {"hasButton", false},
        {"ko", ko_words.word_for(rules.ko)},
        {"scoring", scoring_words.word_for(rules.scoring)},
        {"suicide", rules.suicide},
        {"tax", tax_words.word_for(rules.tax)},
        {"whiteHandicapBonus", bonus_words.word_for(rules.white_handicap_bonus)}};
    return json.dump();
}

Rules rules_from_text(std::string_view text, const Rules& base) {
    const auto start = text.find_first_not_of(" \t");
    if (start != text.npos && text[start] == '{') return rules_from_json(text, base);
    const auto name = plain_name(text);
    if (name == "agabutton") engine::fail("no rules with a button (aga-button) here");
    for (const auto& row : table)
        if (plain_name(row.name) == name) return row.rules;
    std::string known;
    for (const auto& row : table) known += (known.empty() ? "" : ", ") + std::string(row.name);
    engine::fail("unknown rules {}; known are {}, and JSON", text, known);
}

void set_rule(Rules& rules, std::string_view field, std::string_view value) {
    if (field == "ko") return read_word(rules.ko, ko_words, field, value);
    if (field == "scoring") return read_word(rules.scoring, scoring_words, field, value);
    if (field == "tax") return read_word(rules.tax, tax_words, field, value);
    if (field == "suicide") return read_word(rules.suicide, truth_words, field, value);
    if (field == "whiteHandicapBonus")
        return read_word(rules.white_handicap_bonus, bonus_words, field, value);
    if (field == "friendlyPassOk") return read_word(rules.friendly_pass, truth_words, field, value);
    if (field != "hasButton") engine::fail("unknown rule {}", field);
    bool button = false;
    read_word(button, truth_words, field, value);
    if (button) engine::fail("no rules with a button (hasButton) here");
}

std::string describe(const Rules& rules) {
    for (const auto& row : table)
        if (row.rules == rules) return std::string(row.name);
    return to_json(rules);
}

Komi Komi::from_points(double points) {
    if (!(std::abs(points) <= 1000) || points * 2 != std::floor(points * 2))
        engine::fail("komi is a multiple of 0.5 from -1000 to 1000, not {}", points);
    return Komi(static_cast<int>(points * 2));
}

}  // namespace go
