// Random games under many rules, with another program's legal moves and final score.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "engine/go/go.h"
#include "engine/go/score.h"

using namespace go;

namespace {

std::string shared_folder() {
    const char* folder = std::getenv("SANBAN_SHARED");
    return folder ? folder : SANBAN_SOURCE_DIR "/../shared";
}

std::set<std::string> legal_vertices(const Go& game) {
    std::set<std::string> vertices;
    for (const Move move : game.legal_moves())
        if (move != Go::pass) vertices.insert(game.move_to_text(move));
    return vertices;
}

void replay(const nlohmann::json& record) {
    Go game(record["size"].get<int>(), Komi::from_points(record["komi"].get<double>()),
            rules_from_text(record["rules"].dump()));
    EXPECT_EQ(nlohmann::json::parse(to_json(game.rules())), record["rules"]);
    for (std::size_t turn = 0; turn < record["moves"].size(); ++turn) {
        ASSERT_EQ(legal_vertices(game), record["legal"][turn].get<std::set<std::string>>())
            << "turn " << turn << '\n'
            << diagram(game);
        const auto move = game.move_from_text(record["moves"][turn].get<std::string>());
        ASSERT_TRUE(move);
        game.play(*move);
    }
    EXPECT_EQ(score(game).text(), record["score"].get<std::string>()) << diagram(game);
}

}  // namespace

TEST(GoOracle, LegalMovesAndScoresOfRandomGames) {
    std::ifstream file(shared_folder() + "/data/oracle/go-rules.jsonl");
    if (!file) GTEST_SKIP() << "no shared data folder";
    int games = 0;
    for (std::string line; std::getline(file, line); ++games) {
        SCOPED_TRACE(games);
        replay(nlohmann::json::parse(line));
        if (HasFatalFailure()) return;
    }
    EXPECT_EQ(games, 60);
}
