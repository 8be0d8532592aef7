// Games and networks together: positions encoded by the games, computed by the reference executor,
// against what KataGo, lc0 and Leela Zero answer themselves.
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
#include "nn/eigen/executor.h"
#include "nn/load.h"

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

using Answers = std::map<std::string, std::vector<float>>;

// A network with the encoding that its file names.
template <class G>
class Net {
   public:
    explicit Net(const std::filesystem::path& path)
        : graph_(nn::load(path)),
          encoding_(engine::find_encoding<G>(graph_.facts.encoding)),
          executor_(nn::eigen::Program(graph_).make_executor()) {}

    Answers answer(const G& game) {
        const auto shape = encoding_.shape(game);
        std::vector<float> planes(shape.planes_size(), -1);
        std::vector<float> globals(static_cast<std::size_t>(shape.globals), -1);
        encoding_.write(game, planes, globals);
        const auto shapes = nn::infer_shapes(graph_, shape.height);
        std::vector<std::vector<float>> results;
        for (const auto& output : graph_.outputs)
            results.emplace_back(
                shapes[static_cast<std::size_t>(output.node)].size(shape.height * shape.width));
        const std::vector<std::span<const float>> in = {planes, globals};
        const std::vector<std::span<float>> out(results.begin(), results.end());
        executor_->run({1, shape.height, std::span(in).first(graph_.input_nodes().size()), out});
        Answers answers;
        for (std::size_t i = 0; i < results.size(); ++i)
            answers[graph_.outputs[i].name] = results[i];
        return answers;
    }

    // Over the legal moves.
    std::map<std::string, double> policy(const G& game, const Answers& answers) const {
        std::map<std::string, double> policy;
        double sum = 0;
        for (const engine::Move move : game.legal_moves()) {
            const auto index = static_cast<std::size_t>(encoding_.policy_index(game, move));
            sum += policy[game.move_to_text(move)] = std::exp(answers.at("policy")[index]);
        }
        for (auto& [move, share] : policy) share /= sum;
        return policy;
    }

   private:
    nn::Graph graph_;
    engine::Encoding<G> encoding_;
    std::unique_ptr<nn::Executor> executor_;
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

// Win, no result, loss for the mover.
std::array<double, 3> values_of(const go::Go& game, const Answers& answers) {
    std::array<double, 3> values{};
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += values[i] = std::exp(answers.at("wdl")[i]);
    const bool no_result_possible =
        game.rules().ko == go::Ko::simple || game.rules().scoring == go::Scoring::territory;
    if (!no_result_possible) sum -= std::exchange(values[1], 0);
    for (auto& value : values) value /= sum;
    return values;
}

void check_katago(const char* network, const char* oracle) {
    const auto path = shared_data() / "nets" / network;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
    Net<go::Go> net(path);
    int number = 0;
    for (const auto& line : lines_of(shared_data() / "oracle" / oracle)) {
        SCOPED_TRACE(testing::Message() << oracle << " line " << ++number);
        const auto game = game_of(line);
        const auto answers = net.answer(game);
        const auto values = values_of(game, answers);
        const bool white = game.to_play() == engine::Player::second;
        EXPECT_NEAR(values[white ? 0 : 2], line["win"].get<double>(), 1e-4);
        EXPECT_NEAR(values[white ? 2 : 0], line["loss"].get<double>(), 1e-4);
        const double lead = answers.at("lead")[0] * (1 - values[1]);
        EXPECT_NEAR(white ? lead : -lead, line["lead"].get<double>(), 2e-3);
        auto policy = net.policy(game, answers);
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
            const double owner = answers.at("ownership")[static_cast<std::size_t>(at)];
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
        const auto answers = net.answer(game);
        const auto& logits = answers.at("wdl");
        const double win = std::exp(logits[0]), draw = std::exp(logits[1]),
                     loss = std::exp(logits[2]);
        EXPECT_NEAR((win - loss) / (win + draw + loss), line["value"].get<double>(), 5e-4);
        auto policy = net.policy(game, answers);
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
    EXPECT_NEAR((1 + net.answer(game).at("value")[0]) / 2, 0.576157, 1e-5);
}

}  // namespace
