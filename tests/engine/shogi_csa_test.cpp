// CSA: what is read, what is written, what is refused, and the real games in ../shared.
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/base/charset.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/random.h"
#include "engine/shogi/csa.h"
#include "tests/engine/shogi_data.h"

namespace shogi::csa {
namespace {

constexpr std::string_view even_game = R"(V2.2
N+Habu
N-Fujii
$EVENT:A test
PI
+
'before the game
+7776FU
T12
-3334FU
T3
+8822UM
'takes
'at once
-3122GI
+0055KA
T0
%TORYO
)";

Record read_one(std::string_view text) {
    auto games = parse(text);
    EXPECT_EQ(games.size(), 1u);
    return games.empty() ? Record() : games[0];
}

std::string moves_of(const Record& record) {
    std::string text;
    for (const Move move : record.main_line()) text += record.start.move_to_text(move) + ' ';
    return text;
}

TEST(ShogiCsa, ReadsAGame) {
    const auto record = read_one(even_game);
    EXPECT_EQ(record.black, "Habu");
    EXPECT_EQ(record.white, "Fujii");
    EXPECT_EQ(record.facts, (std::vector<Fact>{{"EVENT", "A test"}}));
    EXPECT_EQ(record.start, Shogi());
    EXPECT_EQ(moves_of(record), "7g7f 3c3d 8h2b+ 3a2b B*5e ");
    EXPECT_EQ(record.nodes[0].comment, "before the game");
    EXPECT_EQ(record.nodes[1].seconds, 12);
    EXPECT_EQ(record.nodes[3].seconds, std::nullopt);
    EXPECT_EQ(record.nodes[3].comment, "takes\nat once");
    EXPECT_EQ(record.ending(), Ending::resignation);
    EXPECT_EQ(record.outcome(), Outcome::first_wins);
}

TEST(ShogiCsa, WritesWhatItReads) {
    const auto record = read_one(even_game);
    EXPECT_EQ(to_text(record), even_game);
    EXPECT_EQ(read_one(to_text(record)), record);
}

TEST(ShogiCsa, PositionsOfEveryKind) {
    const auto start_of = [](std::string_view text) { return read_one(text).start.to_text(); };
    EXPECT_EQ(start_of("PI82HI22KA\n-\n"),
              "lnsgkgsnl/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1");
    EXPECT_EQ(start_of("P+59OU00FU00FU00KI\nP-51OU52TO\n+\n"), "4k4/4+p4/9/9/9/9/9/9/4K4 b G2P 1");
    EXPECT_EQ(start_of("P-11OU\nP+23GI00KI\nP-00AL\n+\n"),
              "8k/9/7S1/9/9/9/9/9/9 b G2r2b3g3s4n4l18p 1");
    EXPECT_EQ(start_of("P1-KY-KE-GI-KI-OU-KI-GI-KE-KY\nP2 * -HI *  *  *  *  * -KA *\nP9 *  *  *  "
                       "* +OU\nP+\nP-\n-\n"),
              "lnsgkgsnl/1r5b1/9/9/9/9/9/9/4K4 w - 1");
    // No position at all: the usual one.
    EXPECT_EQ(read_one("+\n+2726FU\n").start, Shogi());
}

TEST(ShogiCsa, PositionsSurvive) {
    for (const char* sfen :
         {"8l/1l+R2P3/p2pBG1pp/kps1p4/Nn1P2G2/P1P1P2PP/1PS6/1KSG3+r1/LN2+p3L w Sbgn3p 1",
          "8k/9/7S1/9/9/9/9/9/9 b 2G 1", "startpos"}) {
        const auto start = Shogi::from_text(sfen);
        EXPECT_EQ(read_one(to_text(record_of(start, {}, Ending::none))).start, start);
    }
}

TEST(ShogiCsa, SeveralStatementsALineAndSeveralGames) {
    const auto games =
        parse("PI\n+\n+7776FU,T5,-3334FU,T7\n%CHUDAN\n/\nPI\n+\n+2726FU\n%TORYO,T3\n");
    ASSERT_EQ(games.size(), 2u);
    EXPECT_EQ(moves_of(games[0]), "7g7f 3c3d ");
    EXPECT_EQ(games[0].nodes[2].seconds, 7);
    EXPECT_EQ(games[0].outcome(), Outcome::ongoing);
    EXPECT_EQ(games[1].outcome(), Outcome::first_wins);
}

struct Ended {
    const char* words;
    Ending ending;
    Outcome outcome;
};

TEST(ShogiCsa, Endings) {
    // White is to move.
    for (const auto& [words, ending, outcome] :
         {Ended{"%TORYO", Ending::resignation, Outcome::first_wins},
          Ended{"%TSUMI", Ending::mate, Outcome::first_wins},
          Ended{"%SENNICHITE", Ending::repetition, Outcome::draw},
          Ended{"%JISHOGI", Ending::impasse, Outcome::draw},
          Ended{"%HIKIWAKE", Ending::draw, Outcome::draw},
          Ended{"%MAX_MOVES", Ending::move_limit, Outcome::draw},
          Ended{"%KACHI", Ending::declaration, Outcome::second_wins},
          Ended{"%TIME_UP", Ending::time_up, Outcome::first_wins},
          Ended{"%ILLEGAL_MOVE", Ending::foul, Outcome::first_wins},
          Ended{"%+ILLEGAL_ACTION", Ending::foul_of_opponent, Outcome::second_wins},
          Ended{"%-ILLEGAL_ACTION", Ending::foul, Outcome::first_wins},
          Ended{"%CHUDAN", Ending::interrupted, Outcome::ongoing},
          Ended{"%MATTA", Ending::taken_back, Outcome::ongoing},
          Ended{"%FUZUMI", Ending::no_mate, Outcome::ongoing},
          Ended{"%ERROR", Ending::error, Outcome::ongoing}}) {
        const auto record = read_one("PI\n+\n+7776FU\n" + std::string(words) + "\n");
        EXPECT_EQ(record.ending(), ending) << words;
        EXPECT_EQ(record.outcome(), outcome) << words;
        EXPECT_EQ(read_one(to_text(record)), record) << words;
    }
}

TEST(ShogiCsa, OtherCharsets) {
    const std::string utf8 = "V2.2\nN+鈴木大介\nN-竜王\nPI\n+\n'表示\n+7776FU\n";
    for (const char* charset : {"EUC-JP", "Shift_JIS"}) {
        const auto record = read_one(engine::from_utf8(utf8, charset));
        EXPECT_EQ(record, read_one(utf8)) << charset;
        EXPECT_EQ(record.black, "鈴木大介");
    }
    EXPECT_EQ(read_one("\xEF\xBB\xBF" + utf8), read_one(utf8));
}

TEST(ShogiCsa, RefusesWithPlaceAndReason) {
    const auto reason = [](std::string_view text) -> std::string {
        try {
            parse(text);
        } catch (const engine::Error& error) {
            return error.what();
        }
        return "taken";
    };
    EXPECT_EQ(reason("PI\n+\n+7776FU\n+2726FU\n"), "CSA: game 1, line 4: move 2 (+2726FU) is none");
    EXPECT_EQ(reason("PI\n+\n+7776FU\n/\nPI\n+\n+7775FU\n"),
              "CSA: game 2, line 7: move 1 (+7775FU) is illegal");
    EXPECT_EQ(reason("PI\n+\n+77"), "CSA: game 1, line 3: move 1 (+77) is none");
    EXPECT_EQ(reason("PI\n+\n+7776KI\n"), "CSA: game 1, line 3: move 1 (+7776KI) is none");
    EXPECT_EQ(reason("P+11OU11OU\n"), "CSA: game 1, line 1: two pieces on 1a");
    EXPECT_EQ(reason("P+55OU54FU53FU\n+\n"), "CSA: game 1, line 2: Black has two pawns on file 5");
    EXPECT_EQ(reason("PI\n+\n%GIVEUP\n"), "CSA: game 1, line 3: no ending: %GIVEUP");
    EXPECT_EQ(reason("hello\n"), "CSA: game 1, line 1: not understood: hello");
}

// A record with bytes changed or cut off is read or refused.
TEST(ShogiCsa, Noise) {
    engine::Random random(5);
    int taken = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string text(even_game.substr(
            0, static_cast<std::size_t>(random.below(static_cast<int>(even_game.size())))));
        for (int changes = random.below(3); changes > 0 && !text.empty(); --changes)
            text[static_cast<std::size_t>(random.below(static_cast<int>(text.size())))] =
                static_cast<char>(random.below(256));
        try {
            for (const auto& record : parse(text))
                EXPECT_EQ(read_one(to_text(record)).start, record.start);
            ++taken;
        } catch (const engine::Error&) {
        }
    }
    EXPECT_GT(taken, 300);
    EXPECT_LT(taken, 2900);
}

TEST(ShogiCsa, SharedRecords) {
    if (!std::filesystem::exists(shared_data() / "shogi"))
        GTEST_SKIP() << "no ../shared/data/shogi";
    int games = 0, files = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(shared_data() / "shogi")) {
        if (entry.path().extension() != ".csa") continue;
        ++files;
        for (const auto& record : parse(engine::read_file(entry.path()))) {
            ++games;
            const auto again = read_one(to_text(record));
            EXPECT_EQ(again.nodes, record.nodes) << entry.path();
            EXPECT_EQ(again.start, record.start) << entry.path();
        }
    }
    EXPECT_EQ(files, 502);
    EXPECT_EQ(games, 502);
}

}  // namespace
}  // namespace shogi::csa
