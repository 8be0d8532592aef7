#include "nn/peak.h"

#include <gtest/gtest.h>

namespace nn {
namespace {

TEST(Peak, CountsWhatItRan) {
    for (const auto precision :
         {Precision::fp32, Precision::bf16, Precision::int8, Precision::int16}) {
        const double once = run_multiply_adds(precision, 1000);
        EXPECT_EQ(run_multiply_adds(precision, 3000), 3 * once) << name_of(precision);
        EXPECT_EQ(run_multiply_adds(precision, 0), 0) << name_of(precision);
    }
}

#if defined(__x86_64__)
TEST(Peak, EveryProcessorWithFusedMultiplyAddsHasOne) {
    if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "this processor has none";
    EXPECT_GT(run_multiply_adds(Precision::fp32, 10), 0);
    EXPECT_GT(run_multiply_adds(Precision::int16, 10), 0);
}
#endif

}  // namespace
}  // namespace nn
