// What the int16 executor costs in play: policies and values on real positions by real networks,
// against the fp32 reference, calibrated on other positions than those compared.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "../nn/maxima.h"
#include "engine/chess/chess.h"
#include "engine/encoding.h"
#include "engine/go/go.h"
#include "nn/load.h"
#include "nn/passes.h"
#include "nn/winograd/winograd.h"

namespace {

using Json = nlohmann::json;

std::filesystem::path shared_data() {
    if (const char* folder = std::getenv("SANBAN_SHARED"))
        return std::filesystem::path(folder) / "data";
    return std::filesystem::path(SANBAN_SOURCE_DIR) / "../shared/data";
}

std::vector<Json> lines_of(const char* oracle) {
    std::vector<Json> lines;
    std::ifstream in(shared_data() / "oracle" / oracle);
    for (std::string line; std::getline(in, line);) lines.push_back(Json::parse(line));
    return lines;
}

// Positions on the way to an oracle's, every third move.
template <class G>
struct Record {
    std::vector<G> positions;
    int moves = 0;

    void add(const G& game) {
        if (++moves % 3 == 0) positions.push_back(game);
    }
};

Record<go::Go> go_record(const Json& line) {
    go::Go game(line["size"].get<int>(), go::Komi::from_points(line["komi"].get<double>()),
                go::rules_from_text(line["rules"].get<std::string>()));
    Record<go::Go> record;
    for (const auto& turn : line["moves"]) {
        game.set_to_play(turn[0] == "b" ? engine::Player::first : engine::Player::second);
        game.play(*game.move_from_text(turn[1].get<std::string>()));
        record.add(game);
    }
    return record;
}

Record<chess::Chess> chess_record(const Json& line) {
    auto game = line.contains("fen") ? chess::Chess::from_text(line["fen"].get<std::string>())
                                     : chess::Chess();
    Record<chess::Chess> record;
    for (const auto& text : line["moves"]) {
        game.play(*game.move_from_text(text.get<std::string>()));
        record.add(game);
    }
    return record;
}

template <class G>
struct Inputs {
    std::vector<std::vector<float>> values{2};
    std::vector<G> games;

    void add(const engine::Encoding<G>& encoding, const G& game) {
        const auto shape = encoding.shape(game);
        std::vector<float> planes(shape.planes_size());
        std::vector<float> globals(static_cast<std::size_t>(shape.globals));
        encoding.write(game, planes, globals);
        values[0].insert(values[0].end(), planes.begin(), planes.end());
        values[1].insert(values[1].end(), globals.begin(), globals.end());
        games.push_back(game);
    }
};

using Outputs = std::map<std::string, std::vector<float>>;

Outputs run(const nn::Graph& graph, nn::Executor& executor, int board,
            const std::vector<std::vector<float>>& inputs, int positions) {
    const auto shapes = nn::infer_shapes(graph, board);
    std::vector<std::vector<float>> results;
    for (const auto& output : graph.outputs)
        results.emplace_back(shapes[static_cast<std::size_t>(output.node)].size(board * board) *
                             static_cast<std::size_t>(positions));
    const std::vector<std::span<const float>> in(inputs.begin(), inputs.end());
    const std::vector<std::span<float>> out(results.begin(), results.end());
    executor.run({positions, board, std::span(in).first(graph.input_nodes().size()), out});
    Outputs outputs;
    for (std::size_t i = 0; i < results.size(); ++i) outputs[graph.outputs[i].name] = results[i];
    return outputs;
}

std::vector<double> softmax(std::vector<double> logits) {
    double sum = 0;
    for (auto& x : logits) sum += x = std::exp(x);
    for (auto& x : logits) x /= sum;
    return logits;
}

template <class G>
std::vector<double> policy(const engine::Encoding<G>& encoding, const G& game,
                           const float* logits) {
    std::vector<double> legal;
    for (const engine::Move move : game.legal_moves())
        legal.push_back(logits[encoding.policy_index(game, move)]);
    return softmax(legal);
}

double value(const float* wdl) {
    const auto shares = softmax({wdl[0], wdl[1], wdl[2]});
    return shares[0] + 0.5 * shares[1];  // a winrate
}

struct Errors {
    double divergence = 0, value = 0;
};

template <class G>
Errors compare(const engine::Encoding<G>& encoding, const std::vector<G>& games,
               const Outputs& expected, const Outputs& found) {
    Errors errors;
    const auto size = expected.at("policy").size() / games.size();
    for (std::size_t i = 0; i < games.size(); ++i) {
        const auto p = policy(encoding, games[i], expected.at("policy").data() + i * size);
        const auto q = policy(encoding, games[i], found.at("policy").data() + i * size);
        for (std::size_t move = 0; move < p.size(); ++move)
            errors.divergence += p[move] * std::log(p[move] / q[move]);
        errors.value += std::abs(value(expected.at("wdl").data() + 3 * i) -
                                 value(found.at("wdl").data() + 3 * i));
    }
    errors.divergence /= static_cast<double>(games.size());
    errors.value /= static_cast<double>(games.size());
    return errors;
}

// Every second game calibrates, the others are compared.
template <class G>
void check(const char* network, const std::vector<Record<G>>& records, int board) {
    if (!nn::winograd::available()) GTEST_SKIP() << "this processor has no AVX2";
    const auto graph = nn::load(shared_data() / "nets" / network);
    const auto optimised = nn::optimise(graph);
    const auto& encoding = engine::find_encoding<G>(graph.facts.encoding);
    Inputs<G> seen, asked;
    for (std::size_t i = 0; i < records.size(); ++i)
        for (const auto& game : records[i].positions) (i % 2 ? asked : seen).add(encoding, game);
    ASSERT_GT(asked.games.size(), 3u);
    seen.values.resize(graph.input_nodes().size());
    asked.values.resize(graph.input_nodes().size());
    ASSERT_TRUE(nn::winograd::serves(optimised, board));
    const auto maxima =
        nn::maxima_of(optimised, board, seen.values, static_cast<int>(seen.games.size()));
    const auto executor = nn::winograd::Program(optimised, maxima, board).make_executor();
    const auto reference = nn::eigen::Program(graph).make_executor();
    const int count = static_cast<int>(asked.games.size());
    const auto errors =
        compare(encoding, asked.games, run(graph, *reference, board, asked.values, count),
                run(graph, *executor, board, asked.values, count));
    std::cout << network << " board " << board << ": " << count << " positions, policy divergence "
              << errors.divergence << ", winrate error " << errors.value << '\n';
    EXPECT_LT(errors.divergence, 0.002);
    EXPECT_LT(errors.value, 0.004);
}

void check_go(const char* network, const char* oracle, int board) {
    if (!std::filesystem::exists(shared_data() / "nets" / network))
        GTEST_SKIP() << "the shared data is not there";
    std::vector<Record<go::Go>> records;
    for (const auto& line : lines_of(oracle))
        if (line["size"] == board) records.push_back(go_record(line));
    check(network, records, board);
}

constexpr auto g170 = "g170-b6c96-s175395328-d26788732.bin.gz";

TEST(WinogradOracle, G170On9x9) { check_go(g170, "katago-g170-b6c96.jsonl", 9); }
TEST(WinogradOracle, G170On13x13) { check_go(g170, "katago-g170-b6c96.jsonl", 13); }
TEST(WinogradOracle, G170On19x19) { check_go(g170, "katago-g170-b6c96.jsonl", 19); }

TEST(WinogradOracle, Maia) {
    if (!std::filesystem::exists(shared_data() / "nets" / "maia-1900.pb.gz"))
        GTEST_SKIP() << "the shared data is not there";
    std::vector<Record<chess::Chess>> records;
    for (const auto& line : lines_of("lc0-maia-1900.jsonl")) records.push_back(chess_record(line));
    check("maia-1900.pb.gz", records, 8);
}

}  // namespace
