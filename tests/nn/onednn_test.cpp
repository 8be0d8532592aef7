#if defined(SANBAN_ONEDNN)
#include <gtest/gtest.h>

#include <thread>

#include "engine/base/error.h"
#include "naive.h"
#include "nn/builders.h"
#include "nn/calibration.h"
#include "nn/load.h"
#include "nn/onednn/executor.h"
#include "nn/onednn/kernels.h"
#include "nn/onednn/library.h"
#include "random_positions.h"
#include "shared.h"

namespace nn {
namespace {

double difference(const Graph& graph, Precision precision, int board, int size,
                  engine::Random& random) {
    const auto seen = random_positions(graph, board, 8, random);
    const onednn::Program program(graph, precision, calibrate(graph, std::span(&seen, 1)));
    return naive::worst_difference(graph, *program.make_executor(), board, size, random);
}

TEST(Onednn, EveryOperationAgreesWithTheLoops) {
    for (const int board : {3, 7, 9, 19})
        for (const int channels : {5, 32, 70}) {
            engine::Random random(static_cast<std::uint64_t>(board));
            const auto graph = naive::every_operation(random, board, channels);
            const double scale = channels == 5 ? 1 : 1000;  // sums grow with the channels
            EXPECT_LT(difference(graph, Precision::fp32, board, 2, random), 5e-4 * scale)
                << "board " << board << ", channels " << channels;
        }
}

TowerDescription tower(int board, Attention attention) {
    TowerDescription about;
    about.facts.board = board;
    about.facts.blocks = 3;
    about.facts.channels = 32;
    about.planes = 17;
    about.policy_size = board * board + 1;
    about.attention = attention;
    about.globals = 4;
    about.wdl = about.ownership = about.score = about.moves_left = true;
    return about;
}

// Those that this processor can run.
std::vector<const onednn::Kernels*> runnable_kernels() {
    std::vector<const onednn::Kernels*> all{&onednn::baseline_kernels()};
    if (onednn::has_avx2()) all.push_back(&onednn::avx2_kernels());
    if (onednn::has_avx512()) all.push_back(&onednn::avx512_kernels());
    return all;
}

TEST(Onednn, PlanesAndRowsChangePlacesInSquaresAndWithoutThem) {
    constexpr int positions = 2;
    for (const int points : {1, 9, 16, 64, 81})
        for (const int channels : {3, 16, 34, 73}) {
            const auto size = static_cast<std::size_t>(points * channels);
            std::vector<float> in(positions * size), post(static_cast<std::size_t>(channels));
            for (std::size_t i = 0; i < in.size(); ++i) in[i] = static_cast<float>(i % 251) - 125;
            for (std::size_t i = 0; i < post.size(); ++i) post[i] = i % 2 == 0 ? 1.0f : 0.5f;
            for (const auto* kernels : runnable_kernels()) {
                std::vector<float> planes(in.size()), rows(in.size());
                std::vector<std::int8_t> octets(in.size());
                using onednn::Format;
                kernels->to_planes(
                    {in.data(), planes.data(), Format::f32, nullptr, positions, points, channels});
                kernels->to_rows({planes.data(), rows.data(), Format::f32, post.data(), positions,
                                  points, channels});
                kernels->to_rows({planes.data(), octets.data(), Format::s8, nullptr, positions,
                                  points, channels});
                for (std::size_t i = 0; i < in.size(); ++i) {
                    const auto channel = i % post.size(), point = i % size / post.size();
                    const auto plane = channel * static_cast<std::size_t>(points) + point;
                    ASSERT_EQ(planes[i / size * size + plane], in[i]);
                    ASSERT_EQ(rows[i], in[i] * post[channel]);
                    ASSERT_EQ(octets[i], static_cast<std::int8_t>(in[i]));
                }
            }
        }
}

TEST(Onednn, TowersInEveryPrecision) {
    for (const auto attention :
         {Attention::none, Attention::squeeze_excitation, Attention::global_pooling})
        for (const auto& [precision, bound] :
             {std::pair{Precision::fp32, 1e-3}, {Precision::bf16, 0.2}, {Precision::int8, 0.5}}) {
            if (!onednn::serves(precision)) continue;
            engine::Random random(2);
            const auto graph = build_tower(tower(9, attention), random);
            EXPECT_LT(difference(graph, precision, 9, 3, random), bound)
                << name_of(precision) << ", attention " << static_cast<int>(attention);
        }
}

TEST(Onednn, AlphagoAndPlainLayers) {
    engine::Random random(3);
    Facts facts;
    facts.board = 9;
    facts.channels = 16;
    for (const auto& graph :
         {build_alphago_policy(facts, 48, random), build_alphago_value(facts, 49, random),
          build_alphago_value(facts, 49, random, 8), build_mlp({}, {4, 300, 300, 3}, random)})
        EXPECT_LT(difference(graph, Precision::fp32, 9, 2, random), 1e-3);
}

TEST(Onednn, BatchesAndBoardsInAnyOrder) {
    engine::Random random(4);
    auto about = tower(0, Attention::global_pooling);
    about.policy = PolicyHead::points;
    about.flat_value = false;
    const auto graph = build_tower(about, random);
    const auto executor = onednn::Program(graph, Precision::fp32).make_executor();
    for (const auto& [board, size] : {std::pair{9, 3}, {19, 9}, {7, 17}, {9, 1}, {9, 3}})
        EXPECT_LT(naive::worst_difference(graph, *executor, board, size, random), 1e-3);
}

TEST(Onednn, ExecutorsRunSideBySideAndChangeThreads) {
    engine::Random random(5);
    const auto graph = build_tower(tower(9, Attention::none), random);
    const onednn::Program program(graph, Precision::fp32);
    std::array<std::unique_ptr<Executor>, 3> executors;
    for (auto& executor : executors) executor = program.make_executor();
    for (int round = 0; round < 2; ++round) {
        std::array<double, 3> worst{};
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < worst.size(); ++t)
            threads.emplace_back([&, t] {
                engine::Random own(t);
                for (int i = 0; i < 5; ++i)
                    worst[t] = std::max(worst[t],
                                        naive::worst_difference(graph, *executors[t], 9, 2, own));
            });
        for (auto& thread : threads) thread.join();
        for (const double most : worst) EXPECT_LT(most, 1e-3);
    }
}

TEST(Onednn, RefusesABoardThatDoesNotFit) {
    engine::Random random(7);
    const auto graph = naive::every_operation(random, 5);
    const auto executor = onednn::Program(graph, Precision::fp32).make_executor();
    EXPECT_THROW(naive::worst_difference(graph, *executor, 6, 1, random), engine::Error);
}

TEST(Onednn, ImportedNetworks) {
    for (const auto& [name, board] : {std::pair{"katago-b1c6nbt-v11.bin.gz", 9},
                                      {"katago-b2c16-v9.bin.gz", 13},
                                      {"maia-1900.pb.gz", 8},
                                      {"leela-zero-0k.txt.gz", 19}}) {
        const auto path = shared_data() / "nets" / name;
        if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
        engine::Random random(8);
        EXPECT_LT(difference(load(path), Precision::fp32, board, 2, random), 2e-3) << name;
    }
}

}  // namespace
}  // namespace nn
#endif
