// The int16 executor: its arithmetic number for number, every instruction set against the others,
// whole networks against the reference.
#include "nn/winograd/winograd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "engine/base/error.h"
#include "naive.h"
#include "nn/builders.h"
#include "nn/calibration.h"
#include "nn/eigen/executor.h"
#include "nn/passes.h"
#include "nn/winograd/pack.h"

namespace nn::winograd {
namespace {

std::size_t at(std::ptrdiff_t index) { return static_cast<std::size_t>(index); }

// The tables of all instruction sets that this processor has.
std::vector<const Kernels*> all_kernels() {
    std::vector<const Kernels*> all;
    const Kernels* best = best_kernels();
    if (best != nullptr) all.push_back(best);
    if (best != nullptr && best != avx2_kernels() && __builtin_cpu_supports("avx2"))
        all.push_back(avx2_kernels());
    return all;
}

std::int16_t random_word(engine::Random& random, int low, int high) {
    return static_cast<std::int16_t>(low + static_cast<int>(random() % at(high - low + 1)));
}

TEST(WinogradTiling, IsAConvolution) {
    engine::Random random(1);
    for (const int m : {2, 3, 4}) {
        const auto& t = tiling(m);
        std::array<double, 6> input{};
        std::array<double, 3> kernel{};
        for (auto& x : input) x = random_word(random, -9, 9);
        for (auto& x : kernel) x = random_word(random, -9, 9);
        for (int o = 0; o < m; ++o) {
            double expected = 0, found = 0;
            for (int k = 0; k < 3; ++k) expected += input[at(o + k)] * kernel[at(k)];
            for (int cell = 0; cell < t.side(); ++cell) {
                double u = 0, v = 0;
                for (int k = 0; k < 3; ++k) u += t.kernel[at(cell)][at(k)] * kernel[at(k)];
                for (int i = 0; i < t.side(); ++i) v += t.input[at(cell)][at(i)] * input[at(i)];
                found += t.output[at(o)][at(cell)] * u * v;
            }
            EXPECT_NEAR(found, expected, 1e-9) << "F" << m;
        }
    }
}

TEST(WinogradTiling, LimitsAndChoices) {
    EXPECT_EQ(tiling(4).limit(false), 481);
    EXPECT_EQ(tiling(3).limit(false), 1820);
    EXPECT_EQ(tiling(2).limit(false), 16383 / 2);
    EXPECT_EQ(tiling(4).limit(true), 327);
    EXPECT_EQ(best_tile(19), 4);
    EXPECT_EQ(best_tile(13), 4);
    EXPECT_EQ(best_tile(9), 3);
    EXPECT_EQ(best_tile(8), 4);
    EXPECT_EQ(best_tile(5), 3);
}

// Random words within the limit; the corners of the range among them.
struct Words {
    Geometry board;
    int channels;
    Buffer<std::int16_t> values;

    Words(int side, int tile, int width, engine::Random& random) : channels(width) {
        const int tiles = (side + tile - 1) / tile;
        board = {side, tiles * tile + 2, tile, tiles};
        values = Buffer<std::int16_t>(at(board.padded * board.padded * channels));
        const int limit = tiling(tile).limit(true);
        for (int y = 1; y <= side; ++y)
            for (int x = 1; x <= side; ++x)
                for (int c = 0; c < channels; ++c)
                    values[at((y * board.padded + x) * channels + c)] =
                        random() % 4 == 0 ? static_cast<std::int16_t>(random() % 2 ? limit : -limit)
                                          : random_word(random, -limit, limit);
    }
    // B^T d B in int, at a cell of a tile.
    int transformed(int tile, int cell, int channel) const {
        const auto& t = tiling(board.tile);
        const int top = tile / board.tiles * board.tile, left = tile % board.tiles * board.tile;
        int sum = 0;
        for (int y = 0; y < t.side(); ++y)
            for (int x = 0; x < t.side(); ++x)
                sum += t.input[at(cell / t.side())][at(y)] * t.input[at(cell % t.side())][at(x)] *
                       values[at(((top + y) * board.padded + left + x) * channels + channel)];
        return sum;
    }
};

TEST(WinogradKernels, TransformsAreExact) {
    for (const auto* kernels : all_kernels())
        for (const int tile : {2, 3, 4}) {
            engine::Random random(at(tile));
            const Words words(9, tile, 64, random);
            const int tiles = words.board.tiles * words.board.tiles;
            const int cells = tiling(tile).cells();
            Buffer<std::int16_t> out(at(cells * tiles * 64));
            kernels->transform({words.board, 1, 64, words.values.data(), out.data(), tiles * 64});
            int wrong = 0;
            for (int cell = 0; cell < cells; ++cell)
                for (int t = 0; t < tiles; ++t)
                    for (int c = 0; c < 64; ++c)
                        wrong +=
                            out[at((cell * tiles + t) * 64 + c)] != words.transformed(t, cell, c);
            EXPECT_EQ(wrong, 0) << kernels->name << " F" << tile;
        }
}

// Products of the largest numbers that packing allows, in 64 bits: none may pass 31.
TEST(WinogradKernels, SumsAreExactAndNeverOverflow) {
    constexpr int channels = 96, rows = 23;
    for (const auto* kernels : all_kernels())
        for (int width = 1; width <= kernels->width; ++width) {
            engine::Random random(at(width));
            Tensor kernel = naive::random_tensor(random, {width * lanes, channels, 1, 1}, 1);
            const Quantisation input{std::vector<float>(channels, 0.01f), 327, 327};
            const auto groups = pack_convolution(kernel, input, nullptr, kernels->width);
            for (const auto& group : groups) {
                Buffer<std::int16_t> words(at(rows * channels));
                for (std::size_t i = 0; i < words.size(); ++i)
                    words[i] = random_word(random, -327, 327);
                const int vectors = group.width * lanes;
                Buffer<float> out(at(rows * vectors));
                kernels->multiply({words.data(), 0, channels, 1, rows, channels / 2, group.width,
                                   group.weights.data(), group.scale.data(), out.data()});
                for (int r = 0; r < rows; ++r)
                    for (int o = 0; o < vectors; ++o) {
                        std::int64_t sum = 0, largest = 0;
                        for (int i = 0; i < channels; ++i) {
                            const std::int64_t weight =
                                group.weights[at((i / 2 * vectors + o) * 2 + i % 2)];
                            sum += weight * words[at(r * channels + i)];
                            largest += std::abs(weight) * 327;
                        }
                        ASSERT_LT(largest, std::int64_t{1} << 31);
                        ASSERT_EQ(out[at(r * vectors + o)],
                                  static_cast<float>(sum) * group.scale[at(o)])
                            << kernels->name;
                    }
            }
        }
}

TEST(WinogradPack, WidthsAddUp) {
    for (int vectors = 1; vectors < 40; ++vectors) {
        int sum = 0;
        for (const int width : split_widths(vectors, 4)) {
            sum += width;
            EXPECT_TRUE(width >= 1 && width <= 4);
        }
        EXPECT_EQ(sum, vectors);
    }
}

// Inputs as networks see them: mostly zeros, some planes the same all over.
std::vector<std::vector<float>> sparse_inputs(const Graph& graph, int board, int positions,
                                              engine::Random& random) {
    std::vector<std::vector<float>> inputs;
    const auto shapes = infer_shapes(graph, board);
    const auto points = at(board * board);
    for (const int n : graph.input_nodes()) {
        auto& input = inputs.emplace_back(shapes[at(n)].size(board * board) * at(positions));
        for (std::size_t i = 0; i < input.size(); ++i) {
            const auto plane = i / points;
            const bool even = shapes[at(n)].over_board && plane % 5 == 0;
            input[i] = even ? (i % points == 0 ? static_cast<float>(random() % 3) : input[i - 1])
                            : static_cast<float>(random() % 4 == 0);
        }
    }
    return inputs;
}

std::vector<std::vector<float>> run(const Graph& graph, Executor& executor, int board,
                                    const std::vector<std::vector<float>>& inputs, int positions) {
    const auto shapes = infer_shapes(graph, board);
    std::vector<std::vector<float>> outputs;
    for (const auto& output : graph.outputs)
        outputs.emplace_back(shapes[at(output.node)].size(board * board) * at(positions));
    const std::vector<std::span<const float>> in(inputs.begin(), inputs.end());
    const std::vector<std::span<float>> out(outputs.begin(), outputs.end());
    executor.run({positions, board, in, out});
    return outputs;
}

// The worst difference as a share of the largest number of its output.
double worst_share(const std::vector<std::vector<float>>& found,
                   const std::vector<std::vector<float>>& expected) {
    double worst = 0;
    for (std::size_t o = 0; o < found.size(); ++o) {
        double most = 1e-3, difference = 0;
        for (std::size_t i = 0; i < found[o].size(); ++i) {
            most = std::max(most, std::abs(double{expected[o][i]}));
            difference = std::max(difference, std::isfinite(found[o][i])
                                                  ? std::abs(double{found[o][i]} - expected[o][i])
                                                  : 1e9);
        }
        worst = std::max(worst, difference / most);
    }
    return worst;
}

std::vector<std::vector<float>> maxima_on(const Graph& graph, int board,
                                          const std::vector<std::vector<float>>& inputs,
                                          int count) {
    const Positions seen{count, board, inputs};
    return calibrate(graph, std::span(&seen, 1)).maxima;
}

// Against the reference with every instruction set; the sets must agree to the last bit.
void expect_close(const Graph& graph, int board, int positions, double bound) {
    const auto optimised = optimise(graph);
    ASSERT_TRUE(serves(optimised, board));
    engine::Random random(at(board));
    const auto inputs = sparse_inputs(graph, board, positions, random);
    const auto maxima = maxima_on(graph, board, inputs, positions);
    const auto expected =
        run(graph, *eigen::Program(graph).make_executor(), board, inputs, positions);
    std::vector<std::vector<float>> first;
    for (const auto* kernels : all_kernels()) {
        const auto executor = Program(optimised, maxima, board, kernels).make_executor();
        const auto found = run(graph, *executor, board, inputs, positions);
        EXPECT_LT(worst_share(found, expected), bound) << kernels->name << " board " << board;
        if (first.empty()) first = found;
        EXPECT_EQ(found, first) << kernels->name << " board " << board;
    }
}

TEST(Winograd, EveryOperationAgreesWithTheReference) {
    if (!available()) GTEST_SKIP() << "this processor has no AVX2";
    for (const int board : {3, 7, 8, 9, 19}) {
        engine::Random random(at(board));
        expect_close(naive::every_operation(random, board), board, 3, 0.03);
    }
}

TowerDescription tower(int board, int channels) {
    TowerDescription about;
    about.facts.board = board;
    about.facts.blocks = 3;
    about.facts.channels = channels;
    about.planes = 17;
    about.policy_size = board * board + 1;
    about.value_width = 32;
    return about;
}

TEST(Winograd, TowersOfEveryKind) {
    if (!available()) GTEST_SKIP() << "this processor has no AVX2";
    for (const auto attention :
         {Attention::none, Attention::squeeze_excitation, Attention::global_pooling})
        for (const auto policy : {PolicyHead::flat, PolicyHead::points, PolicyHead::planes})
            for (const int channels : {24, 80}) {
                engine::Random random(2);
                auto about = tower(9, channels);
                about.attention = attention;
                about.policy = policy;
                about.move_planes = 20;
                about.flat_value = policy == PolicyHead::flat;
                about.globals = 3;
                about.wdl = about.ownership = about.score = about.moves_left = true;
                expect_close(build_tower(about, random), 9, 5, 0.02);
            }
}

TEST(Winograd, AlphaGoOnItsBoard) {
    if (!available()) GTEST_SKIP() << "this processor has no AVX2";
    engine::Random random(4);
    Facts facts;
    facts.board = 19;
    facts.channels = 32;
    expect_close(build_alphago_policy(facts, 48, random), 19, 1, 0.03);
}

TEST(Winograd, ABatchIsItsPositionsOneByOne) {
    if (!available()) GTEST_SKIP() << "this processor has no AVX2";
    engine::Random random(5);
    const auto graph = build_tower(tower(8, 32), random);
    const auto optimised = optimise(graph);
    constexpr int positions = 13;
    const auto inputs = sparse_inputs(graph, 8, positions, random);
    const Program program(optimised, maxima_on(graph, 8, inputs, positions), 8);
    const auto executor = program.make_executor();
    const auto together = run(graph, *executor, 8, inputs, positions);
    const auto size = inputs[0].size() / positions;
    for (std::size_t p = 0; p < positions; ++p) {
        const auto* from = inputs[0].data() + p * size;
        const auto alone = run(graph, *executor, 8, {{from, from + size}}, 1);
        for (std::size_t o = 0; o < alone.size(); ++o)
            for (std::size_t i = 0; i < alone[o].size(); ++i)
                ASSERT_EQ(alone[o][i], together[o][p * alone[o].size() + i]);
    }
}

TEST(Winograd, ExecutorsOfOneProgramRunSideBySide) {
    if (!available()) GTEST_SKIP() << "this processor has no AVX2";
    engine::Random random(6);
    const auto graph = build_tower(tower(9, 32), random);
    const auto optimised = optimise(graph);
    const auto inputs = sparse_inputs(graph, 9, 4, random);
    const Program program(optimised, maxima_on(graph, 9, inputs, 4), 9);
    const auto expected = run(graph, *program.make_executor(), 9, inputs, 4);
    std::array<int, 3> same{};
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < same.size(); ++t)
        threads.emplace_back([&, t] {
            const auto executor = program.make_executor();
            for (int i = 0; i < 10; ++i) same[t] += run(graph, *executor, 9, inputs, 4) == expected;
        });
    for (auto& thread : threads) thread.join();
    for (const int count : same) EXPECT_EQ(count, 10);
}

TEST(Winograd, SaysWhatItDoesNotServe) {
    engine::Random random(7);
    const auto graph = optimise(build_tower(tower(9, 16), random));
    EXPECT_TRUE(serves(graph, 9));
    EXPECT_FALSE(serves(graph, 33));
    EXPECT_FALSE(serves(build_mlp({}, {4, 8, 2}, random), 9));
    Graph wide;
    int x = add_input(wide, "planes", {2, true});
    x = add_convolution(wide, "first", x, {naive::random_tensor(random, {4, 2, 3, 3}, 1)});
    x = add_convolution(wide, "second", x, {naive::random_tensor(random, {4, 4, 5, 5}, 1)});
    name_output(wide, "body", x);
    EXPECT_FALSE(serves(optimise(wide), 9));
}

TEST(Winograd, RefusesAnotherBoard) {
    if (!available()) GTEST_SKIP() << "this processor has no AVX2";
    engine::Random random(8);
    const auto graph = naive::every_operation(random, 5);
    const auto optimised = optimise(graph);
    const auto inputs = sparse_inputs(graph, 5, 1, random);
    const auto executor = Program(optimised, maxima_on(graph, 5, inputs, 1), 5).make_executor();
    EXPECT_THROW(naive::worst_difference(graph, *executor, 6, 1, random), engine::Error);
}

}  // namespace
}  // namespace nn::winograd
