// Self-play games in other programs' formats: what is read back is what was played.
#include "selfplay/records/export.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <numeric>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/chess/pgn.h"
#include "engine/games.h"
#include "engine/go/sgf.h"
#include "engine/shogi/csa.h"
#include "engine/shogi/record.h"
#include "selfplay/records/arrays.h"
#include "selfplay/records/npz.h"
#include "selfplay/records/segment.h"
#include "tests/selfplay/training/play.h"
#include "tests/temporary_folder.h"

namespace selfplay::records {
namespace {

template <class G>
std::vector<Game> some_games(int count) {
    return training::games_of<G>(training::small_settings(), 1, training::even<G>(),
                                 static_cast<std::uint64_t>(count));
}

TEST(Export, GoComesBackFromSgf) {
    int index = 0;
    for (const auto& game : some_games<go::Go>(6)) {
        const auto trees = go::sgf::parse(to_text(game, index++));
        ASSERT_EQ(trees.size(), 1u);
        const auto record = go::sgf::main_line(trees[0]);
        EXPECT_EQ(record.start.size(), 5);
        EXPECT_EQ(record.start.komi().points(), 7.5);
        ASSERT_EQ(record.turns.size(), game.turns.size());
        for (std::size_t i = 0; i < game.turns.size(); ++i)
            EXPECT_EQ(record.turns[i].move, game.turns[i].move);
        EXPECT_EQ(match_record(game, 0).reason, "score");
    }
}

TEST(Export, ChessComesBackFromPgn) {
    for (const auto& game : some_games<chess::Chess>(4)) {
        std::istringstream file(to_text(game, 0));
        chess::pgn::Reader reader(file);
        const auto record = reader.next();
        ASSERT_TRUE(record);
        const auto moves = record->main_line();
        ASSERT_EQ(moves.size(), game.turns.size());
        for (std::size_t i = 0; i < moves.size(); ++i) EXPECT_EQ(moves[i], game.turns[i].move);
    }
}

TEST(Export, ShogiIsWrittenAsCsa) {
    const auto games = some_games<shogi::Shogi>(2);
    const auto text = to_text(games[0], 0);
    const auto moves = std::count(text.begin(), text.end(), '\n');
    EXPECT_GE(static_cast<std::size_t>(moves), games[0].turns.size());
    EXPECT_NE(text.find("self-play, 7 steps"), std::string::npos);
}

TEST(Export, AResignedGameSaysSo) {
    auto game = some_games<go::Go>(1)[0];
    game.ending = Ending::resigned;
    game.outcome = engine::Outcome::second_wins;
    game.owners.clear();
    EXPECT_NE(to_text(game, 0).find("RE[W+R]"), std::string::npos);
}

TEST(Export, AFolderIsReadInOrderAndDamageNamed) {
    const tests::TemporaryFolder folder;
    const auto games = some_games<go::Go>(3);
    const auto first = std::span(games).first(2), second = std::span(games).subspan(2);
    engine::write_file(folder.path() / "000001.games", pack(first));
    engine::write_file(folder.path() / "000002.games", pack(second) + "\x28\xb5\x2f\xfd torn");
    std::vector<std::string> damage;
    const auto read = read_games(folder.path(), damage);
    EXPECT_EQ(read.size(), 3u);
    EXPECT_EQ(damage.size(), 1u);
    EXPECT_TRUE(holds_games(folder.path() / "000001.games"));
    EXPECT_NE(turns_text(read[0]).find('%'), std::string::npos);
}

TEST(Export, AnIllegalMoveIsAnError) {
    auto game = some_games<go::Go>(1)[0];
    game.turns[1].move = game.turns[0].move;
    EXPECT_THROW(to_text(game, 0), engine::Error);
    EXPECT_THROW(turns_text(game), engine::Error);
    const tests::TemporaryFolder folder;
    EXPECT_THROW(write_arrays(std::span(&game, 1), {}, folder.path() / "x.npz"), engine::Error);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Npz, HeadersAreAligned) {
    const auto header = npy_header({3, 17, 9, 9});
    EXPECT_EQ(header.size() % 64, 0u);
    EXPECT_NE(header.find("'shape': (3,17,9,9,)"), std::string::npos);
}

// What a command prints; empty when it fails.
std::string output_of(const std::string& command) {
    std::string text;
    FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe) return {};
    std::array<char, 256> buffer{};
    while (const auto size = std::fread(buffer.data(), 1, buffer.size(), pipe))
        text.append(buffer.data(), size);
    return ::pclose(pipe) == 0 ? text : "";
}

// A Python that has NumPy; empty without one.
std::string python() {
    for (const std::string name : {"python3", "/usr/bin/python3"})
        if (output_of(name + " -c 'import numpy; print(1)' 2>/dev/null") == "1\n") return name;
    return {};
}

constexpr std::string_view script = R"(
import sys, numpy
a = numpy.load(sys.argv[1])
p, pi, known = a["planes"], a["policy"], a["policy_known"]
print(*p.shape)
print(*pi.shape)
print(int(numpy.tensordot(p.sum(axis=(1, 2, 3)), numpy.arange(len(p)), 1)))
print(int(known.sum()), int((abs(pi.sum(axis=1) - known) < 1e-4).all()))
print(*a["value"].astype(int))
print(int(a["ownership"].sum()), int(2 * a["lead"][0]), int(a["score_known"].min()))
)";

std::string expected_of(const Game& record) {
    const auto& encoding = go::Go::encodings()[0];
    auto game = go::Go::from_text(record.start);
    std::vector<float> planes(encoding.shape(game).planes_size());
    double weighted = 0;
    int number = 0, known = 0, owned = 0;
    std::string values;
    for (const auto& turn : record.turns) {
        encoding.write(game, planes, {});
        weighted += number++ * std::accumulate(planes.begin(), planes.end(), 0.0);
        known += turn.share_count > 0;
        const int sign = game.to_play() == engine::Player::first ? 1 : -1;
        for (const int owner : record.owners) owned += sign * owner;
        const auto value = static_cast<int>(engine::value_for(game.to_play(), record.outcome));
        values += (values.empty() ? "" : " ") + std::to_string(value);
        game.play(turn.move);
    }
    std::ostringstream text;
    text << number << " 17 5 5\n"
         << number << " 26\n"
         << static_cast<long>(weighted) << '\n'
         << known << " 1\n"
         << values << '\n'
         << owned << ' ' << static_cast<int>(2 * record.lead) << " 1\n";
    return text.str();
}

TEST(Npz, NumPyReadsWhatWasWritten) {
    const auto interpreter = python();
    if (interpreter.empty()) GTEST_SKIP() << "no Python with NumPy (python3-numpy)";
    const tests::TemporaryFolder folder;
    const auto path = folder.path() / "games.npz";
    const auto games = some_games<go::Go>(1);
    const auto summary = write_arrays(games, {}, path);
    EXPECT_EQ(summary.positions, games[0].turns.size());
    engine::write_file(folder.path() / "check.py", script);
    EXPECT_EQ(
        output_of(interpreter + " " + (folder.path() / "check.py").string() + " " + path.string()),
        expected_of(games[0]));
}

TEST(Npz, BoardsAreOfOneSize) {
    const tests::TemporaryFolder folder;
    auto games = some_games<go::Go>(1);
    auto settings = training::small_settings();
    settings.size = 4;
    const auto smaller = training::games_of<go::Go>(settings, 1, training::even<go::Go>(), 1);
    games.push_back(smaller[0]);
    EXPECT_THROW(write_arrays(games, {}, folder.path() / "x.npz"), engine::Error);
    EXPECT_EQ(write_arrays(games, {"", 4}, folder.path() / "x.npz").games, 1u);
}

}  // namespace
}  // namespace selfplay::records
