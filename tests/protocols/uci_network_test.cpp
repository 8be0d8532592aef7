// UCI with a network behind it: Maia's answers in lc0's form, against lc0's own.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "engine/games.h"
#include "protocols/uci.h"
#include "tests/search/oracle.h"

namespace protocols {

namespace {

struct Guest {
    // What the lines are answered with.
    std::string say(const std::string& lines) {
        text.str("");
        std::istringstream in(lines);
        uci.serve(in);
        return text.str();
    }

    static search::SearchParams small() {
        search::SearchParams params;
        params.memory_mib = 16;
        return params;
    }

    std::ostringstream text;
    Output output{text};
    Uci uci{uci_dialect, std::make_unique<GameSession<chess::Chess>>(small()), "sanban", output};
};

// "info string e2e4  (322 ) N: 0 (+ 0) (P: 56.39%) ... (WL: 0.03) ...": what stands behind a label.
double number_after(const std::string& line, const std::string& label) {
    const auto at = line.find(label);
    return at == line.npos ? NAN : std::stod(line.substr(at + label.size()));
}

struct Stats {
    std::map<std::string, double> priors;  // in percent
    double value = NAN;
    std::string best;
};

Stats stats_of(const std::string& text) {
    Stats stats;
    std::istringstream in(text);
    for (std::string line, word; std::getline(in, line);) {
        std::istringstream words(line);
        std::string first, second, third;
        words >> first >> second >> third;
        if (first == "bestmove") stats.best = second;
        if (first != "info" || second != "string") continue;
        if (third == "node")
            stats.value = number_after(line, "(V: ");
        else
            stats.priors[third] = number_after(line, "(P: ");
    }
    return stats;
}

TEST(UciNetwork, MaiaSaysWhatItSaysInLc0) {
    const auto path = oracle::network("maia-1900.pb.gz");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
    Guest guest;
    EXPECT_EQ(guest.say("setoption name Precision value fp32\nsetoption name WeightsFile value " +
                        path.string() + "\nsetoption name VerboseMoveStats value true\nisready\n"),
              "readyok\n");
    int number = 0;
    for (const auto& line : oracle::lines_of("lc0-maia-1900.jsonl")) {
        SCOPED_TRACE(testing::Message() << "line " << ++number);
        std::string position = line.contains("fen")
                                   ? "position fen " + line["fen"].get<std::string>()
                                   : "position startpos";
        position += " moves";
        for (const auto& move : line["moves"]) position += " " + move.get<std::string>();
        const auto stats = stats_of(guest.say("ucinewgame\n" + position + "\ngo nodes 1\n"));
        EXPECT_NEAR(stats.value, line["value"].get<double>(), 6e-4);
        EXPECT_EQ(stats.priors.size(), line["policy"].size());
        std::string likeliest;
        double most = -1;
        for (const auto& [move, percent] : line["policy"].items()) {
            ASSERT_TRUE(stats.priors.contains(move)) << move;
            EXPECT_NEAR(stats.priors.at(move), percent.get<double>(), 0.06) << move;
            if (percent.get<double>() > most) likeliest = move;
            most = std::max(most, percent.get<double>());
        }
        EXPECT_EQ(stats.best, likeliest);
    }
    EXPECT_GT(number, 0);
}

TEST(UciNetwork, VerboseStatsTellDraws) {
    const auto path = oracle::network("maia-1900.pb.gz");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
    Guest guest;
    guest.say("setoption name Precision value fp32\nsetoption name WeightsFile value " +
              path.string() + "\nsetoption name VerboseMoveStats value true\nisready\n");
    const auto text = guest.say("position startpos\ngo nodes 1\n");
    EXPECT_NE(text.find("(WL:  0.03373) (D: 0.055) (M:  0.0) "), text.npos) << text;
    // No move has a visit of its own yet, so the move is told by the root's value.
    EXPECT_NE(text.find(" nodes 1 score cp 5 "), text.npos) << text;
}

TEST(UciNetwork, ThePrecisionIsAnOptionOfItsOwn) {
    Guest guest;
    const auto text = guest.say("uci\nsetoption name Precision value half\n");
    EXPECT_NE(text.find("option name Precision type combo default auto var auto var fp32 var bf16 "
                        "var int8 var int16\n"),
              text.npos);
    EXPECT_NE(text.find("Precision must be one of auto, fp32, bf16, int8, int16, not half"),
              text.npos);
}

}  // namespace

}  // namespace protocols
