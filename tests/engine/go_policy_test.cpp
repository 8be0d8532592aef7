// The rollout policy: the tactical board against the ordinary one, the patterns, and what the
// policy plays and how it weighs moves.
#include <gtest/gtest.h>

#include <map>

#include "engine/go/patterns.h"
#include "engine/go/rollout_policy.h"
#include "engine/go/rollouts.h"
#include "tests/engine/go_position.h"

using namespace go;

namespace {

// What a tactical board says of chains and surroundings is what the ordinary one has.
template <int most_size>
void expect_same(const RolloutBoard<most_size, true>& board, const Go& game) {
    const auto& truth = game.board();
    for (int y = 0; y < game.size(); ++y)
        for (int x = 0; x < game.size(); ++x) {
            const int here = board.index({x, y}), there = truth.index(x, y);
            ASSERT_EQ(board.at(here), truth.at(there));
            int seen = 0, shift = 0;
            for (const int dy : {-1, 0, 1})
                for (const int dx : {-1, 0, 1}) {
                    if (dx == 0 && dy == 0) continue;
                    const int other_x = x + dx, other_y = y + dy;
                    const bool inside = other_x >= 0 && other_y >= 0 && other_x < game.size() &&
                                        other_y < game.size();
                    const auto colour =
                        inside ? truth.at(truth.index(other_x, other_y)) : Colour::edge;
                    seen |= static_cast<int>(colour) << shift;
                    shift += 2;
                }
            ASSERT_EQ(board.surroundings(here), seen) << diagram(game);
            if (board.at(here) == Colour::empty) continue;
            ASSERT_EQ(board.in_atari(here), truth.liberties(there) == 1) << diagram(game);
            if (!board.in_atari(here)) continue;
            const auto liberty = board.point_of(board.last_liberty(here));
            ASSERT_FALSE(game.at(liberty));
        }
}

template <int most_size>
void follow_policy(Go game, engine::Random& random) {
    RolloutPolicy<most_size> policy(game);
    for (int i = 0; i < 3 * game.size() * game.size() && game.consecutive_passes() < 2; ++i) {
        expect_same<most_size>(policy.board(), game);
        const int played = game.to_play() == Player::first
                               ? policy.template play<Colour::black>(random)
                               : policy.template play<Colour::white>(random);
        const auto move = played == 0 ? Go::pass : game.move_at(policy.board().point_of(played));
        ASSERT_TRUE(game.legal(move)) << diagram(game) << game.move_to_text(move);
        ASSERT_FALSE(game.fills_own_eye(move)) << diagram(game) << game.move_to_text(move);
        game.play(move);
    }
}

Go after_random_moves(int size, int moves, std::uint64_t seed) {
    Rules rules;
    rules.ko = Ko::simple;
    Go game(size, {}, rules);
    engine::Random random(seed);
    for (int i = 0; i < moves; ++i) {
        const auto legal = game.legal_moves();
        game.play(legal[random.below(legal.size())]);
    }
    return game;
}

// How often in a thousand tries the policy's first move is each.
std::map<std::string, int> first_moves(const Go& game) {
    engine::Random random(1);
    std::map<std::string, int> counts;
    for (int i = 0; i < 1000; ++i) {
        RolloutPolicy<9> policy(game);
        const int played = game.to_play() == Player::first ? policy.play<Colour::black>(random)
                                                           : policy.play<Colour::white>(random);
        ++counts[played == 0 ? "pass" : vertex(policy.board().point_of(played))];
    }
    return counts;
}

float weight(const Go& game, const std::string& move) {
    MoveList moves;
    moves.push(at(game, move));
    std::vector<float> weights;
    Rollouts().weigh(game, moves, weights);
    return weights.at(0);
}

// 9x9 with the diagram's stones, then Black's or White's moves in turn.
Go played(const std::vector<std::string>& rows, const std::string& moves,
          Player first = Player::first) {
    Go game = position(rows, {}, 0, first);
    play(game, moves);
    return game;
}

const std::vector<std::string> almost_atari = {
    ". . . . . . . . .",  //
    ". . . . . . . . .",  //
    ". . . . . . . . .",  //
    ". . . . X . . . .",  //
    ". . . X O . . . .",  //
    ". . . . . . . . .",  //
    ". . . . . . . . .",  //
    ". . . . . . . . .",  //
    ". . . . . . . . .",
};

}  // namespace

TEST(GoPolicy, PlaysLegalMovesOnABoardThatKnowsItsAtaris) {
    engine::Random random(5);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        follow_policy<9>(after_random_moves(9, static_cast<int>(seed) * 8, seed), random);
        follow_policy<13>(after_random_moves(5, static_cast<int>(seed) * 3, seed), random);
        follow_policy<19>(after_random_moves(19, static_cast<int>(seed) * 20, seed), random);
        if (HasFatalFailure()) return;
    }
    follow_policy<25>(after_random_moves(25, 100, 1), random);
}

TEST(GoPolicy, SavesAChainFromAtari) {
    // Black has just put E5 in atari; White runs.
    const auto counts = first_moves(played(almost_atari, "F5"));
    EXPECT_EQ(counts.size(), 1u);
    EXPECT_EQ(counts.at("E4"), 1000);
}

TEST(GoPolicy, TakesAChainThatPutItselfInAtari) {
    const auto taken = first_moves(played({"X O . . . . . . .",  //
                                           ". . . . . . . . .",  //
                                           ". . . . . . . . .",  //
                                           ". . . . . . . . .",  //
                                           ". . . . . . . . .",  //
                                           ". . . . . . . . .",  //
                                           ". . . . . . . . .",  //
                                           "O . . . . . . . .",  //
                                           ". . . . . . . . ."},
                                          "A1", Player::first));
    EXPECT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken.at("B1"), 1000);
}

TEST(GoPolicy, AnswersByAPatternBesideTheLastMove) {
    // A contact play: hanes on both sides of it fit, a distant point does not.
    const auto counts = first_moves(played({". . . . . . . . .",  //
                                            ". . . . . . . . .",  //
                                            ". . . . . . . . .",  //
                                            ". . . . . . . . .",  //
                                            ". . . . O . . . .",  //
                                            ". . . . . . . . .",  //
                                            ". . . . . . . . .",  //
                                            ". . . . . . . . .",  //
                                            ". . . . . . . . ."},
                                           "E4"));
    EXPECT_GT(counts.at("D4") + counts.at("F4") + counts.at("D5") + counts.at("F5"), 900);
    EXPECT_FALSE(counts.contains("A9"));
}

TEST(GoPolicy, ThePatternsAreSymmetricAndColourBlind) {
    const auto code = [](std::string_view letters) {
        int shift = 0, bits = 0;
        for (const char letter : letters) {
            bits |= static_cast<int>(letter == '.'   ? Colour::empty
                                     : letter == 'X' ? Colour::black
                                     : letter == 'O' ? Colour::white
                                                     : Colour::edge)
                    << shift;
            shift += 2;
        }
        return static_cast<std::uint16_t>(bits);
    };
    const auto& patterns = Patterns::all();
    for (const auto* hane : {"XOX.....", ".....XOX", "X..O.X..", "..X.O..X", "OXO....."}) {
        EXPECT_TRUE(patterns.fit<Colour::black>(code(hane))) << hane;
        EXPECT_TRUE(patterns.fit<Colour::white>(code(hane))) << hane;
    }
    for (const auto* nothing : {"........", "XXXXXXXX", "###.....", "X......."}) {
        EXPECT_FALSE(patterns.fit<Colour::black>(code(nothing))) << nothing;
        EXPECT_FALSE(patterns.fit<Colour::white>(code(nothing))) << nothing;
    }
    // The thin hane is for its own side alone.
    EXPECT_TRUE(patterns.fit<Colour::black>(code("XOO....X")));
    EXPECT_FALSE(patterns.fit<Colour::white>(code("XOO....X")));
}

TEST(GoPolicy, WeighsCapturesRescuesAndSelfAtaris) {
    const auto in_atari = played(almost_atari, "F5");  // White to move, E5 in atari
    EXPECT_GT(weight(in_atari, "E4"), 5 * weight(in_atari, "C7"));
    auto to_take = in_atari;
    to_take.play(at(to_take, "A1"));
    EXPECT_GT(weight(to_take, "E4"), 5 * weight(to_take, "C7"));
    const auto corner = position({". O . . . . . . .",  //
                                  ". . . . . . . . .",  //
                                  "O . . . . . . . .",  //
                                  ". . . . . . . . .",  //
                                  ". . . . . . . . .",  //
                                  ". . . . . . . . .",  //
                                  ". . . . . . . . .",  //
                                  ". . . . . . . . .",  //
                                  ". . . . . . . . ."});
    EXPECT_LT(weight(corner, "A9"), 0.2f);
    EXPECT_LT(weight(corner, "pass"), 0.2f);
    // On the empty board the edge is the least.
    const Go empty(9);
    EXPECT_LT(weight(empty, "A1"), weight(empty, "B2"));
    EXPECT_LT(weight(empty, "B2"), weight(empty, "C3"));
}

TEST(GoPolicy, WeighsNearTheLastMoveMore) {
    const auto game = played(almost_atari, "G3");
    EXPECT_GT(weight(game, "G4"), weight(game, "C8"));
}
