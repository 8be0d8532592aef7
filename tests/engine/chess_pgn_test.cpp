#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/chess/pgn.h"
#include "engine/chess/san.h"

namespace chess::pgn {
namespace {

std::string uci(const Record& record) {
    Chess game = record.start;
    std::string text;
    for (const Move move : record.main_line()) {
        if (!text.empty()) text += ' ';
        text += game.move_to_text(move);
        game.play(move);
    }
    return text;
}

std::string refusal(Reader& reader) {
    try {
        return reader.next() ? "read" : "no game";
    } catch (const engine::Error& error) {
        return error.what();
    }
}

std::string refusal(std::string_view text) {
    std::istringstream in{std::string(text)};
    Reader reader(in);
    return refusal(reader);
}

constexpr auto annotated = R"([Event "A \"quoted\" name"]
[White "Anderssen"]
[Black "Kieseritzky"]
[Result "1-0"]
[Annotator "nobody"]

{Immortal
   game} 1.e4 e5 2.f4 exf4 3. Bc4!? (3.Nf3 g5 (3...d6!) 4.h4 {here too}) ({or} 3. d4) 3... Qh4+ $2 ; to the end
4. Kf1 b5 $14 {gambit} 1-0
)";

TEST(ChessPgn, ReadsTagsMovesVariationsCommentsAndNags) {
    const auto record = read_one(annotated);
    EXPECT_EQ(record.tag("Event"), "A \"quoted\" name");
    EXPECT_EQ(record.tag("Annotator"), "nobody");
    EXPECT_EQ(record.tag("Site"), "");
    EXPECT_EQ(record.result, "1-0");
    EXPECT_EQ(uci(record), "e2e4 e7e5 f2f4 e5f4 f1c4 d8h4 e1f1 b7b5");
    EXPECT_EQ(record.nodes[0].comment, "Immortal game");
    const auto& fourth = record.nodes[4];
    ASSERT_EQ(fourth.children.size(), 3u);
    const auto& bishop = record.nodes[fourth.children[0]];
    EXPECT_EQ(bishop.nags, std::vector<std::uint8_t>{5});
    const auto& knight = record.nodes[fourth.children[1]];
    ASSERT_EQ(knight.children.size(), 2u);
    EXPECT_EQ(record.nodes[knight.children[1]].nags, std::vector<std::uint8_t>{1});
    EXPECT_EQ(record.nodes[record.nodes[knight.children[0]].children[0]].comment, "here too");
    EXPECT_EQ(record.nodes[fourth.children[2]].comment_before, "or");
    const auto& queen = record.nodes[bishop.children[0]];
    EXPECT_EQ(queen.nags, std::vector<std::uint8_t>{2});
    EXPECT_EQ(queen.comment, "to the end");
}

TEST(ChessPgn, WritesWhatItRead) {
    const auto record = read_one(annotated);
    const auto text = to_text(record);
    EXPECT_EQ(text, R"([Event "A \"quoted\" name"]
[Site "?"]
[Date "????.??.??"]
[Round "?"]
[White "Anderssen"]
[Black "Kieseritzky"]
[Result "1-0"]
[Annotator "nobody"]

{Immortal game} 1. e4 e5 2. f4 exf4 3. Bc4 $5 (3. Nf3 g5 (3... d6 $1) 4. h4
{here too}) ({or} 3. d4) 3... Qh4+ $2 {to the end} 4. Kf1 b5 $14 {gambit} 1-0

)");
    EXPECT_EQ(read_one(text).nodes, record.nodes);
}

TEST(ChessPgn, SetUpPositionsAndChess960) {
    const auto record = read_one(R"([Variant "Fischerandom"]
[SetUp "1"]
[FEN "1r3k1r/8/8/8/8/8/8/1R3K1R w HBhb - 0 1"]

1. O-O-O+ Kg7 *)");
    EXPECT_EQ(uci(record), "f1b1 f8g7");
    EXPECT_TRUE(record.start.chess960());
    EXPECT_EQ(record.tag("FEN"), "");
    const auto again = read_one(to_text(record));
    EXPECT_EQ(again.start, record.start);
    EXPECT_EQ(again.nodes, record.nodes);
    const auto black = read_one("[FEN \"4k3/8/8/8/8/8/8/4K2R b K - 3 40\"]\n\n40... Kd7 41. O-O *");
    EXPECT_THAT(to_text(black), testing::HasSubstr("\n40... Kd7 41. O-O *\n"));
    EXPECT_THAT(refusal("[Variant \"Atomic\"]\n\n1. e4 *"), testing::HasSubstr("\"Atomic\""));
    EXPECT_THAT(refusal("[FEN \"8/8/8/8/8/8/8/8 w - - 0 1\"]\n\n*"), testing::HasSubstr("0 kings"));
}

TEST(ChessPgn, ReadsWhatProgramsWrite) {
    EXPECT_EQ(uci(read_one("1.e4 1...e5 2.Nf3+ Nc6!! 3 Bb5 a6 +- 4. 0-0 = 1/2-1/2")),
              "e2e4 e7e5 g1f3 b8c6 f1b5 a7a6 e1g1");
    EXPECT_EQ(uci(read_one("\xef\xbb\xbf"
                           "1. e2e4 e7-e5 2. g1f3 b8c6 3. f1c4 f8c5 4. e1g1 *")),
              "e2e4 e7e5 g1f3 b8c6 f1c4 f8c5 e1g1");
    EXPECT_EQ(uci(read_one("1. e4 d5 2. e5 f5 3. exf6 e.p. *")), "e2e4 d7d5 e4e5 f7f5 e5f6");
    EXPECT_EQ(uci(read_one("% a line for programs\r\n1. d4\r\n% and another\r\nd5 1-0\r\n")),
              "d2d4 d7d5");
    // Null moves end a variation, whatever it holds.
    const auto null = read_one("1. e4 (1. d4 -- 2. c4 (2. Zz9) d5) 1... c5 *");
    EXPECT_EQ(uci(null), "e2e4 c7c5");
    EXPECT_EQ(null.nodes.size(), 4u);
    // A file that was cut behind a move is still a game.
    EXPECT_EQ(uci(read_one("[Result \"0-1\"]\n\n1. f3 e5")), "f2f3 e7e5");
    EXPECT_EQ(read_one("[Result \"0-1\"]\n\n1. f3 e5").result, "0-1");
}

TEST(ChessPgn, ErrorsNameThePlaceAndReadingGoesOn) {
    std::istringstream in(
        "[Event \"one\"]\n\n1. e4 *\n\n[Event \"two\"]\n\n1. e4 e5\n2. Ke3 *\n\n[Event "
        "\"three\"]\n\n"
        "1. d4 *\n");
    Reader reader(in);
    EXPECT_EQ(reader.next()->tag("Event"), "one");
    EXPECT_THAT(refusal(reader), testing::HasSubstr("game 2, line 8, column 4: \"Ke3\""));
    EXPECT_EQ(reader.next()->tag("Event"), "three");
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.games(), 3);
}

TEST(ChessPgn, RefusesDamage) {
    using testing::HasSubstr;
    EXPECT_EQ(refusal(""), "no game");
    EXPECT_THROW(read_one(""), engine::Error);
    EXPECT_THAT(refusal("1. e4 {without end"), HasSubstr("a comment without its end"));
    EXPECT_THAT(refusal("1. e4 (1. d4"), HasSubstr("a variation without its end"));
    EXPECT_THAT(refusal("1. e4 ) *"), HasSubstr("\")\" without \"(\""));
    EXPECT_THAT(refusal("(1. e4) *"), HasSubstr("a variation before any move"));
    EXPECT_THAT(refusal("[Event \"x]\n\n*"), HasSubstr("no closing quote"));
    EXPECT_THAT(refusal("[Event]\n\n*"), HasSubstr("a tag is not like"));
    EXPECT_THAT(refusal("\x01\x02"), HasSubstr("unexpected"));
    EXPECT_THAT(refusal("-- *"), HasSubstr("\"--\" is not a legal move"));
}

TEST(ChessPgn, DeepNestingIsRefusedNotCrashedOn) {
    std::string text = "1. Nf3 ";
    for (int depth = 0; depth < 200000; ++depth) text += "(1. Nc3 ";
    EXPECT_THAT(refusal(text), testing::HasSubstr("nested deeper than 1000"));
    std::string fine = "1. Nf3 ";
    for (int depth = 0; depth < 900; ++depth) fine += "(1. Nc3 ";
    for (int depth = 0; depth < 900; ++depth) fine += ")";
    const auto record = read_one(fine + " *");
    EXPECT_EQ(record.nodes.size(), 902u);
    EXPECT_EQ(read_one(to_text(record)).nodes, record.nodes);
}

TEST(ChessPgn, RandomGamesSurvive) {
    engine::Random random(11);
    for (int round = 0; round < 30; ++round) {
        Chess game;
        std::vector<Move> moves;
        while (game.outcome() == Outcome::ongoing && moves.size() < 300) {
            const auto legal = game.legal_moves();
            moves.push_back(legal[random.below(legal.size())]);
            game.play(moves.back());
        }
        const auto record = record_of(Chess(), moves, "1/2-1/2", {{"White", "a"}});
        const auto text = to_text(record);
        EXPECT_EQ(read_one(text).main_line(), moves);
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) EXPECT_LT(line.size(), 80u);
    }
}

// Reads a sample of a collection of real games; all 145 716 take some seconds (`SANBAN_SLOW`).
TEST(ChessPgn, SharedGames) {
    const char* shared = std::getenv("SANBAN_SHARED");
    const std::filesystem::path folder = shared ? shared : SANBAN_SOURCE_DIR "/../shared";
    const auto path = folder / "data/chess/games/book_1.02.pgn.gz";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    const int most = std::getenv("SANBAN_SLOW") ? 1 << 30 : 5000;
    const auto in = open(path);
    Reader reader(*in);
    std::size_t plies = 0;
    while (reader.games() < most)
        if (const auto record = reader.next())
            plies += record->main_line().size();
        else
            break;
    EXPECT_EQ(reader.games(), std::min(most, 145716));
    EXPECT_GT(plies, 70u * static_cast<std::size_t>(reader.games()));
}

}  // namespace
}  // namespace chess::pgn
