// An array of numbers that begins at a cache line, zero at first: vectors that straddle two lines
// cost twice.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>

namespace nn::winograd {

template <class Number>
class Buffer {
   public:
    Buffer() = default;
    explicit Buffer(std::size_t size) : size_(size) {
        numbers_.reset(static_cast<Number*>(
            ::operator new(std::max<std::size_t>(size, 1) * sizeof(Number), line)));
        std::fill_n(numbers_.get(), size, Number{});
    }

    Number* data() const { return numbers_.get(); }
    std::size_t size() const { return size_; }
    Number& operator[](std::size_t i) const { return numbers_.get()[i]; }

   private:
    static constexpr std::align_val_t line{64};
    struct Free {
        void operator()(Number* numbers) const { ::operator delete(numbers, line); }
    };
    std::unique_ptr<Number, Free> numbers_;
    std::size_t size_ = 0;
};

}  // namespace nn::winograd
