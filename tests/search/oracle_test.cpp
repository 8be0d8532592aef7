// Games and networks together through the evaluator: what the networks say of positions, against
// what KataGo, lc0 and Leela Zero answer themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/chess/chess.h"
#include "engine/encoding.h"
#include "engine/go/go.h"
#include "search/network.h"
#include "search/network_evaluator.h"

namespace {

using Json = nlohmann::json;

std::filesystem::path shared_data() {
    if (const char* folder = std::getenv("SANBAN_SHARED"))
        return std::filesystem::path(folder) / "data";
    return std::filesystem::path(SANBAN_SOURCE_DIR) / "../shared/data";
}

std::vector<Json> lines_of(const std::filesystem::path& path) {
    std::vector<Json> lines;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);) lines.push_back(Json::parse(line));
    return lines;
}

// A network asked through the search's evaluator.
template <class G>
class Net {
   public:
    explicit Net(const std::filesystem::path& path)
        : source_(search::load_network(path.string(), nn::Precision::fp32)),
          evaluator_(source_.make_evaluator()) {}

    search::Evaluation answer(const G& game, int symmetry = 0) {
        source_.check(game);
        search::Evaluation answer;
        const auto moves = game.legal_moves();
        const search::Query<G> query{&game, &moves, symmetry, &answer};
        evaluator_->evaluate({&query, 1});
        return answer;
    }

    static std::map<std::string, double> policy(const G& game, const search::Evaluation& answer) {
        std::map<std::string, double> policy;
        std::size_t i = 0;
        for (const engine::Move move : game.legal_moves())
            policy[game.move_to_text(move)] = static_cast<double>(answer.priors.at(i++));
        return policy;
    }

   private:
    search::NetworkSource<G> source_;
    std::unique_ptr<search::Evaluator<G>> evaluator_;
};

go::Go game_of(const Json& line) {
    go::Go game(line["size"].get<int>(), go::Komi::from_points(line["komi"].get<double>()),
                go::rules_from_text(line["rules"].get<std::string>()));
    for (const auto& turn : line["moves"]) {
        const auto player = turn[0] == "b" ? engine::Player::first : engine::Player::second;
        game.set_to_play(player);
        game.play(*game.move_from_text(turn[1].get<std::string>()));
    }
    return game;
}

void check_katago(const char* network, const char* oracle) {
    const auto path = shared_data() / "nets" / network;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
    Net<go::Go> net(path);
    int number = 0;
    for (const auto& line : lines_of(shared_data() / "oracle" / oracle)) {
        SCOPED_TRACE(testing::Message() << oracle << " line " << ++number);
        const auto game = game_of(line);
        const auto answer = net.answer(game);
        const bool white = game.to_play() == engine::Player::second;
        EXPECT_NEAR(white ? answer.win : answer.loss, line["win"].get<double>(), 1e-4);
        EXPECT_NEAR(white ? answer.loss : answer.win, line["loss"].get<double>(), 1e-4);
        const double lead = answer[search::Figure::lead];
        EXPECT_NEAR(white ? lead : -lead, line["lead"].get<double>(), 2e-3);
        auto policy = net.policy(game, answer);
        EXPECT_NEAR(policy["pass"], line["pass"].get<double>(), 1e-4);
        double worst_policy = 0, worst_owner = 0;
        const int size = game.size();
        for (int at = 0; at < size * size; ++at) {
            const auto& expected = line["policy"][static_cast<std::size_t>(at)];
            const auto vertex = go::vertex({at % size, size - 1 - at / size});
            EXPECT_EQ(expected.is_null(), !policy.contains(vertex)) << vertex;
            if (!expected.is_null() && policy.contains(vertex))
                worst_policy =
                    std::max(worst_policy, std::abs(policy[vertex] - expected.get<double>()));
            // Ours go from the bottom row up.
            const int ours = (size - 1 - at / size) * size + at % size;
            const double owner = answer.owners.at(static_cast<std::size_t>(ours));
            worst_owner =
                std::max(worst_owner,
                         std::abs((white ? owner : -owner) -
                                  line["ownership"][static_cast<std::size_t>(at)].get<double>()));
        }
        EXPECT_LT(worst_policy, 1e-4);
        EXPECT_LT(worst_owner, 1e-3);
    }
    EXPECT_GT(number, 0);
}

TEST(Oracle, KatagoG170) {
    check_katago("g170-b6c96-s175395328-d26788732.bin.gz", "katago-g170-b6c96.jsonl");
}
TEST(Oracle, KatagoVersion9) { check_katago("katago-b2c16-v9.bin.gz", "katago-b2c16-v9.jsonl"); }
TEST(Oracle, KatagoNestedBottleneck) {
    check_katago("katago-b1c6nbt-v11.bin.gz", "katago-b1c6nbt-v11.jsonl");
}

TEST(Oracle, Maia) {
    const auto path = shared_data() / "nets" / "maia-1900.pb.gz";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
    Net<chess::Chess> net(path);
    int number = 0;
    for (const auto& line : lines_of(shared_data() / "oracle" / "lc0-maia-1900.jsonl")) {
        SCOPED_TRACE(testing::Message() << "line " << ++number);
        auto game = line.contains("fen") ? chess::Chess::from_text(line["fen"].get<std::string>())
                                         : chess::Chess();
        for (const auto& text : line["moves"]) {
            const auto move = game.move_from_text(text.get<std::string>());
            ASSERT_TRUE(move) << text;
            game.play(*move);
        }
        const auto answer = net.answer(game);
        EXPECT_NEAR(answer.value(), line["value"].get<double>(), 5e-4);
        auto policy = net.policy(game, answer);
        EXPECT_EQ(policy.size(), line["policy"].size());
        for (const auto& [text, percent] : line["policy"].items()) {
            const auto move = game.move_from_text(text);
            ASSERT_TRUE(move) << text;
            EXPECT_NEAR(policy[game.move_to_text(*move)], percent.get<double>() / 100, 5e-4)
                << text;
        }
    }
    EXPECT_GT(number, 0);
}

TEST(Oracle, LeelaZero) {
    const auto path = shared_data() / "nets" / "leela-zero-0k.txt.gz";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
    Net<go::Go> net(path);
    go::Go game(19);
    for (const auto vertex : {"Q16", "D4"}) game.play(*game.move_from_text(vertex));
    EXPECT_NEAR(net.answer(game).win, 0.576157, 1e-6);
}

}  // namespace
