// Mates that are known, by any moves in chess and by checks in shogi.
#include "search/mate.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/chess/chess.h"
#include "engine/chess/san.h"
#include "engine/shogi/movegen.h"
#include "engine/shogi/shogi.h"

namespace search {
namespace {

using Answer = MateResult::Answer;

template <engine::Game G>
struct Replay {
    G end;
    std::string text;  // ends with "illegal" where the line does
};

template <engine::Game G>
Replay<G> replay(const G& start, const MateResult& result) {
    Replay<G> line{start, ""};
    for (const auto move : result.line) {
        if (!line.text.empty()) line.text += ' ';
        if (!line.end.legal_moves().contains(move)) return {line.end, line.text + "illegal"};
        line.text += line.end.move_to_text(move);
        line.end.play(move);
    }
    return line;
}

template <engine::Game G>
std::string line_text(const G& start, const MateResult& result) {
    return replay(start, result).text;
}

// The line is legal, ends in mate, and has that many plies.
template <engine::Game G>
void expect_mate(const G& start, const MateResult& result, std::size_t plies) {
    const auto [end, text] = replay(start, result);
    EXPECT_EQ(result.answer, Answer::mate) << start.to_text();
    EXPECT_EQ(result.line.size(), plies) << start.to_text() << " " << text;
    EXPECT_EQ(text.find("illegal"), text.npos) << start.to_text() << " " << text;
    EXPECT_TRUE(end.legal_moves().empty() && end.position().in_check()) << text;
}

MateResult mate_in(int moves, const chess::Chess& game) {
    MateLimits limits;
    limits.plies = 2 * moves - 1;
    limits.nodes = 3'000'000;
    limits.table_bytes = std::size_t{16} << 20;
    return find_mate(game, limits);
}

TEST(Mate, InOneByCheckmate) {
    const auto game = chess::Chess::from_text("6k1/5ppp/8/8/8/8/8/R3K3 w - - 0 1");
    const auto result = mate_in(1, game);
    expect_mate(game, result, 1);
    EXPECT_EQ(line_text(game, result), "a1a8");
}

TEST(Mate, SmotheredInChecksOnly) {
    const auto game = chess::Chess::from_text("r5rk/6pp/7N/8/8/1Q6/8/6K1 w - - 0 1");
    MateLimits limits;
    limits.checks_only = true;
    expect_mate(game, find_mate(game, limits), 1);
    const auto legal = chess::Chess::from_text("r6k/6pp/8/6N1/8/1Q6/8/6K1 w - - 0 1");
    const auto result = find_mate(legal, limits);
    expect_mate(legal, result, 7);
    EXPECT_EQ(line_text(legal, result).substr(0, 9), "g5f7 h8g8");
}

TEST(Mate, QuietKeyMoves) {
    // Two rooks, a bare king, and a waiting move in between.
    const auto two = chess::Chess::from_text("7k/8/5K2/8/8/8/8/R7 w - - 0 1");
    const auto result = mate_in(2, two);
    EXPECT_EQ(result.answer, Answer::mate);
    expect_mate(two, result, 3);
    EXPECT_EQ(mate_in(1, two).answer, Answer::no_mate);
}

TEST(Mate, InThreeByAnyMoves) {
    // Morphy against the Duke and the Count, two moves before the end.
    const auto opera =
        chess::Chess::from_text("4kb1r/p2n1ppp/4q3/4p1B1/4P3/1Q6/PPP2PPP/2KR4 w k - 1 16");
    expect_mate(opera, mate_in(2, opera), 3);
    EXPECT_EQ(mate_in(1, opera).answer, Answer::no_mate);
    const auto ending = chess::Chess::from_text("8/8/8/8/8/2k5/1q6/K7 w - - 0 1");
    EXPECT_EQ(mate_in(3, ending).answer, Answer::no_mate);
    const auto queen = chess::Chess::from_text("7k/8/8/5K2/8/8/8/1Q6 w - - 0 1");
    const auto found = mate_in(4, queen);
    EXPECT_EQ(found.answer, Answer::mate);
    EXPECT_EQ(found.line.size() % 2, 1u);
}

TEST(Mate, BlackMatesToo) {
    const auto fool =
        chess::Chess::from_text("rnbqkbnr/pppp1ppp/8/4p3/6P1/5P2/PPPPP2P/RNBQKBNR b KQkq - 0 2");
    const auto result = mate_in(1, fool);
    EXPECT_EQ(line_text(fool, result), "d8h4");
}

TEST(Mate, StalemateIsNoMate) {
    const auto game = chess::Chess::from_text("7k/8/6K1/8/8/8/8/5Q2 w - - 0 1");
    const auto result = mate_in(1, game);
    EXPECT_EQ(result.answer, Answer::mate);
    // After Qf7 Black could not move; the mate is elsewhere.
    EXPECT_NE(line_text(game, result), "f1f7");
}

TEST(Mate, NoneIsSaidOnlyWhenProved) {
    const chess::Chess start;
    MateLimits limits;
    limits.checks_only = true;
    EXPECT_EQ(find_mate(start, limits).answer, Answer::no_mate) << "there is no check at all";
    EXPECT_EQ(mate_in(2, start).answer, Answer::no_mate);
    limits.checks_only = false;
    limits.nodes = 2000;
    const auto result = find_mate(start, limits);
    EXPECT_EQ(result.answer, Answer::unknown);
    EXPECT_LT(result.nodes, 2100u);
    EXPECT_TRUE(result.line.empty());
}

TEST(Mate, StopsWhenToldAndInTime) {
    const chess::Chess start;
    std::atomic<bool> stop = true;
    MateLimits limits;
    limits.stop = &stop;
    EXPECT_EQ(find_mate(start, limits).answer, Answer::unknown);
    MateLimits timed;
    timed.time = Milliseconds(30);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(find_mate(start, timed).answer, Answer::unknown);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

TEST(Mate, ASmallTableStillFindsIt) {
    const auto legal = chess::Chess::from_text("r6k/6pp/8/6N1/8/1Q6/8/6K1 w - - 0 1");
    MateLimits limits;
    limits.checks_only = true;
    limits.table_bytes = 1 << 12;
    expect_mate(legal, find_mate(legal, limits), 7);
}

std::vector<std::string> shared_problems(const std::string& name, int most) {
    const char* shared = std::getenv("SANBAN_SHARED");
    const std::filesystem::path folder = shared ? shared : SANBAN_SOURCE_DIR "/../shared";
    std::ifstream in(folder / "data/shogi/mate" / name);
    std::vector<std::string> lines;
    for (std::string line; static_cast<int>(lines.size()) < most && std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

// How many of the problems are solved in fewer plies than they say; none may need more.
int shorter_mates(std::size_t plies, int most, const MateLimits& limits) {
    int shorter = 0;
    for (const auto& sfen : shared_problems("mate-" + std::to_string(plies) + "-ply.txt", most)) {
        const auto game = shogi::Shogi::from_text(sfen);
        const auto result = find_mate(game, limits);
        expect_mate(game, result, std::min(plies, result.line.size()));
        shorter += result.line.size() < plies;
    }
    return shorter;
}

TEST(Mate, SharedShogiProblems) {
    if (shared_problems("mate-1-ply.txt", 1).empty())
        GTEST_SKIP() << "no ../shared/data/shogi/mate";
    const int most = std::getenv("SANBAN_SLOW") ? 2000 : 100;
    MateLimits limits;
    limits.checks_only = true;
    limits.table_bytes = std::size_t{4} << 20;
    EXPECT_EQ(shorter_mates(1, most, limits), 0);
    EXPECT_EQ(shorter_mates(3, most, limits), 0);
    // Two of the thousand are in 3: found by trying every line of legal moves, too.
    EXPECT_LE(shorter_mates(5, most, limits), 2);
    limits.plies = 1;
    for (const auto& sfen : shared_problems("no-mate-1-ply.txt", most))
        EXPECT_EQ(find_mate(shogi::Shogi::from_text(sfen), limits).answer, Answer::no_mate) << sfen;
}

}  // namespace
}  // namespace search
