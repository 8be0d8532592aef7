// Foreign network files: small ones written here, and the real ones of the shared folder against
// the answers of their own programs, where the inputs can be written down by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

#include "engine/base/error.h"
#include "nn/eigen/executor.h"
#include "nn/katago.h"
#include "nn/lc0.h"
#include "nn/lc0.pb.h"
#include "nn/leela_zero.h"
#include "nn/load.h"
#include "nn/safetensors.h"
#include "shared.h"

namespace nn {
namespace {

using Answers = std::map<std::string, std::vector<float>>;

Answers answers_of(const Graph& graph, int board, const std::vector<std::vector<float>>& inputs) {
    const auto shapes = infer_shapes(graph, board);
    std::vector<std::vector<float>> results;
    for (const auto& output : graph.outputs)
        results.emplace_back(shapes[static_cast<std::size_t>(output.node)].size(board * board));
    const std::vector<std::span<const float>> in(inputs.begin(), inputs.end());
    const std::vector<std::span<float>> out(results.begin(), results.end());
    eigen::Program(graph).make_executor()->run({1, board, in, out});
    Answers answers;
    for (std::size_t i = 0; i < results.size(); ++i) answers[graph.outputs[i].name] = results[i];
    return answers;
}

std::vector<float> softmax(std::vector<float> logits) {
    float sum = 0;
    for (auto& x : logits) sum += x = std::exp(x);
    for (auto& x : logits) x /= sum;
    return logits;
}

std::string message_of(const std::string& bytes) {
    try {
        graph_from_bytes(bytes);
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "";
}

std::filesystem::path network_file(const char* name) { return shared_data() / "nets" / name; }

constexpr auto g170 = "g170-b6c96-s175395328-d26788732.bin.gz";

// --- KataGo

struct Katago {
    std::ostringstream out;
    int version;
    int numbers = 0;

    void values(int count) {
        for (int i = 0; i < count; ++i) out << (numbers++ * 7919 % 201 - 100) / 200.0 << ' ';
        out << '\n';
    }
    void positive(int count) {
        for (int i = 0; i < count; ++i) out << 1 + i << ' ';
        out << '\n';
    }
    void convolution(int side, int in, int outs) {
        out << "conv " << side << ' ' << side << ' ' << in << ' ' << outs << " 1 1\n";
        values(side * side * in * outs);
    }
    void matrix(int in, int outs) {
        out << "matrix " << in << ' ' << outs << '\n';
        values(in * outs);
    }
    void bias(int count) {
        out << "bias " << count << '\n';
        values(count);
    }
    void norm(int count) {
        out << "norm " << count << " 0.001 0 1\n";
        values(count);
        positive(count);
        values(count);
        out << (version >= 11 ? "act ACTIVATION_MISH\n" : "act\n");
    }
    void activation() { out << (version >= 11 ? "act ACTIVATION_MISH\n" : "act\n"); }
    void ordinary(int channels, int middle) {
        out << "ordinary_block block\n";
        norm(channels);
        convolution(3, channels, middle);
        norm(middle);
        convolution(3, middle, channels);
    }
    void pooling(int channels) {
        out << "gpool_block block\n";
        norm(channels);
        convolution(3, channels, 3);
        convolution(3, channels, 2);
        norm(2);
        matrix(6, 3);
        norm(3);
        convolution(3, 3, channels);
    }
    void nested(int channels) {
        out << "nested_bottleneck_block block 2\n";
        norm(channels);
        convolution(1, channels, 2);
        ordinary(2, 2);
        ordinary(2, 2);
        norm(2);
        convolution(1, 2, channels);
    }

    std::string file() {
        out << "small " << version << " 22 19\n";
        if (version >= 13) out << "20 20 20 20 40 0.25 30\n";
        if (version >= 15) out << "0 1 0 0 0 0 0 0\n";
        out << "trunk 3 4 4 3 3 2\n";
        if (version >= 15) out << "0 0 0 0 0 0\n";
        convolution(3, 22, 4);
        matrix(19, 4);
        ordinary(4, 4);
        pooling(4);
        nested(4);
        norm(4);
        heads();
        return out.str();
    }
    void heads() {
        const int policies = version >= 16 ? 4 : version >= 12 ? 2 : 1;
        out << "policyhead\n";
        convolution(1, 4, 3);
        convolution(1, 4, 2);
        norm(2);
        matrix(6, 3);
        norm(3);
        convolution(1, 3, policies);
        matrix(6, version >= 15 ? 3 : policies);
        if (version >= 15) {
            bias(3);
            activation();
            matrix(3, policies);
        }
        out << "valuehead\n";
        convolution(1, 4, 3);
        norm(3);
        matrix(9, 5);
        bias(5);
        activation();
        matrix(5, 3);
        bias(3);
        matrix(5, version >= 9 ? 6 : 4);
        bias(version >= 9 ? 6 : 4);
        convolution(1, 3, 1);
    }
};

std::string katago_text(int version) {
    Katago writer;
    writer.version = version;
    return writer.file();
}

TEST(Katago, ReadsEveryVersionFrom8To16) {
    for (int version = 8; version <= 16; ++version) {
        const auto graph = graph_from_bytes(katago_text(version));
        EXPECT_EQ(graph.facts.blocks, 3);
        EXPECT_EQ(graph.facts.channels, 4);
        EXPECT_EQ(graph.facts.encoding, "katago-v7");
        EXPECT_EQ(graph.output("score_error").has_value(), version >= 9);
        for (const int board : {7, 9, 19}) {
            const auto points = static_cast<std::size_t>(board * board);
            const auto answers = answers_of(
                graph, board, {std::vector<float>(22 * points, 0.3f), std::vector<float>(19, 1)});
            EXPECT_EQ(answers.at("policy").size(), points + 1);
            EXPECT_EQ(answers.at("ownership").size(), points);
            EXPECT_EQ(answers.at("wdl").size(), 3u);
            for (const auto& [name, values] : answers)
                for (const float value : values) ASSERT_TRUE(std::isfinite(value)) << name;
        }
    }
}

TEST(Katago, ShortTermErrorsByVersion) {
    const std::vector<std::vector<float>> inputs = {std::vector<float>(22 * 81, 0.3f),
                                                    std::vector<float>(19, 1)};
    // One network but for the version: its raw output r, seen through each version's formula.
    const auto error = [&](int version) {
        return answers_of(graph_from_bytes(katago_text(version)), 9, inputs).at("winloss_error")[0];
    };
    EXPECT_FLOAT_EQ(error(10) * error(10), 0.25f * error(9));
    EXPECT_GT(error(14), 0);
}

TEST(Katago, RefusesByName) {
    auto old = katago_text(8);
    EXPECT_EQ(message_of("small 7 22 16\n"),
              "expected KataGo's format version 8 to 16, found version 7 (inputs older than V7)");
    EXPECT_EQ(message_of("small 17 22 19\n"),
              "expected KataGo's format version 8 to 16, found version 17 (transformers)");
    EXPECT_EQ(message_of("small 8 13 12\n"), "expected 22 planes, found 13");
    auto human = katago_text(15);
    human[human.find("\n0 1 0 0 0 0 0 0") + 1] = '1';
    EXPECT_EQ(message_of(human),
              "expected no metadata encoder, found one (a human-imitating network)");
    auto attention = katago_text(16);
    attention.replace(attention.find("ordinary_block"), 14, "transformer_attention_block");
    EXPECT_EQ(message_of(attention),
              "expected a convolutional network, found a transformer_attention_block (a "
              "transformer)");
}

TEST(Katago, RefusesCutsAndNonsense) {
    const auto text = katago_text(9);
    for (std::size_t size = 1; size < text.size(); size += 1 + size / 12)
        EXPECT_NE(message_of(text.substr(0, size)), "") << size;
    auto changed = text;
    changed.replace(text.find("conv 3 3 22"), 11, "conv 3 3 23");
    EXPECT_EQ(message_of(changed), "conv: expected 22 input channels, found 23");
    changed = text;
    changed.replace(text.find("conv 3 3 22 4"), 13, "conv 9 9 22 16384");
    EXPECT_NE(message_of(changed).find("expected 29196288 floats"), std::string::npos)
        << message_of(changed);
    changed = text;
    changed.replace(text.find("-0."), 3, "nan");
    EXPECT_NE(message_of(changed), "");
}

TEST(Katago, ReadsTheRealFiles) {
    const std::map<std::string, std::tuple<int, int, int>> expected = {
        {g170, {6, 96, 1031435}},
        {"katago-b2c16-v9.bin.gz", {2, 16, 18817}},
        {"katago-b1c6nbt-v11.bin.gz", {1, 6, 2391}}};
    for (const auto& [name, facts] : expected) {
        const auto path = network_file(name.c_str());
        if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
        const auto graph = load(path);
        EXPECT_EQ(graph.facts.blocks, std::get<0>(facts)) << name;
        EXPECT_EQ(graph.facts.channels, std::get<1>(facts)) << name;
        EXPECT_EQ(parameter_count(graph), std::get<2>(facts)) << name;
        EXPECT_EQ(graph_from_bytes(to_safetensors(graph)), graph) << name;
    }
}

// FORMATS.md 5.1 A: 9x9, empty, Tromp-Taylor, komi 7, Black to move.
TEST(Katago, AnswersAsKatagoDoesOnTheEmptyBoard) {
    if (!std::filesystem::exists(network_file(g170)))
        GTEST_SKIP() << "the shared data is not there";
    const auto graph = load(network_file(g170));
    std::vector<float> planes(22 * 81, 0), globals(19, 0);
    std::fill_n(planes.begin(), 81, 1.0f);
    globals[5] = -0.35f;
    globals[6] = globals[8] = 1;
    globals[7] = 0.5f;
    const auto answers = answers_of(graph, 9, {planes, globals});
    EXPECT_NEAR(answers.at("policy")[40], 2.2832411f, 1e-5);
    EXPECT_NEAR(answers.at("policy")[81], -4.3851368f, 1e-5);
    EXPECT_NEAR(answers.at("wdl")[0], 3.0051658f, 1e-5);
    EXPECT_NEAR(answers.at("wdl")[2], 2.9590360f, 1e-5);
    EXPECT_NEAR(answers.at("score")[0], 20 * 0.0251272f, 1e-4);
    EXPECT_NEAR(answers.at("lead")[0], 20 * 0.0317366f, 1e-4);
    EXPECT_NEAR(answers.at("score_deviation")[0], 20 * std::log1p(std::exp(0.0773907)), 1e-3);
    EXPECT_NEAR(answers.at("ownership")[40], 0.3537095f, 1e-5);
    EXPECT_NEAR(answers.at("ownership")[0], 0.0276230f, 1e-5);
    const auto policy = softmax(answers.at("policy"));
    EXPECT_NEAR(policy[40], 0.260592f, 1e-5);
    EXPECT_NEAR(policy[31], 0.119067f, 1e-5);
    EXPECT_NEAR(policy[81], 0.000331f, 1e-6);
}

// FORMATS.md 5.1 D: 19x19, empty, Chinese, komi 7.5, Black to move.
TEST(Katago, AnswersAsKatagoDoesOn19x19) {
    if (!std::filesystem::exists(network_file(g170)))
        GTEST_SKIP() << "the shared data is not there";
    std::vector<float> planes(22 * 361, 0), globals(19, 0);
    std::fill_n(planes.begin(), 361, 1.0f);
    globals[5] = -7.5f / 20;
    globals[18] = -0.5f;
    const auto answers = answers_of(load(network_file(g170)), 19, {planes, globals});
    const auto value = softmax(answers.at("wdl"));
    EXPECT_NEAR(value[2], 0.524470f, 1e-5);
    EXPECT_NEAR(value[0], 0.475457f, 1e-5);
    EXPECT_NEAR(value[1], 0.000073f, 1e-5);
    const auto policy = softmax(answers.at("policy"));
    EXPECT_NEAR(policy[2 * 19 + 3], 0.080097f, 1e-5);
    EXPECT_NEAR(policy[3 * 19 + 16], 0.074604f, 1e-5);
}

// --- lc0

struct Lc0 {
    int numbers = 0;

    void fill(lc0::Layer& layer, int count) {
        layer.set_least(-0.5f);
        layer.set_most(0.5f);
        std::string data;
        for (int i = 0; i < count; ++i) {
            const int word = numbers++ * 7919 % 65536;
            data += static_cast<char>(word & 255);
            data += static_cast<char>(word >> 8);
        }
        layer.set_data(data);
    }
    void convolution(lc0::Convolution& layer, int in, int out, int side) {
        fill(*layer.mutable_kernel(), in * out * side * side);
        fill(*layer.mutable_bias(), out);
    }
    lc0::Net network(int policy, int value, bool excitation) {
        constexpr int channels = 4;
        lc0::Net net;
        net.set_magic(0x1c0);
        net.set_licence("CC0");
        net.mutable_training()->set_steps(77);
        auto& format = *net.mutable_format()->mutable_network();
        format.set_input(1);
        format.set_network(excitation ? 4 : 3);
        format.set_policy(policy);
        format.set_value(value);
        auto& w = *net.mutable_weights();
        convolution(*w.mutable_input(), 112, channels, 3);
        auto& block = *w.add_blocks();
        convolution(*block.mutable_first(), channels, channels, 3);
        convolution(*block.mutable_second(), channels, channels, 3);
        if (excitation) {
            auto& se = *block.mutable_excitation();
            fill(*se.mutable_weight1(), 2 * channels);
            fill(*se.mutable_bias1(), 2);
            fill(*se.mutable_weight2(), 2 * channels * 2);
            fill(*se.mutable_bias2(), 2 * channels);
        }
        if (policy == 2) {
            convolution(*w.mutable_policy1(), channels, channels, 3);
            convolution(*w.mutable_policy(), channels, 80, 3);
        } else {
            convolution(*w.mutable_policy(), channels, 2, 1);
            fill(*w.mutable_policy_weight(), 1858 * 128);
            fill(*w.mutable_policy_bias(), 1858);
        }
        convolution(*w.mutable_value(), channels, 2, 1);
        fill(*w.mutable_value1_weight(), 128 * 8);
        fill(*w.mutable_value1_bias(), 8);
        fill(*w.mutable_value2_weight(), value == 2 ? 24 : 8);
        fill(*w.mutable_value2_bias(), value == 2 ? 3 : 1);
        return net;
    }
};

TEST(Lc0, ReadsClassicalAndConvolutionalHeads) {
    for (const int policy : {1, 2})
        for (const int value : {1, 2})
            for (const bool excitation : {false, true}) {
                const auto net = Lc0{}.network(policy, value, excitation);
                const auto graph = graph_from_bytes(net.SerializeAsString());
                EXPECT_EQ(graph.facts.steps, 77);
                EXPECT_EQ(graph.facts.licence, "CC0");
                EXPECT_EQ(graph.facts.channels, 4);
                const auto answers = answers_of(graph, 8, {std::vector<float>(112 * 64, 0.5f)});
                EXPECT_EQ(answers.at("policy").size(), 1858u);
                if (value == 2)
                    EXPECT_EQ(answers.at("wdl").size(), 3u);
                else
                    EXPECT_LE(std::abs(answers.at("value")[0]), 1);
            }
}

TEST(Lc0, RefusesByName) {
    const auto refused = [](auto&& change) {
        auto net = Lc0{}.network(2, 2, true);
        change(net, *net.mutable_format()->mutable_network());
        return message_of(net.SerializeAsString());
    };
    using Net = lc0::Net;
    using Format = lc0::NetworkFormat;
    EXPECT_EQ(refused([](Net&, Format& f) { f.set_network(6); }),
              "expected a residual network of lc0, found an attention network");
    EXPECT_EQ(refused([](Net& n, Format&) { n.mutable_weights()->add_encoders(); }),
              "expected a residual network of lc0, found an attention network");
    EXPECT_EQ(refused([](Net& n, Format&) { n.mutable_onnx(); }),
              "expected a residual network of lc0, found an ONNX model");
    EXPECT_EQ(refused([](Net&, Format& f) { f.set_policy(3); }),
              "expected a classical or convolutional policy, found an attention policy");
    EXPECT_EQ(refused([](Net&, Format& f) { f.set_input(4); }),
              "expected lc0's input format 1 (classical 112 planes), found format 4");
    EXPECT_EQ(refused([](Net& n, Format&) { n.mutable_weights()->mutable_value()->Clear(); }),
              "value: expected 1 to 16384 numbers, found 0");
    EXPECT_EQ(
        refused([](Net& n, Format&) {
            n.mutable_weights()->mutable_blocks(0)->mutable_first()->mutable_kernel()->set_data(
                "1234");
        }),
        "block0.first: expected 144 weights, found 2");
}

TEST(Lc0, RefusesCuts) {
    const auto bytes = Lc0{}.network(2, 2, true).SerializeAsString();
    for (std::size_t size = 1; size < bytes.size(); size += 1 + size / 12)
        EXPECT_NE(message_of(bytes.substr(0, size)), "") << size;
}

TEST(Lc0, PolicyMap) {
    const auto map = lc0_policy_map();
    ASSERT_EQ(map.size(), 1858u);
    EXPECT_EQ(map[0], 7 * 2 * 64);  // a1b1: one step east
    EXPECT_EQ(*std::max_element(map.begin(), map.end()) / 64, 72);
    auto sorted = map;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
}

// Where a move stands in the list of 1858, knights' and sliding moves by ascending squares.
int move_index(int from, int to) {
    int index = 0;
    for (int f = 0; f < 64; ++f)
        for (int t = 0; t < 64; ++t) {
            const int dx = std::abs(t % 8 - f % 8), dy = std::abs(t / 8 - f / 8);
            if (f == t || !(dx == 0 || dy == 0 || dx == dy || dx * dy == 2)) continue;
            if (f == from && t == to) return index;
            ++index;
        }
    return -1;
}

std::vector<float> start_position() {
    std::vector<float> planes(112 * 64, 0);
    const auto set = [&](int plane, int square) {
        planes[static_cast<std::size_t>(plane * 64 + square)] = 1;
    };
    const std::array<int, 8> back = {3, 1, 2, 4, 5, 2, 1, 3};
    for (int file = 0; file < 8; ++file) {
        set(0, 8 + file);
        set(6, 48 + file);
        set(back[static_cast<std::size_t>(file)], file);
        set(6 + back[static_cast<std::size_t>(file)], 56 + file);
        for (int rank = 0; rank < 8; ++rank)
            for (const int plane : {104, 105, 106, 107, 111}) set(plane, rank * 8 + file);
    }
    return planes;
}

// FORMATS.md 5.2.
TEST(Lc0, AnswersAsMaiaDoesAtTheStart) {
    const std::map<std::string, std::array<float, 5>> expected = {
        {"maia-1500.pb.gz", {0.49999f, 0.04019f, 0.45982f, 0.65153f, 0.22947f}},
        {"maia-1900.pb.gz", {0.48953f, 0.05467f, 0.45580f, 0.56388f, 0.28911f}}};
    for (const auto& [name, values] : expected) {
        if (!std::filesystem::exists(network_file(name.c_str())))
            GTEST_SKIP() << "the shared data is not there";
        const auto graph = load(network_file(name.c_str()));
        EXPECT_EQ(graph.facts.blocks, 6);
        EXPECT_EQ(graph.facts.channels, 64);
        const auto answers = answers_of(graph, 8, {start_position()});
        const auto wdl = softmax(answers.at("wdl"));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(wdl[i], values[i], 1e-4) << name;
        std::vector<float> legal;
        const auto add = [&](int from, int to) {
            legal.push_back(answers.at("policy")[static_cast<std::size_t>(move_index(from, to))]);
        };
        add(12, 28);
        add(11, 27);
        for (int file = 0; file < 8; ++file) {
            add(8 + file, 16 + file);
            if (file != 3 && file != 4) add(8 + file, 24 + file);
        }
        for (const auto& [from, to] : {std::pair{1, 16}, {1, 18}, {6, 21}, {6, 23}}) add(from, to);
        const auto policy = softmax(legal);
        EXPECT_NEAR(policy[0], values[3], 1e-4) << name;
        EXPECT_NEAR(policy[1], values[4], 1e-4) << name;
        EXPECT_EQ(graph_from_bytes(to_safetensors(graph)), graph) << name;
    }
}

// --- Leela Zero

std::string leela_text(int version, int board, int channels, int blocks) {
    std::ostringstream out;
    int numbers = 0;
    const auto line = [&](int count, bool positive = false) {
        for (int i = 0; i < count; ++i)
            out << ' ' << (positive ? 1.0 : (numbers++ * 7919 % 201 - 100) / 400.0);
        out << '\n';
    };
    const auto group = [&](int in, int outs, int area) {
        line(in * outs * area);
        line(outs);
        line(outs);
        line(outs, true);
    };
    const int points = board * board;
    out << version << '\n';
    group(18, channels, 9);
    for (int i = 0; i < 2 * blocks; ++i) group(channels, channels, 9);
    group(channels, 2, 1);
    line((points + 1) * 2 * points);
    line(points + 1);
    group(channels, 1, 1);
    line(points * 16);
    line(16);
    line(16);
    line(1);
    return out.str();
}

TEST(LeelaZero, ReadsAnyBoard) {
    for (const int board : {5, 9}) {
        const auto graph = graph_from_bytes(leela_text(1, board, 3, 2));
        EXPECT_EQ(graph.facts.board, board);
        EXPECT_EQ(graph.facts.blocks, 2);
        EXPECT_EQ(graph.facts.channels, 3);
        const auto points = static_cast<std::size_t>(board * board);
        const auto answers = answers_of(graph, board, {std::vector<float>(18 * points, 0.5f)});
        EXPECT_EQ(answers.at("policy").size(), points + 1);
        EXPECT_LE(std::abs(answers.at("value")[0]), 1);
    }
    EXPECT_EQ(graph_from_bytes(leela_text(2, 5, 3, 1)).facts.encoding, "leela-zero-18-black");
}

TEST(LeelaZero, RefusesCutsAndOtherShapes) {
    const auto text = leela_text(1, 5, 3, 1);
    for (std::size_t size = 2; size + 1 < text.size(); size += 1 + size / 12)
        EXPECT_NE(message_of(text.substr(0, size)), "") << size;
    EXPECT_EQ(message_of("1\n1 2 3\n"), "expected 19 lines and 8 for each block, found 2");
    auto changed = text;
    changed.insert(changed.find('\n', 2), " 0.5");
    EXPECT_EQ(message_of(changed),
              "expected 486 weights for 18 planes, found 487 (a text network of lc0?)");
    changed = text;
    changed.replace(changed.find('\n', 2) + 1, 3, "inf");
    EXPECT_EQ(message_of(changed), "line 3: expected a number, found something else");
    for (const auto* line : {"", "1 2"})
        EXPECT_THROW(graph_from_leela_zero(line + text.substr(1)), engine::Error) << line;
}

// The winrate that Leela Zero gives after B Q16, W D4 on 19x19.
TEST(LeelaZero, AnswersAsLeelaZeroDoes) {
    const auto path = network_file("leela-zero-0k.txt.gz");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
    const auto graph = load(path);
    std::vector<float> planes(18 * 361, 0);
    const auto set = [&](int plane, int x, int y) {
        planes[static_cast<std::size_t>(plane * 361 + y * 19 + x)] = 1;
    };
    set(0, 15, 15);  // Black's Q16, now and one ply ago
    set(1, 15, 15);
    set(8, 3, 3);  // White's D4, just played
    std::fill_n(planes.begin() + 16 * 361, 361, 1.0f);
    const auto answers = answers_of(graph, 19, {planes});
    EXPECT_NEAR((1 + answers.at("value")[0]) / 2, 0.576157f, 1e-5);
}

}  // namespace
}  // namespace nn
