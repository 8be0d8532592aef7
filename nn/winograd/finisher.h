// Applies a Finish to values in registers: the last step of whatever computes a board. For the
// kernels; no standard library code.
#pragma once

#include "nn/winograd/curves.h"
#include "nn/winograd/unroll.h"

namespace nn::winograd {

// Which parts of a Finish are there, known when compiling; `general` decides while running and
// knows all curves, the others no curve but ReLU.
constexpr int with_residual = 1, with_floats = 2, with_words = 4, general = 8;

template <class Isa, int mode>
class Finisher {
   public:
    using Floats = typename Isa::Floats;

    explicit Finisher(const Finish& finish)
        : finish_(finish),
          parts_((finish.residual ? with_residual : 0) | (finish.floats ? with_floats : 0) |
                 (finish.words ? with_words : 0)),
          floor_(Isa::set(finish.first == Curve::relu ? 0.0f : -3e38f)) {}

    const Finish& finish() const { return finish_; }

    [[gnu::always_inline]] void apply(Floats v, int position, int y, int x, int channel) const {
        const auto& f = finish_;
        const std::ptrdiff_t point = y * f.board.side + x;
        v = v + Isa::load(f.bias + position * f.bias_stride + channel);
        if (has(with_residual))
            v = v +
                Isa::load(f.residual + position * f.residual_stride + point * f.channels + channel);
        if constexpr (mode == general)
            v = curve<Isa>(f.first, v);
        else
            v = Isa::maximum(v, floor_);
        if (has(with_floats)) Isa::store(f.floats + floats_at(position, point) + channel, v);
        if (has(with_words)) store_words(v, position, y, x, channel);
    }

   private:
    bool has(int part) const {
        if constexpr (mode == general)
            return (parts_ & part) != 0;
        else
            return (mode & part) != 0;
    }
    std::ptrdiff_t floats_at(int position, std::ptrdiff_t point) const {
        const std::ptrdiff_t points = finish_.board.side * finish_.board.side;
        return (position * points + point) * finish_.channels;
    }
    [[gnu::always_inline]] void store_words(Floats v, int position, int y, int x,
                                            int channel) const {
        const auto& f = finish_;
        v = Isa::fused(v, Isa::load(f.scale + channel), Isa::load(f.shift + channel));
        if constexpr (mode == general)
            if (f.second > Curve::relu)
                v = curve<Isa>(f.second, v) * Isa::load(f.inverse_step + channel);
        v = Isa::minimum(Isa::maximum(v, Isa::set(f.lowest)), Isa::set(f.highest));
        const std::ptrdiff_t side = f.board.padded;
        const std::ptrdiff_t point = (position * side + y + 1) * side + x + 1;
        Isa::store_rounded(f.words + point * f.word_channels + channel, v);
    }

    Finish finish_;
    int parts_;
    Floats floor_;
};

// work(Finisher) with the mode that suits the finish.
template <class Isa, class Work>
void with_finisher(const Finish& finish, const Work& work) {
    const bool curved = finish.first > Curve::relu || finish.second > Curve::relu;
    const int mode = (finish.residual ? with_residual : 0) | (finish.floats ? with_floats : 0) |
                     (finish.words ? with_words : 0);
    bool done = false;
    if (!curved)
        repeat<8>([&](auto m) {
            if (m >= with_floats && mode == m) {
                work(Finisher<Isa, m>(finish));
                done = true;
            }
        });
    if (!done) work(Finisher<Isa, general>(finish));
}

}  // namespace nn::winograd
