// AlphaZero's planes and moves of shogi: one index a move, and both players see alike.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/shogi/encoding.h"

namespace shogi {
using alphazero::policy_index, alphazero::policy_size;
namespace {

constexpr std::size_t plane_size = square_count;

std::vector<float> planes_of(const Shogi& game) {
    std::vector<float> planes(alphazero::planes * plane_size, -1.0f);
    Shogi::encodings()[0].write(game, planes, {});
    return planes;
}

std::vector<float> attacks_of(const Shogi& game) {
    const auto& encoding = engine::find_encoding<Shogi>("attacks");
    std::vector<float> planes(encoding.shape(game).planes_size(), -1.0f);
    encoding.write(game, planes, {});
    return planes;
}

// One plane, far side first, as seen by the mover.
std::string plane(const std::vector<float>& planes, std::size_t number) {
    std::string text;
    for (std::size_t cell = 0; cell < plane_size; ++cell) {
        if (cell > 0 && cell % board_size == 0) text += '/';
        const float value = planes[number * plane_size + cell];
        text += value == 0 ? '.' : value == 1 ? '1' : '?';
    }
    return text;
}

Move turned_move(Move move) {
    const int to = turned(to_square(move));
    if (is_drop(move)) return drop_move(dropped_kind(move), to);
    return board_move(turned(from_square(move)), to, is_promotion(move));
}

// The same position with the players changed and the board turned.
Position exchanged(const Position& position) {
    Position other;
    for (int square = 0; square < square_count; ++square) {
        const Piece piece = position.at(square);
        if (!piece.empty()) other.put(turned(square), {~piece.player(), piece.kind()});
    }
    for (const Player player : {Player::first, Player::second})
        for (const Kind kind : hand_kinds)
            other.set_hand(~player, kind, position.hand(player, kind));
    other.set_to_play(~position.to_play());
    return other;
}

// Any plane of the last but two is the same; the colour differs.
void expect_mirrored(const Shogi& game, const Shogi& mirror) {
    auto seen = planes_of(game), by_other = planes_of(mirror);
    const auto colour = static_cast<std::ptrdiff_t>((alphazero::planes - 2) * plane_size);
    EXPECT_NE(seen[(alphazero::planes - 2) * plane_size],
              by_other[(alphazero::planes - 2) * plane_size]);
    const auto end = colour + static_cast<std::ptrdiff_t>(plane_size);
    seen.erase(seen.begin() + colour, seen.begin() + end);
    by_other.erase(by_other.begin() + colour, by_other.begin() + end);
    EXPECT_EQ(seen, by_other);
    EXPECT_EQ(attacks_of(game), attacks_of(mirror));
}

void expect_one_index_a_move(const Shogi& game, const Shogi& mirror) {
    std::set<int> indices;
    for (const Move move : game.legal_moves()) {
        const int index = policy_index(game, move);
        ASSERT_GE(index, 0);
        ASSERT_LT(index, policy_size);
        ASSERT_TRUE(indices.insert(index).second) << game.to_text() << game.move_to_text(move);
        ASSERT_EQ(policy_index(mirror, turned_move(move)), index);
    }
}

TEST(ShogiEncoding, InjectiveAndTheSameForBothPlayers) {
    engine::Random random(3);
    for (int i = 0; i < 60; ++i) {
        Shogi game, mirror(exchanged(Position::start()));
        for (int ply = 0; ply < 300 && game.outcome() == Outcome::ongoing; ++ply) {
            expect_one_index_a_move(game, mirror);
            if (ply % 8 == 0) expect_mirrored(game, mirror);
            const auto moves = game.legal_moves();
            const Move move = moves[random.below(moves.size())];
            game.play(move);
            mirror.play(turned_move(move));
            ASSERT_EQ(exchanged(game.position()), mirror.position());
        }
    }
}

float value_at(const std::vector<float>& planes, int plane, int row, int column) {
    return planes[static_cast<std::size_t>(plane) * plane_size +
                  static_cast<std::size_t>(row * 9 + column)];
}

TEST(ShogiEncoding, Start) {
    const auto planes = planes_of(Shogi());
    EXPECT_EQ(value_at(planes, 0, 6, 4), 1);    // own pawns on the third row from below
    EXPECT_EQ(value_at(planes, 14, 2, 0), 1);   // the opponent's
    EXPECT_EQ(value_at(planes, 5, 7, 1), 1);    // own bishop on 8h, to the left
    EXPECT_EQ(value_at(planes, 6, 7, 7), 1);    // own rook on 2h
    EXPECT_EQ(value_at(planes, 360, 0, 0), 0);  // Black moves
    EXPECT_EQ(value_at(planes, 361, 0, 0), 0);  // nothing played
    EXPECT_EQ(value_at(planes, 45, 6, 4), 0);   // nothing before the first move
    float sum = 0;
    for (const float value : planes) sum += value;
    EXPECT_EQ(sum, 40);
}

TEST(ShogiEncoding, HandsHistoryAndRepetition) {
    Shogi game;
    const auto play = [&game](const char* text) {
        const auto move = game.move_from_text(text);
        ASSERT_TRUE(move) << text;
        game.play(*move);
    };
    for (const char* text : {"7g7f", "3c3d", "8h2b+", "3a2b"}) play(text);
    auto planes = planes_of(game);
    EXPECT_FLOAT_EQ(value_at(planes, 31 + 5, 0, 0), 0.5f);       // a bishop in own hand
    EXPECT_FLOAT_EQ(value_at(planes, 38 + 5, 0, 0), 0.5f);       // and in the other
    EXPECT_EQ(value_at(planes, 45 + 12, 1, 7), 1);               // a move ago a horse on 2b
    EXPECT_FLOAT_EQ(value_at(planes, 45 + 38 + 5, 0, 0), 0.0f);  // and none in White's hand
    EXPECT_EQ(value_at(planes, 28, 0, 0), 0);
    for (const char* text : {"2h3h", "8b7b", "3h2h", "7b8b"}) play(text);
    planes = planes_of(game);
    EXPECT_EQ(value_at(planes, 28, 4, 4), 1);  // here for the second time
    EXPECT_EQ(value_at(planes, 29, 4, 4), 0);
    EXPECT_EQ(value_at(planes, 45 + 28, 4, 4), 0);
}

TEST(ShogiEncoding, MovesHaveTheirPlaces) {
    const Shogi game;
    // One step ahead from row 6, column 2 of the 9 x 9.
    EXPECT_EQ(policy_index(game, *game.move_from_text("7g7f")), 6 * 9 + 2);
    // Rook from 2h six to the left: direction 6 (clockwise from ahead).
    const auto open = Shogi::from_text("4k4/9/9/9/9/9/9/7R1/4K4 b P 1");
    EXPECT_EQ(policy_index(open, *open.move_from_text("2h8h")), (6 * 8 + 5) * 81 + 7 * 9 + 7);
    EXPECT_EQ(policy_index(open, *open.move_from_text("2h2c+")), (66 + 4) * 81 + 7 * 9 + 7);
    EXPECT_EQ(policy_index(open, *open.move_from_text("P*5e")), 132 * 81 + 4 * 9 + 4);
}

TEST(ShogiAttacks, CountThemAndShowTheHands) {
    // A rook on the second file from the right, a lance behind a pawn, two golds beside the king.
    const auto planes = attacks_of(Shogi::from_text("4k4/9/9/9/9/9/P8/L2GKG1R1/9 b 2Pb 1"));
    ASSERT_EQ(planes.size(), 50 * plane_size);
    EXPECT_EQ(plane(planes, 0),
              "........./........./........./........./........./........./1......../........./"
              ".........");
    // Once or more; twice or more; three times.
    EXPECT_EQ(plane(planes, 28),
              ".......1./.......1./.......1./.......1./.......1./1......1./1.111111./"
              "..11111.1/...111.1.");
    EXPECT_EQ(plane(planes, 29),
              "........./........./........./........./........./........./...111.../"
              "....111../...1.1...");
    // The opponent's king.
    EXPECT_EQ(plane(planes, 31),
              "...1.1.../...111.../........./........./........./........./........./........./"
              ".........");
    EXPECT_FLOAT_EQ(planes[34 * plane_size], 2.0f / 18);
    EXPECT_EQ(planes[(41 + 5) * plane_size], 0.5f);
    EXPECT_EQ(planes[48 * plane_size], 0);
    EXPECT_EQ(planes[49 * plane_size], 1);
}

}  // namespace
}  // namespace shogi
