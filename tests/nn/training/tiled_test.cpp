// Our own loops of a convolution in fp32, each build of them, against sums written out.
#ifdef SANBAN_ONEDNN

#include "nn/training/onednn/tiled.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/random.h"
#include "nn/onednn/library.h"
#include "nn/training/tape.h"

namespace nn::training {
namespace {

struct Case {
    int in, out, side, board, samples = 2;
};

class Convolved {
   public:
    Convolved(const Case& about, const TileLoops& loops) : about_(about), loops_(loops) {
        fill(kernel_, about.out * about.in * about.side * about.side);
        fill(bias_, about.out);
        fill(x_, x_extent().count());
        fill(y_gradient_, y_extent().count());
        clear_fillers(x_, x_extent());
        clear_fillers(y_gradient_, y_extent());
    }

    void expect_sums() {
        TiledConvolution convolution(x_extent(), y_extent(), about_.side, about_.board, loops_);
        convolution.load(kernel_.data(), bias_.data());
        std::vector<float> y(y_extent().count(), 7), x_gradient(x_extent().count(), 7),
            kernel_gradient(kernel_.size(), 1);
        convolution.forward(x_.data(), y.data());
        convolution.backward_data(y_gradient_.data(), x_gradient.data());
        for (int i = 0; i < 2; ++i) convolution.backward_weights(x_.data(), y_gradient_.data());
        convolution.collect(kernel_gradient.data());

        std::vector<double> y_sum(y.size()), x_sum(x_gradient.size()), kernel_sum(kernel_.size());
        for_products([&](std::size_t k, std::size_t x, std::size_t y_place) {
            y_sum[y_place] += double{kernel_[k]} * x_[x];
            x_sum[x] += double{kernel_[k]} * y_gradient_[y_place];
            kernel_sum[k] += double{x_[x]} * y_gradient_[y_place];
        });
        for (int s = 0; s < about_.samples; ++s)
            for (int c = 0; c < about_.out; ++c)
                for (int p = 0; p < about_.board * about_.board; ++p)
                    y_sum[place(y_extent(), s, c, p)] += double{bias_[at(c)]};
        expect_near(y, y_sum, 1, 0);
        expect_near(x_gradient, x_sum, 1, 0);
        expect_near(kernel_gradient, kernel_sum, 2, 1);
    }

   private:
    Extent x_extent() const { return {about_.samples, about_.in, about_.board * about_.board}; }
    Extent y_extent() const { return {about_.samples, about_.out, about_.board * about_.board}; }

    void fill(std::vector<float>& row, std::size_t count) {
        row.resize(count);
        for (auto& x : row) x = static_cast<float>(random_.below(2001) - 1000) / 1000;
    }
    void fill(std::vector<float>& row, int count) { fill(row, at(count)); }
    static void clear_fillers(std::vector<float>& row, Extent extent) {
        for (int s = 0; s < extent.samples; ++s)
            for (int c = extent.channels; c < extent.blocks() * lanes; ++c)
                for (int p = 0; p < extent.points; ++p) row[place(extent, s, c, p)] = 0;
    }

    static std::size_t place(Extent extent, int sample, int channel, int point) {
        const int tile = sample * extent.blocks() + channel / lanes;
        return at(tile) * extent.tile() + at(point * lanes + channel % lanes);
    }

    // Calls visit(place in the kernel, in x, in y) for each product that a convolution adds up.
    template <class Visit>
    void for_products(Visit visit) const {
        const int side = about_.side, board = about_.board, margin = side / 2;
        for (int s = 0; s < about_.samples; ++s)
            for (int o = 0; o < about_.out; ++o)
                for (int i = 0; i < about_.in; ++i)
                    for (int k = 0; k < side * side; ++k)
                        for (int p = 0; p < board * board; ++p) {
                            const int row = p / board + k / side - margin;
                            const int column = p % board + k % side - margin;
                            if (std::min(row, column) < 0 || std::max(row, column) >= board)
                                continue;
                            visit(at((o * about_.in + i) * side * side + k),
                                  place(x_extent(), s, i, row * board + column),
                                  place(y_extent(), s, o, p));
                        }
    }

    static void expect_near(const std::vector<float>& found, const std::vector<double>& sums,
                            double factor, double start) {
        double worst = 0;
        for (std::size_t i = 0; i < found.size(); ++i)
            worst = std::max(worst, std::abs(double{found[i]} - factor * sums[i] - start));
        EXPECT_LT(worst, 1e-3);
    }

    Case about_;
    const TileLoops& loops_;
    engine::Random random_{3};
    std::vector<float> kernel_, bias_, x_, y_gradient_;
};

void expect_sums(const TileLoops& loops) {
    for (const auto& about : {Case{1, 1, 1, 1},
                              {3, 17, 3, 2},
                              {16, 16, 3, 5},
                              {22, 32, 3, 7},
                              {40, 33, 5, 9},
                              {64, 64, 3, 9},
                              {20, 2, 1, 13},
                              {5, 18, 3, 19, 3},
                              {2, 3, 7, 3}}) {
        SCOPED_TRACE(testing::Message() << about.in << " to " << about.out << " by " << about.side
                                        << " on " << about.board);
        Convolved(about, loops).expect_sums();
    }
}

TEST(TiledConvolution, AnyProcessor) { expect_sums(portable_tile_loops); }

TEST(TiledConvolution, Avx2) {
    if (!onednn::has_avx2()) GTEST_SKIP() << "needs AVX2";
    expect_sums(avx2_tile_loops);
}

}  // namespace
}  // namespace nn::training

#endif
