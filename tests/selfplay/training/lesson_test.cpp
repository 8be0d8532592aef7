// What a network is taught of a position: the right signs for both colours in every game, and the
// same thing whichever way the board is turned.
#include "selfplay/training/lesson.h"

#include <gtest/gtest.h>

#include <map>

#include "engine/games.h"
#include "engine/go/symmetry.h"
#include "random_record.h"

namespace selfplay::training {
namespace {

template <class G>
Lesson lesson_of(const records::Game& record, std::size_t turn, int symmetry = 0,
                 std::string_view encoding = "alphazero", const ValueTarget& target = {}) {
    Lesson lesson;
    write_lesson(record, turn, engine::find_encoding<G>(encoding), symmetry, target, lesson);
    return lesson;
}

template <class G>
struct LessonOf : testing::Test {};
using Games = testing::Types<go::Go, chess::Chess, shogi::Shogi>;
TYPED_TEST_SUITE(LessonOf, Games);

template <class G>
G small_start() {
    if constexpr (std::is_same_v<G, go::Go>)
        return go::Go(5);
    else
        return G();
}

TYPED_TEST(LessonOf, TheWinnerIsTaughtAWinAndTheLoserALoss) {
    auto record = random_record(small_start<TypeParam>(), 1, 12);
    for (const auto winner : {engine::Player::first, engine::Player::second}) {
        record.outcome = engine::win_for(winner);
        for (std::size_t turn = 0; turn < record.turns.size(); ++turn) {
            const auto mover = position_of<TypeParam>(record, turn).to_play();
            const auto lesson = lesson_of<TypeParam>(record, turn);
            EXPECT_EQ(lesson.value, mover == winner ? 1 : -1) << turn;
            EXPECT_EQ(lesson.outcome[0], mover == winner ? 1 : 0) << turn;
            EXPECT_EQ(lesson.outcome[1], 0) << turn;
            EXPECT_EQ(lesson.outcome[2], mover == winner ? 0 : 1) << turn;
            EXPECT_EQ(lesson.moves_left, static_cast<float>(record.turns.size() - turn));
        }
    }
    record.outcome = engine::Outcome::draw;
    EXPECT_EQ(lesson_of<TypeParam>(record, 3).outcome[1], 1);
    EXPECT_EQ(lesson_of<TypeParam>(record, 3).value, 0);
}

TYPED_TEST(LessonOf, TheSearchsValueIsTheMoversOwn) {
    auto record = random_record(small_start<TypeParam>(), 1, 4);
    record.outcome = engine::Outcome::first_wins;
    record.turns[1].value = 0.5f;
    record.turns[1].draws = 0.2f;
    const auto lesson = lesson_of<TypeParam>(record, 1, 0, "alphazero", {0.5f, false});
    EXPECT_FLOAT_EQ(lesson.value, 0.5f * -1 + 0.5f * 0.5f);
    EXPECT_FLOAT_EQ(lesson.outcome[0], 0.5f * 0.65f);
    EXPECT_FLOAT_EQ(lesson.outcome[1], 0.5f * 0.2f);
    EXPECT_FLOAT_EQ(lesson.outcome[2], 0.5f + 0.5f * 0.15f);
}

// Games by others have no search, whose value then is no verdict either.
TYPED_TEST(LessonOf, WithoutASearchTheResultIsAll) {
    auto record = random_record(small_start<TypeParam>(), 1, 4);
    record.outcome = engine::Outcome::first_wins;
    record.turns[1].simulations = 0;
    EXPECT_EQ(lesson_of<TypeParam>(record, 1, 0, "alphazero", {0.5f, false}).value, -1);
}

// Random play rarely mates: what counts is who won the rollouts that had a winner.
TYPED_TEST(LessonOf, RolloutsTeachWhoWinsAmongThoseThatAreWon) {
    auto record = random_record(small_start<TypeParam>(), 1, 4);
    record.outcome = engine::Outcome::second_wins;
    record.by_rollouts = true;
    record.turns[1].value = 0.1f;
    record.turns[1].draws = 0.85f;
    const auto lesson = lesson_of<TypeParam>(record, 1);
    EXPECT_FLOAT_EQ(lesson.outcome[0], 0.75f);
    EXPECT_FLOAT_EQ(lesson.outcome[1], 0);
    EXPECT_FLOAT_EQ(lesson.outcome[2], 0.25f);
    // One rollout of a thousand is no verdict.
    record.turns[1].value = -0.001f;
    record.turns[1].draws = 0.999f;
    EXPECT_NEAR(lesson_of<TypeParam>(record, 1).value, 0, 0.02f);
}

TYPED_TEST(LessonOf, AGameCutOffMayEndAsItsLastSearchExpected) {
    auto record = random_record(small_start<TypeParam>(), 1, 4);
    record.outcome = engine::Outcome::draw;
    record.ending = records::Ending::move_limit;
    record.owners.clear();
    record.turns.back().value = 0.5f;
    record.turns.back().draws = 0.25f;
    for (std::size_t turn = 0; turn < record.turns.size(); ++turn) {
        EXPECT_EQ(lesson_of<TypeParam>(record, turn).outcome[1], 1);
        const auto judged = lesson_of<TypeParam>(record, turn, 0, "alphazero", {0, true});
        const bool theirs = (record.turns.size() - turn) % 2 != 0;
        EXPECT_FLOAT_EQ(judged.value, theirs ? 0.5f : -0.5f) << turn;
        EXPECT_FLOAT_EQ(judged.outcome[1], 0.25f);
    }
    record.ending = records::Ending::rules;
    EXPECT_EQ(lesson_of<TypeParam>(record, 0, 0, "alphazero", {0, true}).outcome[1], 1);
}

std::map<int, float> policy_of(const Lesson& lesson) {
    std::map<int, float> policy;
    for (std::size_t i = 0; i < lesson.moves.size(); ++i)
        policy[lesson.moves[i]] = lesson.policy[i];
    return policy;
}

// Whether it is what the record says of that turn, by the moves' places in the policy.
template <class G>
void expect_policy(const records::Game& record, std::size_t turn) {
    const auto& encoding = engine::find_encoding<G>("alphazero");
    const G game = position_of<G>(record, turn);
    const auto lesson = lesson_of<G>(record, turn);
    EXPECT_EQ(static_cast<int>(lesson.moves.size()), game.legal_moves().size());
    auto taught = policy_of(lesson);
    float sum = 0, shares = 0;
    for (const auto& [move, part] : taught) sum += part;
    EXPECT_NEAR(sum, turn % 2 == 0 ? 1 : 0, 1e-5);
    for (const auto& share : record.policy(record.turns[turn])) shares += share.share;
    for (const auto& share : record.policy(record.turns[turn]))
        EXPECT_NEAR(taught[encoding.policy_index(game, share.move)], share.share / shares, 1e-5);
}

TYPED_TEST(LessonOf, ThePolicyIsOverTheLegalMovesAndSumsToOne) {
    const auto record = random_record(small_start<TypeParam>(), 2, 10, 2);
    for (std::size_t turn = 0; turn < record.turns.size(); ++turn)
        expect_policy<TypeParam>(record, turn);
}

// The same game on the turned board.
records::Game turned(const records::Game& record, int symmetry) {
    auto other = record;
    go::Go game = go::Go::from_text(record.start);
    for (auto& turn : other.turns) turn.move = go::transformed(game, turn.move, symmetry);
    for (auto& share : other.shares) share.move = go::transformed(game, share.move, symmetry);
    const int size = game.size();
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const auto to = go::transformed({x, y}, size, symmetry);
            other.owners[static_cast<std::size_t>(to.y * size + to.x)] =
                record.owners[static_cast<std::size_t>(y * size + x)];
        }
    return other;
}

bool same(const Lesson& a, const Lesson& b) {
    return a.planes == b.planes && a.globals == b.globals && policy_of(a) == policy_of(b) &&
           a.ownership == b.ownership;
}

// Whether turning the planes of `record` by `symmetry` is turning its moves by `other`.
bool commutes(const records::Game& record, std::string_view encoding, int symmetry, int other) {
    const auto image = turned(record, other);
    for (std::size_t turn = 0; turn < record.turns.size(); ++turn)
        if (!same(lesson_of<go::Go>(record, turn, symmetry, encoding),
                  lesson_of<go::Go>(image, turn, 0, encoding)))
            return false;
    return true;
}

// The evaluators turn a board the other way round than go::transformed.
TEST(GoLessons, TurningTheLessonIsTurningTheGame) {
    const auto record = random_record(go::Go(5, {}, {.ko = go::Ko::positional}), 3, 40);
    for (const std::string_view encoding : {"alphazero", "katago-v7"})
        for (int symmetry = 0; symmetry < 8; ++symmetry) {
            int found = 0;
            for (int other = 0; other < 8; ++other)
                found += commutes(record, encoding, symmetry, other);
            EXPECT_EQ(found, 1) << encoding << " " << symmetry;
        }
}

TEST(GoLessons, OwnersAndLeadAreTheMovers) {
    auto record = random_record(go::Go(5), 4, 30);
    record.lead = 3.5f;
    record.owners.assign(25, 0);
    record.owners[7] = 1;
    const auto black = lesson_of<go::Go>(record, 0), white = lesson_of<go::Go>(record, 1);
    EXPECT_EQ(black.ownership[7], 1);
    EXPECT_EQ(white.ownership[7], -1);
    EXPECT_EQ(black.ownership[8], 0);
    EXPECT_EQ(black.lead, 3.5f);
    EXPECT_EQ(white.lead, -3.5f);
    record.owners.clear();
    EXPECT_FALSE(lesson_of<go::Go>(record, 0).scored);
    EXPECT_EQ(lesson_of<go::Go>(record, 0).ownership, std::vector<float>(25, 0.0f));
}

}  // namespace
}  // namespace selfplay::training
