// AlphaGo's linear policies: their features on diagrams, and that the rollout policy, kept up to
// date move by move, is what it would be made anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/go/linear_policy.h"
#include "engine/go/rollouts.h"
#include "engine/go/softmax_policy.h"
#include "engine/go/symmetry.h"
#include "tests/engine/go_position.h"

namespace go {
namespace {

Factors drawn_factors(std::uint64_t seed) {
    engine::Random random(seed);
    std::vector<float> logits(static_cast<std::size_t>(features::count));
    for (auto& logit : logits) logit = static_cast<float>(3 * uniform(random) - 1.5);
    return Factors(logits);
}

std::shared_ptr<const LinearPolicies> drawn_policies() {
    return std::make_shared<const LinearPolicies>(
        LinearPolicies{drawn_factors(1), drawn_factors(2)});
}

template <int most_size>
std::map<int, double> chances_of(SoftmaxPolicy<most_size>& policy, Player mover) {
    const auto list = mover == Player::first ? policy.template chances<Colour::black>()
                                             : policy.template chances<Colour::white>();
    return {list.begin(), list.end()};
}

using Features = std::multiset<int>;

// Of what the last moves make of a move of whoever is to play.
Features answers(const Go& game, std::string_view vertex) {
    const FeatureBoard<9> position(game);
    const int wanted = FeatureBoard<9>::Board::index(*point_from_vertex(vertex, game.size()));
    Features found;
    const auto visit = [&](int at, int feature) {
        if (at == wanted) found.insert(feature);
    };
    game.to_play() == Player::first ? position.for_each_answer<Colour::black>(visit)
                                    : position.for_each_answer<Colour::white>(visit);
    return found;
}

std::optional<int> contact(const Go& game, std::string_view vertex) {
    const FeatureBoard<9> position(game);
    const int at = FeatureBoard<9>::Board::index(*point_from_vertex(vertex, game.size()));
    return game.to_play() == Player::first ? position.contact<Colour::black>(at)
                                           : position.contact<Colour::white>(at);
}

TEST(MoveFeatures, PatternsAreTheSameOnATurnedBoard) {
    const auto& numbers = features::patterns_of_black();
    EXPECT_EQ(std::set(numbers.begin(), numbers.end()).size(),
              static_cast<std::size_t>(features::pattern_count));
    const auto at_centre = [&](const Go& game) {
        const FeatureBoard<9> position(game);
        const int at = FeatureBoard<9>::Board::index({1, 1});
        return numbers[position.board().surroundings(at)];
    };
    const auto number = at_centre(position({"XO.", "...", "X.."}));
    EXPECT_EQ(at_centre(position({"X.X", "..O", "..."})), number);
    EXPECT_NE(at_centre(position({"OX.", "...", "X.."})), number);
}

TEST(MoveFeatures, WhitesPatternsAreBlacksExchanged) {
    const auto factors = drawn_factors(3);
    const FeatureBoard<9> one(position({"XO.", "...", "X.."})),
        other(position({"OX.", "...", "O.."}));
    const int at = FeatureBoard<9>::Board::index({1, 1});
    EXPECT_EQ(factors.of_pattern(one.board().surroundings(at), Colour::black),
              factors.of_pattern(other.board().surroundings(at), Colour::white));
}

TEST(MoveFeatures, Contact) {
    const auto game = position({".....", ".XO..", "XO.O.", ".XO.X", "...XO"});
    EXPECT_EQ(contact(game, "C3"), features::contact_feature(1, false, 0));  // takes B3
    EXPECT_EQ(contact(game, "E3"), features::contact_feature(0, false, 1));
    EXPECT_EQ(contact(game, "A1"), features::contact_feature(0, false, 2));
    EXPECT_EQ(contact(position({"XX.", "..X", "..."}), "C3"), std::nullopt);  // an own eye
    EXPECT_EQ(contact(position({"OO.", "..O", "..."}), "C3"), std::nullopt);  // suicide
    EXPECT_EQ(contact(position({"OOO", "OX.", "OO."}), "C2"),
              features::contact_feature(0, true, 1));
    EXPECT_EQ(contact(position({".OO", "OXX", "..."}), "A3"),
              features::contact_feature(2, false, 0));  // takes B3 and C3
}

TEST(MoveFeatures, SavesFromAtari) {
    auto game = position({".....", "..O..", ".OX..", ".....", "....."}, {}, 0, Player::second);
    play(game, "C2");  // Black's C3 is left with D3
    EXPECT_EQ(answers(game, "D3").count(features::save), 1u);
    EXPECT_EQ(answers(game, "A1").count(features::save), 0u);
}

TEST(MoveFeatures, SavesByCapture) {
    auto game = position({".....", ".....", "X....", "OX...", ".OO.."}, {}, 0, Player::second);
    play(game, "A4");  // A3 is left with B3, and White's A2 with A1
    EXPECT_EQ(answers(game, "A1").count(features::save + 1), 1u);
    EXPECT_EQ(answers(game, "B3").count(features::save), 1u);
}

TEST(MoveFeatures, BesideTheLastMove) {
    Go game(5);
    play(game, "C3");
    EXPECT_EQ(answers(game, "C2").count(features::beside_last), 1u);
    EXPECT_EQ(answers(game, "B2").count(features::beside_last + 1), 1u);
    EXPECT_EQ(answers(game, "C5").size(), 1u);  // the response alone
    EXPECT_TRUE(answers(game, "E4").empty());
}

TEST(MoveFeatures, ResponsesAreTheSameOnATurnedBoard) {
    Go game(9), twin(9);
    play(game, "D4 E4");
    play(twin, "F4 E4");  // mirrored about column E, but for the last stone
    EXPECT_EQ(answers(game, "E5"), answers(twin, "E5"));
    EXPECT_EQ(answers(game, "F4"), answers(twin, "D4"));
    EXPECT_NE(answers(game, "E5"), answers(game, "F4"));
}

TEST(MoveFeatures, NakadeAfterACapture) {
    // White takes three in a row; Black's answer in their middle is a nakade.
    auto game = position({"XXX.O", "OOO.O", "..OOO", ".....", "....."}, {}, 0, Player::second);
    play(game, "D5");
    const auto middle = answers(game, "B5"), end = answers(game, "A5"), other = answers(game, "C5");
    const auto is_nakade = [](int feature) {
        return feature >= features::nakade && feature < features::nakade + features::nakade_count;
    };
    EXPECT_EQ(std::count_if(middle.begin(), middle.end(), is_nakade), 1);
    const auto nakade = [&](const Features& all) {
        return *std::find_if(all.begin(), all.end(), is_nakade);
    };
    EXPECT_NE(nakade(middle), nakade(end));
    EXPECT_EQ(nakade(end), nakade(other));
}

TEST(MoveFeatures, OfTheTreeAlone) {
    auto game = position({".....", "OO...", ".O...", ".....", "....."});
    play(game, "D1 E1");
    const FeatureBoard<9> board(game);
    const auto of = [&](Point point) {
        Features found;
        board.for_each_tree_feature<Colour::black>(FeatureBoard<9>::Board::index(point),
                                                   [&](int feature) { found.insert(feature); });
        return found;
    };
    EXPECT_EQ(of({0, 2}).count(features::self_atari), 1u);
    EXPECT_EQ(of({3, 3}).count(features::self_atari), 0u);
    // From E1 the point D2 is dx = dy = 1: 3; from D1 2.
    EXPECT_EQ(of({3, 1}).count(features::last_distance + 1), 1u);
    EXPECT_EQ(of({3, 1}).count(features::previous_distance), 1u);
}

template <int most_size>
void expect_incremental(int size, std::uint64_t seed) {
    const auto factors = drawn_factors(7);
    engine::Random random(seed);
    Go game(size, {}, rules_with(Ko::simple));
    SoftmaxPolicy<most_size> policy(factors, game);
    for (int ply = 0; ply < 3 * size * size && game.outcome() == Outcome::ongoing; ++ply) {
        SoftmaxPolicy<most_size> anew(factors, game);
        const auto chances = chances_of(policy, game.to_play());
        ASSERT_EQ(chances, chances_of(anew, game.to_play())) << game.to_text();
        const int at = game.to_play() == Player::first
                           ? policy.template play<Colour::black>(random)
                           : policy.template play<Colour::white>(random);
        const Move move =
            at == 0 ? Go::pass : game.move_at(SoftmaxPolicy<most_size>::Board::point_of(at));
        ASSERT_EQ(at == 0, chances.empty());
        ASSERT_TRUE(game.legal(move)) << game.to_text();
        game.play(move);
    }
}

TEST(SoftmaxPolicy, KeptUpToDateIsAsMadeAnew) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) expect_incremental<9>(9, seed);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) expect_incremental<9>(5, seed);
    expect_incremental<19>(19, 1);
}

TEST(SoftmaxPolicy, PlaysWhatIsLegalAndFillsNoEye) {
    const auto factors = drawn_factors(9);
    engine::Random random(3);
    Go game(7, {}, rules_with(Ko::simple));
    for (int ply = 0; ply < 120 && game.outcome() == Outcome::ongoing; ++ply) {
        SoftmaxPolicy<9> policy(factors, game);
        double sum = 0;
        std::set<int> listed;
        for (const auto& [at, chance] : chances_of(policy, game.to_play())) {
            sum += chance;
            listed.insert(game.move_at(SoftmaxPolicy<9>::Board::point_of(at)).code);
        }
        std::set<int> sensible;
        for (const Move move : game.legal_moves())
            if (move != Go::pass && !game.fills_own_eye(move)) sensible.insert(move.code);
        ASSERT_EQ(listed, sensible) << game.to_text();
        ASSERT_NEAR(sum, listed.empty() ? 0 : 1, 1e-9);
        const auto moves = game.legal_moves();
        game.play(moves[random.below(moves.size())]);
    }
}

TEST(SoftmaxPolicy, DrawsAsOftenAsItSays) {
    const auto factors = drawn_factors(11);
    Go game(5);
    play(game, "C3 C4 B4 D3");
    SoftmaxPolicy<9> policy(factors, game);
    const auto chances = chances_of(policy, game.to_play());
    engine::Random random(5);
    std::map<int, int> drawn;
    constexpr int draws = 40000;
    for (int i = 0; i < draws; ++i) ++drawn[SoftmaxPolicy<9>(policy).play<Colour::black>(random)];
    for (const auto& [at, chance] : chances)
        EXPECT_NEAR(static_cast<double>(drawn[at]) / draws, chance, 0.012) << at;
}

TEST(LinearRollouts, EndAndAreScored) {
    LinearRollouts rollouts(drawn_policies());
    engine::Random random(1);
    for (const int size : {5, 9, 13, 19, 25}) {
        const auto result = rollouts.play(Go(size, Komi::from_points(0.5)), random);
        EXPECT_NE(result.outcome, Outcome::ongoing);
        EXPECT_EQ(result.owners.size(), static_cast<std::size_t>(size * size));
    }
}

TEST(LinearRollouts, WeighLegalMoves) {
    const LinearRollouts rollouts(drawn_policies());
    Go game(9);
    play(game, "E5 E6 D6");
    std::vector<float> weights;
    const auto moves = game.legal_moves();
    rollouts.weigh(game, moves, weights);
    ASSERT_EQ(weights.size(), static_cast<std::size_t>(moves.size()));
    float sum = 0;
    for (const float weight : weights) sum += weight;
    EXPECT_NEAR(sum, 1, 0.01);
    EXPECT_LT(weights.back(), 0.001);  // a pass
}

}  // namespace
}  // namespace go
