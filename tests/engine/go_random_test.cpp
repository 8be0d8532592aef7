// Random games: against the slow reference, turned by the symmetries, and played by rollouts.
#include <gtest/gtest.h>

#include <numeric>

#include "engine/base/random.h"
#include "engine/go/rollout_board.h"
#include "engine/go/rollouts.h"
#include "engine/go/score.h"
#include "engine/go/symmetry.h"
#include "engine/perft.h"
#include "tests/engine/go_reference.h"

using namespace go;

namespace {

std::vector<Rules> all_ko_and_suicide_rules() {
    std::vector<Rules> all;
    for (const auto ko : {Ko::simple, Ko::positional, Ko::situational})
        for (const bool suicide : {false, true}) {
            Rules rules;
            rules.ko = ko;
            rules.suicide = suicide;
            all.push_back(rules);
        }
    return all;
}

int place_of(const Go& game, Move move) {
    const auto point = game.point_of(move);
    return point ? point->y * game.size() + point->x : -1;
}

Move move_to(const Go& game, int place) {
    return place < 0 ? Go::pass : game.move_at({place % game.size(), place / game.size()});
}

std::string stones_of(const Go& game) {
    std::string stones;
    for (int y = 0; y < game.size(); ++y)
        for (int x = 0; x < game.size(); ++x) {
            const auto stone = game.at({x, y});
            stones += !stone ? '.' : *stone == Player::first ? 'X' : 'O';
        }
    return stones;
}

std::vector<int> sorted_places(const Go& game) {
    std::vector<int> places;
    for (const Move move : game.legal_moves()) places.push_back(place_of(game, move));
    std::sort(places.begin(), places.end());
    return places;
}

void expect_same(const Go& game, const reference::Game& reference) {
    ASSERT_EQ(stones_of(game), reference.stones());
    ASSERT_EQ(sorted_places(game), reference.legal_moves()) << diagram(game);
    ASSERT_EQ(game.captured_by(Player::first), reference.captured_by('X'));
    ASSERT_EQ(game.captured_by(Player::second), reference.captured_by('O'));
    ASSERT_EQ(game.no_result(), reference.no_result());
}

std::uint64_t reference_count(const reference::Game& game, int depth) {
    if (depth == 0) return 1;
    std::uint64_t count = 0;
    for (const int place : game.legal_moves()) {
        auto next = game;
        next.play(place);
        count += reference_count(next, depth - 1);
    }
    return count;
}

Go random_game(int size, int moves, std::uint64_t seed, const Rules& rules = {}) {
    Go game(size, {}, rules);
    engine::Random random(seed);
    for (int i = 0; i < moves; ++i) {
        const auto legal = game.legal_moves();
        game.play(legal[random.below(legal.size())]);
    }
    return game;
}

}  // namespace

TEST(GoRandom, AgreesWithTheReference) {
    engine::Random random(1);
    for (const auto& rules : all_ko_and_suicide_rules())
        for (const int size : {2, 3, 4, 5, 7, 9}) {
            Go game(size, {}, rules);
            reference::Game slow(size, rules);
            const int moves = size < 5 ? 300 : 130;
            for (int i = 0; i < moves; ++i) {
                expect_same(game, slow);
                if (HasFatalFailure()) return;
                const auto places = slow.legal_moves();
                const int place =
                    places[static_cast<std::size_t>(random.below(static_cast<int>(places.size())))];
                game.play(move_to(game, place));
                slow.play(place);
            }
        }
}

// Passes come more often than in AgreesWithTheReference, so repetitions with them do too.
TEST(GoRandom, TinyGamesWithManyPassesAgreeWithTheReference) {
    engine::Random random(10);
    for (const auto& rules : all_ko_and_suicide_rules())
        for (int round = 0; round < 20; ++round) {
            Go game(3, {}, rules);
            reference::Game slow(3, rules);
            for (int i = 0; i < 60; ++i) {
                expect_same(game, slow);
                if (HasFatalFailure()) return;
                const auto places = slow.legal_moves();
                const int choice = random.below(static_cast<int>(places.size()) + 1);
                const int place =
                    places[static_cast<std::size_t>(choice % static_cast<int>(places.size()))];
                game.play(move_to(game, place));
                slow.play(place);
            }
        }
}

TEST(GoRandom, LargestBoardAgreesWithTheReference) {
    engine::Random random(2);
    Go game(25);
    reference::Game slow(25, {});
    for (int i = 0; i < 600; ++i) {
        const auto legal = game.legal_moves();
        const auto move = legal[random.below(legal.size())];
        slow.play(place_of(game, move));
        game.play(move);
        ASSERT_EQ(stones_of(game), slow.stones());
    }
    expect_same(game, slow);
}

TEST(GoRandom, SequencesAreAsManyAsTheReferenceCounts) {
    for (const auto& rules : all_ko_and_suicide_rules())
        for (const auto& [size, depth] : {std::pair(2, 7), std::pair(3, 4)})
            EXPECT_EQ(engine::perft(Go(size, {}, rules), depth),
                      reference_count(reference::Game(size, rules), depth))
                << to_json(rules) << " depth " << depth;
}

// J. Tromp and G. Farnebäck, "Combinatorics of Go" (2007): 57 and 12 675 legal positions.
TEST(GoRandom, LegalPositionsAreAsManyAsIsKnown) {
    const auto count_legal = [](int size) {
        int places = size * size, all = 1, legal = 0;
        for (int i = 0; i < places; ++i) all *= 3;
        for (int number = 0; number < all; ++number) {
            Go game(size);
            for (int place = 0, rest = number; place < places; ++place, rest /= 3)
                if (rest % 3 != 0)
                    game.set_up({place % size, place / size},
                                rest % 3 == 1 ? Player::first : Player::second);
            legal += game.every_chain_has_liberty();
        }
        return legal;
    };
    EXPECT_EQ(count_legal(2), 57);
    EXPECT_EQ(count_legal(3), 12675);
}

TEST(GoRandom, RulesCommuteWithSymmetries) {
    for (const auto& rules : all_ko_and_suicide_rules())
        for (int symmetry = 0; symmetry < symmetries; ++symmetry) {
            engine::Random random(static_cast<std::uint64_t>(symmetry));
            Go game(5, {}, rules), turned = game;
            for (int i = 0; i < 120; ++i) {
                const auto legal = game.legal_moves();
                auto expected = std::vector<int>{};
                for (const Move move : legal)
                    expected.push_back(place_of(game, transformed(game, move, symmetry)));
                std::sort(expected.begin(), expected.end());
                ASSERT_EQ(sorted_places(turned), expected);
                const auto move = legal[random.below(legal.size())];
                game.play(move);
                turned.play(transformed(turned, move, symmetry));
            }
            EXPECT_EQ(score(game).lead_halves, score(turned).lead_halves);
        }
}

TEST(GoRandom, SymmetriesAreEightAndHaveInverses) {
    std::vector<std::vector<int>> seen;
    for (int symmetry = 0; symmetry < symmetries; ++symmetry) {
        std::vector<int> places;
        for (int place = 0; place < 9; ++place) {
            const Point point{place % 3, place / 3};
            const auto there = transformed(point, 3, symmetry);
            EXPECT_EQ(transformed(there, 3, inverse_symmetry(symmetry)), point);
            places.push_back(there.y * 3 + there.x);
        }
        EXPECT_EQ(std::find(seen.begin(), seen.end(), places), seen.end());
        seen.push_back(places);
    }
}

TEST(GoRandom, RemembersTheLastEightPositions) {
    Go game(9);
    engine::Random random(3);
    std::vector<Stones> stones{game.board().stones()};
    std::vector<Move> moves;
    for (int i = 0; i < 60; ++i) {
        const auto legal = game.legal_moves();
        moves.push_back(legal[random.below(legal.size())]);
        game.play(moves.back());
        stones.push_back(game.board().stones());
        for (int ago = 0; ago < Go::remembered; ++ago) {
            const auto at = static_cast<int>(moves.size()) - ago;
            EXPECT_EQ(game.stones_before(ago),
                      at < 0 ? Stones{} : stones[static_cast<std::size_t>(at)]);
            EXPECT_EQ(
                game.move_before(ago),
                at < 1 ? std::nullopt : std::optional(moves[static_cast<std::size_t>(at - 1)]));
        }
    }
}

TEST(GoRandom, CopiesAreEqualAndIndependent) {
    const Go game = random_game(9, 80, 4);
    Go copy = game;
    EXPECT_EQ(copy, game);
    copy.play(Go::pass);
    EXPECT_NE(copy, game);
    EXPECT_NE(copy.key(), game.key());
    EXPECT_LT(sizeof(Board), 4096u);
}

namespace {

bool sensible(const Go& game, Move move) { return move != Go::pass && !game.fills_own_eye(move); }

bool has_sensible_move(const Go& game) {
    for (const Move move : game.legal_moves())
        if (sensible(game, move)) return true;
    return false;
}

// Follows a rollout with the ordinary board.
template <int most_size>
void follow_rollout(Go game, engine::Random& random) {
    RolloutBoard<most_size> board(game);
    for (int i = 0; i < 3 * game.size() * game.size() && game.consecutive_passes() < 2; ++i) {
        const int at = game.to_play() == Player::first
                           ? board.template play_random<Colour::black>(random)
                           : board.template play_random<Colour::white>(random);
        const auto move = at == 0 ? Go::pass : game.move_at(board.point_of(at));
        ASSERT_TRUE(game.legal(move)) << diagram(game) << game.move_to_text(move);
        ASSERT_TRUE(at == 0 ? !has_sensible_move(game) : sensible(game, move)) << diagram(game);
        game.play(move);
    }
    for (int y = 0; y < game.size(); ++y)
        for (int x = 0; x < game.size(); ++x)
            if (const auto stone = game.at({x, y})) {
                ASSERT_EQ(board.owner(x, y), *stone == Player::first ? 1 : -1);
            }
}

}  // namespace

TEST(GoRollouts, PlayLegalSensibleMovesFromAnyPosition) {
    engine::Random random(5);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        follow_rollout<9>(random_game(9, static_cast<int>(seed) * 8, seed), random);
        follow_rollout<13>(random_game(5, static_cast<int>(seed) * 3, seed), random);
        follow_rollout<25>(random_game(25, static_cast<int>(seed) * 40, seed), random);
        if (HasFatalFailure()) return;
    }
}

TEST(GoRollouts, LeadOwnersAndOutcomeAgree) {
    engine::Random random(6);
    Rollouts rollouts;
    for (const int size : {2, 5, 9, 13, 16, 19, 25}) {
        const Go game(size, Komi::from_points(3.5));
        const auto result = rollouts.play(game, random);
        ASSERT_EQ(result.owners.size(), static_cast<std::size_t>(size * size));
        const int area = std::accumulate(result.owners.begin(), result.owners.end(), 0);
        EXPECT_EQ(result.lead, static_cast<float>(area) - 3.5f);
        EXPECT_EQ(result.outcome, result.lead > 0 ? Outcome::first_wins : Outcome::second_wins);
    }
}

TEST(GoRollouts, CountTerritoryByWhatWasPlayed) {
    Go game(9, Komi::from_points(0), rules_from_text("japanese"));
    for (int x = 0; x < 3; ++x) {
        game.play(game.move_at({x, 4}));
        game.play(Go::pass);
    }
    engine::Random random(7);
    Rollouts rollouts;
    const auto result = rollouts.play(game, random);
    const int area = std::accumulate(result.owners.begin(), result.owners.end(), 0);
    EXPECT_EQ(result.lead, static_cast<float>(area - 3));
}

TEST(GoRollouts, OfAFinishedGameAreItsScore) {
    Go game(5, Komi::from_points(0.5));
    game.play(game.move_at({2, 2}));
    game.play(Go::pass);
    game.play(Go::pass);
    engine::Random random(8);
    Rollouts rollouts;
    const auto result = rollouts.play(game, random);
    EXPECT_EQ(result.lead, 24.5f);
    EXPECT_EQ(result.outcome, Outcome::first_wins);
    EXPECT_EQ(std::accumulate(result.owners.begin(), result.owners.end(), 0), 25);
}

TEST(GoRollouts, SpareNoSideOnTheEmptyBoard) {
    engine::Random random(9);
    RandomRollouts rollouts;
    double lead = 0;
    constexpr int games = 4000;
    for (int i = 0; i < games; ++i) lead += rollouts.play(Go(9, Komi::from_points(0)), random).lead;
    // The first move is worth a few points; the mean's standard error is about 0.5.
    EXPECT_GT(lead / games, 0.5);
    EXPECT_LT(lead / games, 8);
}
