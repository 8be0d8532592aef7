// AlphaGo Zero's planes of Go: what they show, one index a move, and the same on a turned board;
// of KataGo's, that what is remembered does not change them.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>
#include <vector>

#include "engine/base/random.h"
#include "engine/go/go.h"
#include "engine/go/symmetry.h"

namespace go {
namespace {

const engine::Encoding<Go>& encoding() { return engine::find_encoding<Go>("alphazero"); }

std::vector<float> planes_of(const Go& game) {
    std::vector<float> planes(encoding().shape(game).planes_size(), -1.0f);
    encoding().write(game, planes, {});
    return planes;
}

float value_at(const std::vector<float>& planes, int size, int plane, Point point) {
    return planes[static_cast<std::size_t>((plane * size + point.y) * size + point.x)];
}

TEST(GoEncoding, Shape) {
    for (const int size : {2, 9, 19, 25}) {
        const auto shape = encoding().shape(Go(size));
        EXPECT_EQ(shape.planes, 17);
        EXPECT_EQ(shape.height, size);
        EXPECT_EQ(shape.width, size);
        EXPECT_EQ(shape.globals, 0);
        EXPECT_EQ(shape.policy_size, size * size + 1);
        EXPECT_EQ(shape.symmetries, 8);
    }
}

TEST(GoEncoding, OwnStonesThenTheOpponentsNowAndSevenMovesBack) {
    Go game(5);
    for (const char* move : {"A1", "B1", "C3"}) game.play(*game.move_from_text(move));
    // White to play; Black's A1 and C3 are the opponent's.
    const auto planes = planes_of(game);
    const Point a1{0, 0}, b1{1, 0}, c3{2, 2};
    EXPECT_EQ(value_at(planes, 5, 0, b1), 1);
    EXPECT_EQ(value_at(planes, 5, 0, a1), 0);
    EXPECT_EQ(value_at(planes, 5, 8, a1), 1);
    EXPECT_EQ(value_at(planes, 5, 8, c3), 1);
    EXPECT_EQ(value_at(planes, 5, 9, c3), 0);  // a move ago
    EXPECT_EQ(value_at(planes, 5, 1, b1), 1);
    EXPECT_EQ(value_at(planes, 5, 2, b1), 0);  // two moves ago
    EXPECT_EQ(value_at(planes, 5, 10, a1), 1);
    EXPECT_EQ(value_at(planes, 5, 11, a1), 0);  // before the first move
    EXPECT_EQ(value_at(planes, 5, 16, c3), 0);  // White to play
    game.play(Go::pass);
    EXPECT_EQ(value_at(planes_of(game), 5, 16, c3), 1);
    // B1 in 2 planes, A1 in 3, C3 in 1.
    float sum = 0;
    for (const float value : planes) sum += value;
    EXPECT_EQ(sum, 6);
}

void expect_one_index_a_move(const Go& game) {
    std::set<int> indices;
    for (const Move move : game.legal_moves()) {
        const int index = encoding().policy_index(game, move);
        EXPECT_TRUE(index >= 0 && index <= game.size() * game.size());
        EXPECT_TRUE(indices.insert(index).second);
    }
    EXPECT_TRUE(indices.contains(game.size() * game.size()));  // the pass
}

void expect_turned(const Go& game, const Go& twin, int symmetry) {
    const auto planes = planes_of(game), turned = planes_of(twin);
    const int size = game.size();
    for (int plane = 0; plane < 17; ++plane)
        for (int at = 0; at < size * size; ++at) {
            const Point point{at % size, at / size};
            ASSERT_EQ(value_at(planes, size, plane, point),
                      value_at(turned, size, plane, transformed(point, size, symmetry)));
        }
}

// A point's place in the policy, and nothing else, goes where the point goes.
void expect_turned_policy(const Go& game, const Go& twin, int symmetry) {
    const int size = game.size();
    for (const Move move : game.legal_moves()) {
        const Move other = transformed(game, move, symmetry);
        const auto point = game.point_of(move);
        const auto to = transformed(point.value_or(Point{}), size, symmetry);
        EXPECT_EQ(encoding().policy_index(twin, other), point ? to.y * size + to.x : size * size);
    }
}

TEST(GoEncoding, InjectiveAndTurnsWithTheBoard) {
    engine::Random random(9);
    for (int symmetry = 0; symmetry < symmetries; ++symmetry)
        for (const int size : {5, 9}) {
            Go game(size), twin(size);
            for (int ply = 0; ply < 60 && game.outcome() == Outcome::ongoing; ++ply) {
                expect_one_index_a_move(game);
                expect_turned(game, twin, symmetry);
                expect_turned_policy(game, twin, symmetry);
                const auto moves = game.legal_moves();
                const Move move = moves[random.below(moves.size())];
                twin.play(transformed(game, move, symmetry));
                game.play(move);
            }
        }
}

std::vector<float> katago_inputs_of(const Go& game) {
    const auto& katago = engine::find_encoding<Go>("katago-v7");
    const auto shape = katago.shape(game);
    std::vector<float> planes(shape.planes_size()),
        globals(static_cast<std::size_t>(shape.globals));
    katago.write(game, planes, globals);
    planes.insert(planes.end(), globals.begin(), globals.end());
    return planes;
}

// A thread remembers the ladders of boards that it has seen; a new one has seen none.
TEST(GoEncoding, LaddersRememberedAreThoseOfAThreadThatReadsThemAnew) {
    engine::Random random(3);
    bool any = false;
    for (const int size : {5, 7, 7, 9}) {
        Go game(size);
        for (int ply = 0; ply < 90 && game.outcome() == Outcome::ongoing; ++ply) {
            auto moves = game.legal_moves();
            moves.filter([&](Move move) { return move != Go::pass && !game.fills_own_eye(move); });
            game.play(moves.empty() ? Go::pass : moves[random.below(moves.size())]);
            const auto remembered = katago_inputs_of(game);
            std::vector<float> anew;
            std::thread([&] { anew = katago_inputs_of(game); }).join();
            ASSERT_EQ(remembered, anew) << game.to_text();
            constexpr int in_ladder = 14;
            const auto points = static_cast<std::ptrdiff_t>(size) * size;
            const auto plane = remembered.begin() + in_ladder * points;
            any = any || std::count(plane, plane + points, 1.0f) > 0;
        }
    }
    EXPECT_TRUE(any);
}

}  // namespace
}  // namespace go
