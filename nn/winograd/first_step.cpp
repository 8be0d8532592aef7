#include <bit>

#include "nn/index.h"
#include "nn/winograd/steps.h"

namespace nn::winograd {

namespace {

// Words of 64 bits that hold a plane.
std::size_t words_of(int points) { return (at(points) + 63) / 64; }

template <class Visit>
void for_each_bit(const std::uint64_t* words, std::size_t count, const Visit& visit) {
    for (std::size_t word = 0; word < count; ++word)
        for (auto bits = words[word]; bits != 0; bits &= bits - 1)
            visit(word * 64 + static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace

FirstStep::FirstStep(int input, const Tensor& kernel, Target target)
    : input_(input),
      kernel_(kernel.shape[2]),
      planes_(kernel.shape[1]),
      weights_(pack_first(kernel)),
      borders_(pack_borders(kernel)),
      target_(std::move(target)) {}

void FirstStep::run(Workspace& space) const {
    const auto finish = target_.finish(space);
    const float* planes = space.inputs[at(input_)];
    for (int p = 0; p < space.positions;
         ++p, planes += std::ptrdiff_t{planes_} * space.layout.points()) {
        encode(space, planes);
        // On a board narrower than the kernel both sides cut it: there are no border classes.
        const bool classes = space.layout.board.side >= kernel_;
        space.kernels.first({p, kernel_, planes_, space.entries.data(), space.starts.data(),
                             weights_.data(), classes ? space.borders.data() : nullptr},
                            finish);
    }
}

void FirstStep::encode(Workspace& space, const float* planes) const {
    const auto size = words_of(space.layout.points());
    const auto points = at(space.layout.points());
    mark(space, planes);
    std::fill_n(space.borders.data(), at(kernel_ * kernel_ * target_.channels), 0.0f);
    std::fill(space.counts.begin(), space.counts.end(), 0);
    for (int plane = 0; plane < planes_; ++plane) {
        auto* bits = space.bits.data() + at(plane) * size;
        const float* values = planes + at(plane) * points;
        if (uniform(space, values, at(plane) * size)) {
            add_border(space, plane, values[0]);
            std::fill_n(bits, size, 0);
        }
        for_each_bit(bits, size, [&](std::size_t point) { ++space.counts[point]; });
    }
    list_entries(space, planes);
}

void FirstStep::mark(Workspace& space, const float* planes) const {
    const int points = space.layout.points();
    auto* bits = space.bits.data();
    for (int plane = 0; plane < planes_; ++plane, planes += points)
        for (int p = 0; p < points; p += 64)
            *bits++ = space.kernels.nonzero(planes + p, std::min(64, points - p));
}

bool FirstStep::uniform(const Workspace& space, const float* plane, std::size_t bits) const {
    const int points = space.layout.points();
    if (space.layout.board.side < kernel_ || plane[0] == 0) return false;
    for (int p = 0; p < points; p += 64) {
        const int count = std::min(64, points - p);
        if (space.bits[bits++] != ~std::uint64_t{0} >> (64 - count)) return false;
    }
    return std::all_of(plane, plane + points, [&](float x) { return x == plane[0]; });
}

void FirstStep::add_border(const Workspace& space, int plane, float value) const {
    const auto size = at(kernel_ * kernel_ * target_.channels);
    const float* from = borders_.data() + at(plane) * size;
    for (std::size_t i = 0; i < size; ++i) space.borders[i] += value * from[i];
}

// Sorted by point: first where every point's entries begin, then the entries.
void FirstStep::list_entries(Workspace& space, const float* planes) const {
    const auto points = at(space.layout.points());
    const auto size = words_of(space.layout.points());
    space.starts[0] = 0;
    for (std::size_t p = 0; p < points; ++p) {
        space.starts[p + 1] = space.starts[p] + space.counts[p];
        space.counts[p] = space.starts[p];
    }
    const auto side = at(space.layout.board.side);
    for (int plane = 0; plane < planes_; ++plane)
        for_each_bit(space.bits.data() + at(plane) * size, size, [&](std::size_t point) {
            const auto column = static_cast<int>(point % side);
            space.entries[at(space.counts[point]++)] = {
                planes[at(plane) * points + point], (column * planes_ + plane) * target_.channels};
        });
}

}  // namespace nn::winograd
