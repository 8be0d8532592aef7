#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/files.h"
#include "engine/chess/pgn.h"
#include "engine/shogi/csa.h"
#include "selfplay/make_player.h"
#include "selfplay/match.h"
#include "selfplay/time_text.h"
#include "tests/selfplay/fake_engine.h"

namespace selfplay {
namespace {

using namespace std::chrono_literals;

// An engine for chess or shogi that knows one game by heart: it is given the protocol, all moves of
// the game separated by commas, and a file to which it writes what it is told.
constexpr std::string_view script = R"(#!/bin/bash
protocol=$1 count=0
IFS=, read -ra game <<<"$2"
[ "$protocol" = gnushogi ] && echo 'GNU Shogi 0.0'
while read -r line; do
    echo "$line" >>"$3"
    case $line in
        uci) printf 'id name by heart\noption name UCI_Chess960 type check default false\nuciok\n' ;;
        usi) printf 'id name by heart\nusiok\n' ;;
        isready) echo readyok ;;
        protover*) printf 'feature ping=1 setboard=1 usermove=1 myname="by heart"\nfeature done=1\n' ;;
        ping*) echo "pong ${line#ping }" ;;
        new) count=0 ;;
        usermove*|[1-9]*|[A-Z]\**) count=$((count + 1)) ;;
        position*moves*) moves=(${line##*moves}); count=${#moves[@]} ;;
        position*) count=0 ;;
        go*)
            move=${game[count]}
            case $protocol in
                uci|usi) printf 'info depth 1 score cp %s nodes 9\n' "${SCORE:--20}"
                         echo "bestmove $move" ;;
                xboard) printf '1 -20 3 9 x\nmove %s\n' "$move" ;;
                gnushogi) echo "1. ... $move 299000" ;;
            esac
            count=$((count + 1)) ;;
        quit) exit ;;
    esac
done
)";

constexpr std::string_view fools_mate = "f2f3,e7e5,g2g4,d8h4";

class BoardMatch : public ::testing::Test {
   protected:
    BoardMatch() { std::ofstream(folder_.path() / "engine.sh") << script; }

    std::string command(const std::string& protocol, std::string_view moves) const {
        return "bash " + (folder_.path() / "engine.sh").string() + ' ' + protocol + ' ' +
               std::string(moves) + ' ' + told_path().string();
    }
    MatchSettings settings(const std::string& game, const std::string& first,
                           const std::string& second, std::string_view moves) const {
        MatchSettings settings;
        settings.game = game;
        settings.games = 2;
        settings.out = folder_.path() / "out";
        settings.players[0].protocol = first;
        settings.players[1].protocol = second;
        for (auto& player : settings.players) player.command = command(player.protocol, moves);
        settings.rules.time = {time_from_text("fischer 10 1"), time_from_text("fischer 10 1")};
        return settings;
    }
    static std::vector<GameRecord> play(const MatchSettings& settings) {
        std::vector<GameRecord> records;
        Match match(settings, [&](int engine, std::stop_token token) {
            return make_player(settings.players[static_cast<std::size_t>(engine)], settings.game,
                               10s, std::move(token));
        });
        match.run({},
                  [&](const GameRecord& record, const Standing&) { records.push_back(record); });
        return records;
    }
    std::filesystem::path told_path() const { return folder_.path() / "told.txt"; }
    std::string told() const { return engine::read_file(told_path()); }
    const std::filesystem::path& folder() const { return folder_.path(); }

   private:
    tests::TemporaryFolder folder_;
};

// Our own reader finds every game again.
void expect_pgn_tells(const std::filesystem::path& path, const std::vector<GameRecord>& records) {
    const auto file = chess::pgn::open(path);
    chess::pgn::Reader reader(*file);
    for (const auto& record : records) {
        const auto game = reader.next();
        ASSERT_TRUE(game);
        EXPECT_EQ(game->tag("White"), record.name_of(engine::Player::first));
        EXPECT_EQ(game->tag("Round"), std::to_string(record.index + 1));
        auto position = game->start;
        std::vector<std::string> moves;
        for (const auto move : game->main_line()) {
            moves.push_back(position.move_to_text(move));
            position.play(move);
        }
        EXPECT_EQ(moves, record.moves);
        EXPECT_EQ(game->result, record.outcome == engine::Outcome::second_wins ? "0-1" : "1-0");
    }
    EXPECT_FALSE(reader.next());
}

void expect_csa_tells(const std::string& text, const std::vector<GameRecord>& records) {
    const auto games = shogi::csa::parse(text);
    ASSERT_EQ(games.size(), records.size());
    for (std::size_t i = 0; i < games.size(); ++i) {
        EXPECT_EQ(games[i].black, records[i].name_of(engine::Player::first));
        EXPECT_EQ(games[i].outcome(), records[i].outcome);
        auto position = games[i].start;
        std::vector<std::string> moves;
        for (const auto move : games[i].main_line()) {
            moves.push_back(position.move_to_text(move));
            position.play(move);
        }
        EXPECT_EQ(moves, records[i].moves);
    }
}

TEST_F(BoardMatch, ChessOverUciAndXboard) {
    const auto set = settings("chess", "uci", "xboard", fools_mate);
    const auto records = play(set);
    ASSERT_EQ(records.size(), 2u);
    for (const auto& record : records) {
        EXPECT_EQ(record.reason, "checkmate") << record.detail;
        EXPECT_EQ(record.outcome, engine::Outcome::second_wins);
        EXPECT_EQ(record.moves, (std::vector<std::string>{"f2f3", "e7e5", "g2g4", "d8h4"}));
    }
    EXPECT_NE(engine::read_file(set.out / "games.pgn").find("1. f3 e5 2. g4 Qh4# 0-1"),
              std::string::npos);
    expect_pgn_tells(set.out / "games.pgn", records);
    EXPECT_NE(told().find("go wtime 10000 btime 10000 winc 1000 binc 1000\n"), std::string::npos)
        << told();
    EXPECT_NE(told().find("level 0 0:10 1\n"), std::string::npos);
    EXPECT_NE(told().find("time 1000\notim 1000\ngo\n"), std::string::npos);
    EXPECT_NE(told().find("usermove f2f3\n"), std::string::npos);
}

TEST_F(BoardMatch, AnIllegalMoveIsOurRulesToJudge) {
    auto set = settings("chess", "uci", "uci", "f2f3,e7e5,g2g4,d8h5");
    const auto records = play(set);
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[0].reason, "illegal move");
    EXPECT_EQ(records[0].winner(), 0);
    EXPECT_EQ(records[1].winner(), 1);
}

TEST_F(BoardMatch, FixedTimesAndNodesInUci) {
    auto set = settings("chess", "uci", "uci", fools_mate);
    set.rules.time[0] = time_from_text("move 2");
    set.players[1].visits = 50;
    set.rules.time[1] = {};
    set.games = 1;
    EXPECT_EQ(play(set).at(0).reason, "checkmate");
    EXPECT_NE(told().find("go movetime 2000\n"), std::string::npos);
    EXPECT_NE(told().find("go nodes 50\n"), std::string::npos);
}

TEST_F(BoardMatch, OpeningsFromEpd) {
    const auto book = folder() / "book.epd";
    // A finished game and an impossible position are left out.
    engine::write_file(book,
                       "rnb1kbnr/pppp1ppp/8/4p3/6Pq/5P2/PPPPP2P/RNBQKBNR w KQkq - id \"over\";\n"
                       "8/8/8/8/8/8/8/8 w - - id \"empty\";\n"
                       "rnbqkbnr/pppp1ppp/8/4p3/6P1/5P2/PPPPP2P/RNBQKBNR b KQkq - id \"mate\";\n");
    auto set = settings("chess", "uci", "xboard", "d8h4");
    set.openings.file = book;
    const auto records = play(set);
    ASSERT_EQ(records.size(), 2u);
    for (const auto& record : records) {
        EXPECT_EQ(record.reason, "checkmate") << record.detail;
        EXPECT_EQ(record.moves.size(), 1u);
    }
    expect_pgn_tells(set.out / "games.pgn", records);
    EXPECT_NE(told().find("setboard rnbqkbnr/pppp1ppp/8/4p3/6P1/5P2/PPPPP2P/RNBQKBNR b KQkq - 0 1"),
              std::string::npos);
}

TEST_F(BoardMatch, AStoppedMatchGoesOn) {
    auto set = settings("chess", "uci", "uci", fools_mate);
    EXPECT_EQ(play(set).size(), 2u);
    set.games = 4;
    const auto rest = play(set);
    ASSERT_EQ(rest.size(), 2u);
    EXPECT_EQ(rest[0].index, 2);
    std::istringstream pgn(engine::read_file(set.out / "games.pgn"));
    chess::pgn::Reader reader(pgn);
    int games = 0;
    while (const auto game = reader.next()) {
        ++games;
        EXPECT_EQ(game->main_line().size(), 4u);
    }
    EXPECT_EQ(games, 4);
}

TEST_F(BoardMatch, OpeningsFromPgn) {
    const auto book = folder() / "book.pgn";
    engine::write_file(book, "[White \"a\"]\n\n1. f3 e5 2. g4 Qh4# 0-1\n\n1. Qh5 *\n");
    auto set = settings("chess", "uci", "uci", fools_mate);
    set.openings.file = book;
    set.openings.plies = 3;
    const auto records = play(set);
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[1].opening_moves, 3);
    EXPECT_EQ(records[1].reason, "checkmate");
}

TEST_F(BoardMatch, AdjudicationsFollowBothEngines) {
    auto set = settings("chess", "uci", "uci", "g1f3,g8f6,b1c3,b8c6,e2e4,e7e5");
    set.rules.adjudication.draw_moves = 2;
    set.rules.adjudication.draw_score = 20;
    set.rules.adjudication.draw_from = 2;
    set.games = 1;
    auto records = play(set);
    EXPECT_EQ(records.at(0).reason, "adjudication");
    EXPECT_EQ(records.at(0).winner(), -1);
    EXPECT_EQ(records.at(0).moves.size(), 4u);

    set.out.clear();
    set.rules.adjudication = {};
    set.rules.adjudication.resign_moves = 3;
    set.rules.adjudication.resign_score = 20;
    records = play(set);
    EXPECT_EQ(records.at(0).reason, "adjudication");
    EXPECT_EQ(records.at(0).winner(), 1);
    EXPECT_EQ(records.at(0).moves.size(), 5u);
}

TEST_F(BoardMatch, ShogiOverUsiAndGnushogi) {
    // Bishops are exchanged and dropped; then the limit is reached.
    auto set = settings("shogi", "usi", "gnushogi", "7g7f,3c3d,8h2b+,3a2b,B*4e,B*8e");
    set.rules.time = {time_from_text("byoyomi 10 5 1"), time_from_text("byoyomi 10 5 1")};
    set.rules.move_limit = 6;
    const auto records = play(set);
    ASSERT_EQ(records.size(), 2u);
    for (const auto& record : records) {
        EXPECT_EQ(record.reason, "move limit") << record.detail;
        EXPECT_EQ(record.moves.size(), 6u);
    }
    EXPECT_NE(told().find("go btime 10000 wtime 10000 byoyomi 5000\n"), std::string::npos);
    EXPECT_NE(told().find("position startpos moves 7g7f 3c3d 8h2b+ 3a2b\n"), std::string::npos);
    EXPECT_NE(told().find("gameover draw\n"), std::string::npos);
    const auto csa = engine::read_file(set.out / "games.csa");
    for (const auto* line : {"PI\n+\n", "+7776FU\nT0\n-3334FU\n", "+8822UM\n", "-3122GI\n",
                             "+0045KA\n", "-0085KA\n", "%MAX_MOVES\n", "/\nV2.2\n"})
        EXPECT_NE(csa.find(line), std::string::npos) << line << csa;
    expect_csa_tells(csa, records);
}

TEST_F(BoardMatch, OpeningsFromSfen) {
    const auto book = folder() / "book.sfen";
    engine::write_file(book, "startpos moves 7g7f 3c3d 2g2f\nstartpos moves 7g7e\n");
    auto set = settings("shogi", "usi", "usi", "7g7f,3c3d,2g2f,8c8d");
    set.openings.file = book;
    set.rules.move_limit = 4;
    const auto records = play(set);
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[1].opening_moves, 3);
    EXPECT_EQ(records[1].moves.back(), "8c8d");
}

TEST_F(BoardMatch, OurSearchPlaysChessInProcess) {
    auto set = settings("chess", "internal", "internal", fools_mate);
    for (auto& player : set.players) {
        player.command = "internal memory=16";
        player.visits = 3;
    }
    set.rules.move_limit = 12;
    const auto records = play(set);
    ASSERT_EQ(records.size(), 2u);
    for (const auto& record : records) EXPECT_FALSE(record.by_fault()) << record.detail;
}

}  // namespace
}  // namespace selfplay
