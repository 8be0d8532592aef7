// Games and networks together through the evaluator: what the networks say of positions, against
// what KataGo, lc0 and Leela Zero answer themselves.
#include "tests/search/oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "engine/games.h"
#include "search/load_network.h"

namespace {

using Json = nlohmann::json;

// A network asked through the search's evaluator.
template <class G>
class Net {
   public:
    explicit Net(const std::filesystem::path& path)
        : source_(search::load_network(path.string(), nn::Precision::fp32, G())),
          evaluator_(source_->make_evaluator()) {}

    search::Evaluation answer(const G& game, int symmetry = 0) {
        source_->check(game);
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
    std::shared_ptr<const search::NetworkSource<G>> source_;
    std::unique_ptr<search::Evaluator<G>> evaluator_;
};

void check_katago(const char* network, const char* answers) {
    const auto path = oracle::network(network);
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
    Net<go::Go> net(path);
    int number = 0;
    for (const auto& line : oracle::lines_of(answers)) {
        SCOPED_TRACE(testing::Message() << answers << " line " << ++number);
        const auto game = oracle::go_positions(line).back();
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
    const auto path = oracle::network("maia-1900.pb.gz");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
    Net<chess::Chess> net(path);
    int number = 0;
    for (const auto& line : oracle::lines_of("lc0-maia-1900.jsonl")) {
        SCOPED_TRACE(testing::Message() << "line " << ++number);
        const auto game = oracle::chess_positions(line).back();
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
    const auto path = oracle::network("leela-zero-0k.txt.gz");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
    Net<go::Go> net(path);
    go::Go game(19);
    for (const auto vertex : {"Q16", "D4"}) game.play(*game.move_from_text(vertex));
    EXPECT_NEAR(net.answer(game).win, 0.576157, 1e-6);
}

}  // namespace
