// The grammar of lz-analyze, kata-analyze, analyze and their genmove forms, as GUIs parse it.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <regex>
#include <thread>

#include "tests/protocols/gtp_guest.h"

namespace protocols {

namespace {

// A stream that one thread writes and another looks into.
struct Listener {
    explicit Listener(const GtpSettings& settings = small_game(5, 300))
        : gtp(settings, one_thread(), output) {}

    // Says `analysis` and, after its second report, a command that ends it: all that was written
    // before that command's own answer.
    std::string analyse(const std::string& analysis) {
        text.str("");
        gtp.handle(analysis);
        std::this_thread::sleep_for(std::chrono::milliseconds(60));
        gtp.handle("name");
        const auto all = text.str();
        EXPECT_TRUE(all.ends_with("= sanban\n\n")) << all;
        return all.substr(0, all.size() - std::string("= sanban\n\n").size());
    }

    std::ostringstream text;
    Output output{text};
    Gtp gtp;
};

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::size_t count(const std::string& text, std::string_view part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
    return found;
}

const std::string vertex = "(?:pass|[A-HJ-Z][0-9]+)";
const std::string integers = "info move " + vertex +
                             " visits [0-9]+ winrate [0-9]+ prior [0-9]+ lcb -?[0-9]+ order "
                             "[0-9]+ pv " +
                             vertex + "(?: " + vertex + ")*";
const std::string number = "-?[0-9]+\\.[0-9]+";
const std::string pv = " order [0-9]+ pv " + vertex + "(?: " + vertex + ")*";
const std::string values = " winrate " + number + " prior " + number + " lcb " + number;
const std::string floats = "info move " + vertex + " visits [0-9]+" + values + pv;
// KataGo's order of fields.
const std::string kata = "info move " + vertex + " visits [0-9]+ edgeVisits [0-9]+ utility " +
                         number + values + " utilityLcb " + number + pv +
                         "(?: pvVisits(?: [0-9]+)+)?";

void expect_reports(const std::string& text, const std::string& id, const std::string& line) {
    const auto lines = lines_of(text);
    ASSERT_GE(lines.size(), 3U) << text;
    EXPECT_EQ(lines.front(), "=" + id);
    EXPECT_EQ(lines.back(), "");
    const std::regex report(line);
    for (std::size_t i = 1; i + 1 < lines.size(); ++i)
        EXPECT_TRUE(std::regex_match(lines[i], report)) << lines[i];
}

}  // namespace

TEST(GtpAnalysis, LeelaZerosFormHasIntegers) {
    Listener guest;
    expect_reports(guest.analyse("7 lz-analyze b 1"), "7", integers + "(?: " + integers + ")*");
    expect_reports(guest.analyse("lz-analyze interval 2 maxmoves 1"), "", integers);
}

TEST(GtpAnalysis, TheCommonFormHasFloats) {
    Listener guest;
    expect_reports(guest.analyse("analyze W 1"), "", floats + "(?: " + floats + ")*");
}

TEST(GtpAnalysis, KataFormAddsRootAndOwnership) {
    Listener guest;
    const auto root =
        " rootInfo visits [0-9]+ utility " + number + " winrate " + number + " scoreLead " + number;
    const auto owners = " ownership(?: " + number + "){25}";
    expect_reports(guest.analyse("kata-analyze 1 rootInfo true ownership true maxmoves 2"), "",
                   kata + "(?: " + kata + ")?" + root + owners);
    expect_reports(guest.analyse("kata-analyze 1 pvVisits true ownership false maxmoves 1"), "",
                   kata);
    EXPECT_TRUE(has(guest.analyse("kata-analyze 1 pvVisits true maxmoves 1"), " pvVisits "));
}

TEST(GtpAnalysis, OwnershipBeginsAtTheTopLeftForTheMover) {
    Listener guest(small_game(5));
    // Black holds the upper two rows, White the lower two, each with two eyes, and komi leaves the
    // game open: a side that has lost may give its stones away, the longer it is searched the more.
    guest.gtp.handle("komi 0");
    guest.gtp.handle(
        "set_position b a4 b b4 b c4 b d4 b e4 b a5 b c5 b e5 w a2 w b2 w c2 w d2 w e2 w a1 w c1 "
        "w e1");
    for (const char* colour : {"b", "w"}) {
        const auto text =
            guest.analyse(std::string("kata-analyze ") + colour + " 1 ownership true maxmoves 1");
        const auto at = text.rfind("ownership ");
        ASSERT_NE(at, text.npos);
        std::istringstream in(text.substr(at + 10));
        std::vector<float> owners;
        for (float owner = 0; in >> owner;) owners.push_back(owner);
        ASSERT_EQ(owners.size(), 25U);
        const float sign = colour[0] == 'b' ? 1.0f : -1.0f;
        for (std::size_t i = 0; i < 5; ++i) {
            EXPECT_GT(sign * owners[i], 0.5f);
            EXPECT_LT(sign * owners[20 + i], -0.5f);
        }
    }
}

TEST(GtpAnalysis, RestrictionsAreObeyed) {
    Listener guest;
    const auto allowed = guest.analyse("lz-analyze b 1 allow b A1,b2 1");
    EXPECT_TRUE(has(allowed, "move A1 ") && has(allowed, "move B2 ")) << allowed;
    EXPECT_EQ(count(allowed, "info move "),
              count(allowed, "move A1 ") + count(allowed, "move B2 "));
    const auto avoided = guest.analyse("lz-analyze b 1 avoid b C3,pass 1 avoid w D4 1");
    EXPECT_FALSE(has(avoided, "move C3 ")) << avoided;
    EXPECT_FALSE(has(avoided, "move pass "));
    EXPECT_TRUE(has(avoided, "move D4 "));
}

TEST(GtpAnalysis, BadArgumentsAreRefused) {
    GtpGuest guest(small_game(5));
    EXPECT_EQ(guest.say("lz-analyze 1 minmoves"), "? minmoves is missing");
    EXPECT_EQ(guest.say("lz-analyze 1 maxmoves 0"), "? maxmoves must lie in 1..1000, not 0");
    EXPECT_EQ(guest.say("kata-analyze 1 ownership perhaps"),
              "? ownership must be true or false, not perhaps");
    EXPECT_EQ(guest.say("kata-analyze 1 xyzzy true"), "? xyzzy is no argument of an analysis");
    EXPECT_TRUE(guest.say("kata-analyze 1 allow b Z9 1").starts_with("? Z9 is no point"));
    EXPECT_EQ(guest.say("kata-analyze b 1 avoid b A1"), "? the depth is missing");
    EXPECT_EQ(guest.say("kata-genmove_analyze b 1 avoid blue A1 1"),
              "? the colour is b, w, black or white, not blue");
    EXPECT_EQ(guest.ask("move_history"), "=");
}

TEST(GtpAnalysis, AnEmptyLineEndsItToo) {
    GtpGuest guest(small_game(5));
    guest.gtp.handle("lz-analyze 1");
    guest.gtp.handle("");
    const auto text = guest.text.str();
    EXPECT_TRUE(text.starts_with("=\n") && text.ends_with("\n\n")) << text;
    EXPECT_EQ(guest.raw(""), "");
}

TEST(GtpAnalysis, GenmoveFormsEndWithThePlay) {
    for (const std::string name :
         {"lz-genmove_analyze", "kata-genmove_analyze", "genmove_analyze"}) {
        GtpGuest guest(small_game(5));
        const auto lines = lines_of(guest.raw("3 " + name + " b 1 allow b C3 1"));
        ASSERT_GE(lines.size(), 4U);
        EXPECT_EQ(lines[0], "=3");
        EXPECT_TRUE(std::regex_match(lines[1], std::regex(name[0] == 'l'   ? integers
                                                          : name[0] == 'k' ? kata
                                                                           : floats)))
            << lines[1];
        EXPECT_EQ(lines[lines.size() - 2], "play C3");
        EXPECT_EQ(lines.back(), "");
        EXPECT_EQ(guest.ask("last_move"), "black C3");
    }
}

TEST(GtpAnalysis, SearchFormsDoNotPlay) {
    GtpGuest guest(small_game(5));
    for (const std::string name : {"kata-search_analyze", "kata-search_analyze_cancellable"}) {
        const auto text = guest.raw(name + " w 1 allow w B2 1");
        EXPECT_TRUE(text.ends_with("\nplay B2\n\n")) << text;
        EXPECT_EQ(guest.ask("move_history"), "=");
    }
}

TEST(GtpAnalysis, ACancelledSearchSaysSo) {
    auto settings = small_game(9, 0);
    settings.seconds = 20;
    GtpGuest guest(settings);
    std::thread reader([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        guest.gtp.arrived("name");
    });
    const auto start = std::chrono::steady_clock::now();
    const auto text = guest.raw("kata-search_analyze_cancellable b 100");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    reader.join();
    EXPECT_TRUE(text.ends_with("\nplay cancelled\n\n")) << text;
}

TEST(GtpAnalysis, OnlyAnInterruptCutsAGenmove) {
    auto settings = small_game(9, 0);
    settings.seconds = 0.4;
    GtpGuest guest(settings);
    const auto time_of = [&](const char* line) {
        std::thread reader([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            guest.gtp.arrived(line);
        });
        const auto start = std::chrono::steady_clock::now();
        EXPECT_TRUE(guest.raw("reg_genmove b").starts_with("= "));
        reader.join();
        return std::chrono::steady_clock::now() - start;
    };
    EXPECT_GE(time_of("name"), std::chrono::milliseconds(390));
    EXPECT_LT(time_of("# interrupt"), std::chrono::milliseconds(300));
}

TEST(GtpAnalysis, ViewsOfTheLastSearchSurviveOtherSearches) {
    GtpGuest guest(small_game(5));
    EXPECT_EQ(guest.say("sanban-visits"), "? nothing has been searched yet");
    guest.say("set_position b a4 b b4 b c4 b d4 b e4 b a5 b c5 w a2 w b2 w c2 w d2 w e2");
    guest.say("reg_genmove w");
    const auto owners = guest.ask("sanban-ownership");
    EXPECT_TRUE(owners.starts_with("INFLUENCE A1 -")) << owners;
    EXPECT_TRUE(has(owners, " A5 0.9") || has(owners, " A5 1.0")) << owners;
    EXPECT_TRUE(guest.ask("sanban-variation").starts_with("VAR w "));
    EXPECT_TRUE(guest.ask("sanban-visits").starts_with("LABEL "));
    EXPECT_FALSE(guest.ask("top_moves").empty());
    guest.say("estimate_score");
    EXPECT_EQ(guest.ask("sanban-ownership"), owners);
    // On another board they would be of nothing.
    guest.say("boardsize 9");
    EXPECT_EQ(guest.say("sanban-ownership"), "? nothing has been searched yet");
    EXPECT_EQ(guest.say("sanban-variation"), "? nothing has been searched yet");
    EXPECT_EQ(guest.say("top_moves"), "=");
}

}  // namespace protocols
