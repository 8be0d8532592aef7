// The rule sets of Go, by name and by field, and komi.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace go {

enum class Ko : std::uint8_t { simple, positional, situational };
enum class Scoring : std::uint8_t { area, territory };
enum class Tax : std::uint8_t { none, seki, all };
// Points White gets for N handicap stones: none, N, or N - 1.
enum class HandicapBonus : std::uint8_t { none, stones, stones_less_one };

// Chinese rules unless said otherwise.
struct Rules {
    Ko ko = Ko::simple;
    Scoring scoring = Scoring::area;
    Tax tax = Tax::none;
    bool suicide = false;  // of two stones or more; a single stone's is never allowed
    HandicapBonus white_handicap_bonus = HandicapBonus::stones;
    bool friendly_pass = true;  // dead stones are agreed on after two passes, not played out

    bool operator==(const Rules&) const = default;
};

struct NamedRules {
    std::string_view name;
    Rules rules;
    double usual_komi;
};

// Every rule set that has a name, `chinese` first.
std::span<const NamedRules> named_rules();

// The fields as JSON in KataGo's words:
// {"friendlyPassOk":false,"hasButton":false,"ko":"POSITIONAL","scoring":"AREA",…}
std::string to_json(const Rules& rules);
// A name from the table (any case), a name with KataGo's aliases, or JSON as above; fields left
// out of the JSON keep their value in `base`. Fails with engine::Error.
Rules rules_from_text(std::string_view text, const Rules& base = {});
// Sets one field by KataGo's name for it ("ko", "scoring", "tax", "suicide", "hasButton",
// "whiteHandicapBonus", "friendlyPassOk"). Fails with engine::Error.
void set_rule(Rules& rules, std::string_view field, std::string_view value);
// The name of the rule set if it has one, else its JSON.
std::string describe(const Rules& rules);

// White's compensation in half points, so that sums stay exact.
class Komi {
   public:
    constexpr Komi() = default;
    // Fails unless a multiple of 0.5 within ±1000.
    static Komi from_points(double points);
    static constexpr Komi from_halves(int halves) { return Komi(halves); }
    constexpr int halves() const { return halves_; }
    constexpr double points() const { return halves_ / 2.0; }
    bool operator==(const Komi&) const = default;

   private:
    explicit constexpr Komi(int halves) : halves_(halves) {}
    int halves_ = 15;
};

}  // namespace go
