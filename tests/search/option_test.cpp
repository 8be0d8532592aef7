#include "engine/base/option.h"

#include <gtest/gtest.h>

#include <array>

#include "search/params.h"

namespace engine {
namespace {

enum class Style { calm, wild };

struct Tunables {
    int threads = 2;
    float rate = 0.5f;
    bool ponder = false;
    Style style = Style::calm;

    static constexpr std::array<std::string_view, 2> styles = {"calm", "wild"};
    static constexpr auto options() {
        using T = Tunables;
        return std::tuple{
            Option<T, int>{"threads", &T::threads, 1, 8, "how many"},
            Option<T, float>{"rate", &T::rate, 0, 1, "how fast"},
            Flag<T>{"ponder", &T::ponder, "think ahead"},
            Choice<T, Style>{"style", &T::style, styles, "how to play"},
        };
    }
};

std::string refusal(std::string_view name, std::string_view text) {
    Tunables tunables;
    try {
        set_option(tunables, name, text);
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Option, SetsEveryKind) {
    Tunables tunables;
    set_option(tunables, "threads", "8");
    set_option(tunables, "rate", "0.25");
    set_option(tunables, "ponder", "true");
    set_option(tunables, "style", "wild");
    EXPECT_EQ(tunables.threads, 8);
    EXPECT_EQ(tunables.rate, 0.25f);
    EXPECT_TRUE(tunables.ponder);
    EXPECT_EQ(tunables.style, Style::wild);
}

TEST(Option, RefusesNamingTheRange) {
    EXPECT_EQ(refusal("threads", "9"), "threads must lie in 1..8, not 9");
    EXPECT_EQ(refusal("threads", "two"), "threads must be a number in 1..8, not two");
    EXPECT_EQ(refusal("threads", "99999999999"),
              "threads must be a number in 1..8, not 99999999999");
    EXPECT_EQ(refusal("rate", "nan"), "rate must be a number in 0..1, not nan");
    EXPECT_EQ(refusal("ponder", "maybe"), "ponder must be true or false, not maybe");
    EXPECT_EQ(refusal("style", "mild"), "style must be one of calm, wild, not mild");
    EXPECT_EQ(refusal("speed", "1"), "unknown option: speed");
}

TEST(Option, ListsItsRows) {
    Tunables tunables;
    tunables.style = Style::wild;
    const auto rows = option_rows(tunables);
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].kind, OptionRow::Kind::whole_number);
    EXPECT_EQ(rows[0].value, "2");
    EXPECT_EQ(rows[0].most, "8");
    EXPECT_EQ(rows[1].value, "0.5");
    EXPECT_EQ(rows[2].value, "false");
    EXPECT_EQ(rows[3].value, "wild");
    EXPECT_EQ(rows[3].choices.size(), 2u);
}

// Every row of the search accepts its own value back.
TEST(Option, RowsRoundTrip) {
    search::SearchParams params;
    for (const auto& row : option_rows(params))
        EXPECT_NO_THROW(set_option(params, row.name, row.value));
}

}  // namespace
}  // namespace engine
