// An executor that has seen a batch size and board allocates nothing more. Counted at malloc, which
// a sanitizer has for itself; what oneDNN allocates inside a call of a layer is not ours to avoid.
#include <dlfcn.h>
#include <execinfo.h>
#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "nn/backend.h"
#include "nn/builders.h"
#include "nn/eigen/executor.h"
#include "random_positions.h"

#if defined(__GLIBC__) && !defined(SANBAN_SANITIZED) && !defined(__clang__)

namespace {

thread_local bool counting = false;
thread_local int allocations = 0;

bool inside_library() {
    std::array<void*, 24> frames{};
    const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
    for (int i = 0; i < count; ++i) {
        Dl_info about{};
        if (dladdr(frames[static_cast<std::size_t>(i)], &about) != 0 && about.dli_fname &&
            std::string_view(about.dli_fname).find("libdnnl") != std::string_view::npos)
            return true;
    }
    return false;
}

void count() {
    if (!counting) return;
    counting = false;
    if (!inside_library()) ++allocations;
    counting = true;
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) { return count(), __libc_malloc(size); }
void* calloc(std::size_t items, std::size_t size) { return count(), __libc_calloc(items, size); }
void* realloc(void* old, std::size_t size) { return count(), __libc_realloc(old, size); }
void* memalign(std::size_t alignment, std::size_t size) {
    return count(), __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
    return (*out = memalign(alignment, size)) == nullptr ? 12 : 0;
}
}

namespace nn {
namespace {

constexpr int board = 9;

int allocations_once_warm(const Graph& graph, Executor& executor, const Positions& positions) {
    const auto shapes = infer_shapes(graph, board);
    std::vector<std::vector<float>> results;
    for (const auto& output : graph.outputs)
        results.emplace_back(shapes[naive::at(output.node)].size(board * board) *
                             naive::at(positions.size));
    const std::vector<std::span<const float>> in(positions.inputs.begin(), positions.inputs.end());
    const std::vector<std::span<float>> out(results.begin(), results.end());
    executor.run({positions.size, board, in, out});
    static_cast<void>(inside_library());  // which allocates at its first call
    allocations = 0;
    counting = true;
    executor.run({positions.size, board, in, out});
    executor.run({positions.size, board, in, out});
    counting = false;
    return allocations;
}

TEST(Allocation, IsCounted) {
    allocations = 0;
    counting = true;
    const std::vector<int> some(100);
    counting = false;
    EXPECT_EQ(allocations, 1) << some.size();
}

TEST(Allocation, ThereIsNoneOnceWarm) {
    TowerDescription about;
    about.facts.board = 9;
    about.facts.blocks = 2;
    about.facts.channels = 32;
    about.planes = 17;
    about.policy_size = 82;
    about.globals = 4;
    about.wdl = about.ownership = about.score = true;
    for (const auto attention :
         {Attention::none, Attention::squeeze_excitation, Attention::global_pooling}) {
        about.attention = attention;
        engine::Random random(2);
        const auto graph = build_tower(about, random);
        for (const auto precision :
             {Precision::fp32, Precision::bf16, Precision::int8, Precision::int16})
            for (const int size : {1, 5, 20}) {
                const auto positions = random_positions(graph, board, size, random);
                const auto calibration = calibrate(graph, std::span(&positions, 1));
                const auto executor =
                    compile(graph, precision, calibration, board)->make_executor();
                EXPECT_EQ(allocations_once_warm(graph, *executor, positions), 0)
                    << name_of(precision) << ", batch " << size;
            }
    }
}

TEST(Allocation, NorByTheReference) {
    engine::Random random(3);
    const auto graph = naive::every_operation(random, board);
    const auto positions = random_positions(graph, board, 3, random);
    const auto executor = eigen::Program(graph).make_executor();
    EXPECT_EQ(allocations_once_warm(graph, *executor, positions), 0);
}

}  // namespace
}  // namespace nn

#endif
