#include "nn/training/onednn/paired_gradient.h"

#include <algorithm>

namespace nn::training {

namespace {

std::size_t at(std::ptrdiff_t index) { return static_cast<std::size_t>(index); }

}  // namespace

PairedGradient::PairedGradient(Extent x, Extent y, int side, int board)
    : x_(x),
      y_(y),
      shape_{x.blocks() * std::ptrdiff_t{lanes}, y.blocks() * std::ptrdiff_t{lanes}, side, board},
      x_pairs_(at(most_pairs * shape_.points() * shape_.in)),
      y_pairs_(at(most_pairs * shape_.points() * shape_.out)),
      sums_(at(shape_.side * shape_.side * shape_.in * shape_.out)) {}

void PairedGradient::add(const Bf16* x, const Bf16* y_gradient) {
    const auto& loops = pair_loops();
    const auto points = shape_.points(), x_size = points * shape_.in, y_size = points * shape_.out;
    for (std::ptrdiff_t first = 0; first < x_.samples; first += 2 * most_pairs) {
        const auto count = std::min(most_pairs, (x_.samples - first + 1) / 2);
        for (std::ptrdiff_t pair = 0; pair < count; ++pair) {
            const auto a = first + 2 * pair, b = a + 1;
            const bool whole = b < x_.samples;
            loops.interleave(x_.blocks(), points, x + a * x_size, whole ? x + b * x_size : nullptr,
                             x_pairs_.data() + pair * x_size);
            loops.interleave(y_.blocks(), points, y_gradient + a * y_size,
                             whole ? y_gradient + b * y_size : nullptr,
                             y_pairs_.data() + pair * y_size);
        }
        loops.add_products(shape_, count, x_pairs_.data(), y_pairs_.data(), sums_.data());
    }
}

void PairedGradient::collect(float* kernel) {
    const auto places = shape_.side * shape_.side;
    for (std::ptrdiff_t place = 0; place < places; ++place)
        for (std::ptrdiff_t in = 0; in < x_.channels; ++in)
            for (std::ptrdiff_t out = 0; out < y_.channels; ++out)
                kernel[(out * x_.channels + in) * places + place] +=
                    sums_[at((place * shape_.in + in) * shape_.out + out)];
    std::fill(sums_.begin(), sums_.end(), 0.0f);
}

}  // namespace nn::training
