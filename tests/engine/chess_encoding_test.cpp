#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/chess/encoding.h"

namespace chess {
namespace {

static_assert(engine::Encoded<Chess>);

std::vector<float> encoded(const Chess& game, std::string_view name = "alphazero") {
    const auto& encoding = engine::find_encoding<Chess>(name);
    std::vector<float> planes(encoding.shape(game).planes_size(), -1);
    encoding.write(game, planes, {});
    return planes;
}

// One plane, top rank first, as seen by the mover: "......../…".
std::string plane(const std::vector<float>& planes, int number) {
    std::string text;
    for (int row = 7; row >= 0; --row) {
        for (int file = 0; file < 8; ++file) {
            const float value = planes[static_cast<std::size_t>(number * 64 + row * 8 + file)];
            text += value == 0 ? '.' : value == 1 ? '1' : '?';
        }
        if (row > 0) text += '/';
    }
    return text;
}

int policy_index(const Chess& game, std::string_view move) {
    return alphazero::policy_index(game, *game.move_from_text(move));
}

TEST(ChessEncoding, HasTheShapeOfThePaper) {
    const auto shape = engine::find_encoding<Chess>("alphazero").shape(Chess());
    EXPECT_EQ(shape.planes, 119);
    EXPECT_EQ(shape.policy_size, 8 * 8 * 73);
    EXPECT_EQ(shape.height * shape.width, 64);
    EXPECT_THROW(engine::find_encoding<Chess>("alphago48"), engine::Error);
}

TEST(ChessEncoding, BlackSeesTheBoardFromItsOwnSide) {
    Chess game;
    game.play(*game.move_from_text("e2e4"));
    const auto planes = encoded(game);
    EXPECT_EQ(plane(planes, 0),
              "......../......../......../......../......../......../11111111/........");
    EXPECT_EQ(plane(planes, 6),
              "......../1111.111/......../....1.../......../......../......../........");
    EXPECT_EQ(plane(planes, 4),
              "......../......../......../......../......../......../......../...1....");
    // The start, one board back.
    EXPECT_EQ(plane(planes, 14 + 6),
              "......../11111111/......../......../......../......../......../........");
    // Nothing before the start.
    for (int number = 28; number < 112; ++number)
        EXPECT_EQ(plane(planes, number).find_first_not_of("./"), std::string::npos) << number;
    for (const int full : {112, 114, 115, 116, 117})
        EXPECT_EQ(planes[static_cast<std::size_t>(full) * 64 + 63], 1);
    EXPECT_FLOAT_EQ(planes[113 * 64], 0.01f);
    EXPECT_EQ(planes[118 * 64], 0);
}

TEST(ChessEncoding, TellsRepetitionsRightsAndTheClock) {
    auto game = Chess::from_text("4k2r/8/8/8/8/8/8/R3K3 w Qk - 10 40");
    for (const auto* move : {"e1d1", "e8d8", "d1e1", "d8e8", "e1d1", "d8d7"})
        if (const auto found = game.move_from_text(move)) game.play(*found);
    const auto planes = encoded(game);  // Black to move: e1d1 brought back an earlier board
    const auto value = [&](int number) {
        return planes[static_cast<std::size_t>(number) * 64 + 9];
    };
    EXPECT_EQ(value(112), 1);
    EXPECT_FLOAT_EQ(value(113), 0.42f);
    for (const int right : {114, 115, 116, 117}) EXPECT_EQ(value(right), 0) << right;
    EXPECT_FLOAT_EQ(value(118), 0.15f);
    EXPECT_EQ(value(12), 0) << "rights were lost since, so the position is new";

    auto dance = Chess();
    for (const auto* move : {"g1f3", "g8f6", "f3g1", "f6g8", "g1f3", "g8f6", "f3g1", "f6g8"})
        dance.play(*dance.move_from_text(move));
    const auto danced = encoded(dance);
    EXPECT_EQ(danced[12 * 64], 1);
    EXPECT_EQ(danced[13 * 64], 1);
    EXPECT_EQ(danced[(14 + 12) * 64], 1);
    EXPECT_EQ(danced[(14 + 13) * 64], 0);
    EXPECT_EQ(danced[(4 * 14 + 12) * 64], 1);
    EXPECT_EQ(danced[(4 * 14 + 13) * 64], 0);
    EXPECT_EQ(danced[(5 * 14 + 12) * 64], 0);
}

TEST(ChessEncoding, NamesMovesAsThePaperDoes) {
    EXPECT_EQ(policy_index(Chess(), "e2e4"), 1 * 64 + 12);        // north, two squares
    EXPECT_EQ(policy_index(Chess(), "g1f3"), (56 + 7) * 64 + 6);  // north-north-west
    const auto promoting = Chess::from_text("1n1n3k/2P5/8/8/8/8/8/7K w - - 0 1");
    EXPECT_EQ(policy_index(promoting, "c7c8q"), 0 * 64 + 50);
    EXPECT_EQ(policy_index(promoting, "c7b8q"), 7 * 7 * 64 + 50);
    EXPECT_EQ(policy_index(promoting, "c7b8n"), 64 * 64 + 50);
    EXPECT_EQ(policy_index(promoting, "c7c8n"), 65 * 64 + 50);
    EXPECT_EQ(policy_index(promoting, "c7d8r"), 72 * 64 + 50);
    const auto castling = Chess::from_text("r3k2r/8/8/8/8/8/8/R3K2R b KQkq - 0 1");
    EXPECT_EQ(policy_index(castling, "e8g8"), (2 * 7 + 2) * 64 + 4);
    EXPECT_EQ(policy_index(castling, "e8c8"), (6 * 7 + 3) * 64 + 4);
    EXPECT_EQ(policy_index(castling, "e8f8"), 2 * 7 * 64 + 4);
}

// The same game with colours swapped and the board turned.
std::string mirrored(const std::string& fen) {
    const auto blank = fen.find(' ');
    std::string board = fen.substr(0, blank), ranks;
    for (auto at = board.rfind('/'); at != board.npos; at = board.rfind('/')) {
        ranks += board.substr(at + 1) + '/';
        board.resize(at);
    }
    std::string text = ranks + board + fen.substr(blank);
    for (auto& letter : text)
        letter =
            static_cast<char>(std::islower(letter) ? std::toupper(letter) : std::tolower(letter));
    auto& side = text[blank + 1];
    side = side == 'W' ? 'b' : 'w';
    const auto passed = text.find_first_of("36", text.find(' ', blank + 3));
    if (text.find(" - ", blank + 3) == text.npos && passed != text.npos) {
        text[passed] = text[passed] == '3' ? '6' : '3';
        text[passed - 1] = static_cast<char>(std::tolower(text[passed - 1]));
    }
    return text;
}

std::string turned(std::string move) {
    for (const std::size_t at : {1, 3}) move[at] = static_cast<char>('1' + '8' - move[at]);
    return move;
}

std::vector<std::string> starts() {
    return {"rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR w KQkq - 0 1",
            "brkrqnnb/pppppppp/8/8/8/8/PPPPPPPP/BRKRQNNB w DBdb - 0 1",
            "bqnbrkrn/8/8/8/8/8/8/BQNBRKRN w GEge - 0 1",
            "n1n3k1/PPPP4/8/8/8/8/4pppp/1K4N1 w - - 0 1", "1rk1r3/8/8/8/8/8/8/1RK1R3 w EBeb - 0 1"};
}

TEST(ChessEncoding, EveryLegalMoveHasAnIndexOfItsOwn) {
    engine::Random random(3);
    for (int round = 0; round < 100; ++round) {
        auto game = Chess::from_text(starts()[static_cast<std::size_t>(round) % starts().size()]);
        for (int ply = 0; ply < 150 && game.outcome() == Outcome::ongoing; ++ply) {
            const auto moves = game.legal_moves();
            std::set<int> indices;
            for (const Move move : moves) {
                const int index = alphazero::policy_index(game, move);
                ASSERT_TRUE(index >= 0 && index < alphazero::policy_size);
                ASSERT_TRUE(indices.insert(index).second)
                    << game.move_to_text(move) << " " << game.to_text();
            }
            game.play(moves[random.below(moves.size())]);
        }
    }
}

TEST(ChessEncoding, CommutesWithSwappingTheColours) {
    engine::Random random(4);
    for (int round = 0; round < 20; ++round) {
        const auto start = starts()[static_cast<std::size_t>(round) % starts().size()];
        auto game = Chess::from_text(start), twin = Chess::from_text(mirrored(start));
        for (auto* one : {&game, &twin}) one->set_chess960(true);
        for (int ply = 0; ply < 120 && game.outcome() == Outcome::ongoing; ++ply) {
            auto planes = encoded(game), twins = encoded(twin);
            // Only the planes of colour and, as Black's twin began, of the move number may differ.
            for (auto* each : {&planes, &twins}) std::fill_n(each->begin() + 112 * 64, 128, 0.0f);
            ASSERT_EQ(planes, twins) << game.to_text() << " and " << twin.to_text();
            ASSERT_EQ(encoded(game, "attacks"), encoded(twin, "attacks")) << game.to_text();
            const auto moves = game.legal_moves();
            for (const Move move : moves) {
                const auto other = twin.move_from_text(turned(game.move_to_text(move)));
                ASSERT_TRUE(other) << game.move_to_text(move) << " " << twin.to_text();
                ASSERT_EQ(alphazero::policy_index(game, move),
                          alphazero::policy_index(twin, *other));
            }
            const Move move = moves[random.below(moves.size())];
            twin.play(*twin.move_from_text(turned(game.move_to_text(move))));
            game.play(move);
        }
        EXPECT_EQ(game.outcome() == Outcome::draw, twin.outcome() == Outcome::draw);
    }
}

TEST(ChessAttacks, ShowWhoAttacksWhat) {
    const auto planes =
        encoded(Chess::from_text("r3k3/8/8/8/3n4/8/4P3/R3K2R w KQq - 30 40"), "attacks");
    ASSERT_EQ(planes.size(), 34u * 64);
    const std::string none =
        "......../......../......../......../......../......../......../........";
    const std::string all =
        "11111111/11111111/11111111/11111111/11111111/11111111/11111111/11111111";
    EXPECT_EQ(plane(planes, 3),
              "......../......../......../......../......../......../......../1......1");
    EXPECT_EQ(plane(planes, 6 + 1),
              "......../......../......../......../...1..../......../......../........");
    // What the mover's pawn, rooks and king attack; own men that stand there are guarded.
    EXPECT_EQ(plane(planes, 12),
              "......../......../......../......../......../...1.1../......../........");
    EXPECT_EQ(plane(planes, 12 + 3),
              "1......1/1......1/1......1/1......1/1......1/1......1/1......1/.111111.");
    EXPECT_EQ(plane(planes, 12 + 5),
              "......../......../......../......../......../......../...111../...1.1..");
    // What the opponent's knight and rook attack.
    EXPECT_EQ(plane(planes, 18 + 1),
              "......../......../..1.1.../.1...1../......../.1...1../..1.1.../........");
    EXPECT_EQ(plane(planes, 18 + 3),
              ".1111.../1......./1......./1......./1......./1......./1......./1.......");
    EXPECT_EQ(plane(planes, 24),
              "......../......../......../......../......../......../......../...111..");
    EXPECT_EQ(plane(planes, 25),
              "...1..../......../......../......../......../......../......../........");
    EXPECT_EQ(plane(planes, 26), none);  // no capture en passant
    EXPECT_EQ(plane(planes, 27), all);
    EXPECT_EQ(plane(planes, 28), all);
    EXPECT_EQ(plane(planes, 29), none);
    EXPECT_EQ(plane(planes, 30), all);
    EXPECT_EQ(planes[31 * 64], 0.3f);
    EXPECT_EQ(plane(planes, 32), none);
    EXPECT_EQ(plane(planes, 33), all);
}

TEST(ChessAttacks, ShowRepetitionAndEnPassant) {
    Chess game;
    for (const char* move : {"g1f3", "g8f6", "f3g1", "f6g8"}) game.play(*game.move_from_text(move));
    EXPECT_EQ(encoded(game, "attacks")[32 * 64], 1);
    for (const char* move : {"e2e4", "a7a6", "e4e5", "d7d5"}) game.play(*game.move_from_text(move));
    EXPECT_EQ(plane(encoded(game, "attacks"), 26),
              "......../......../...1..../......../......../......../......../........");
}

}  // namespace
}  // namespace chess
