// The blocked side of a tape: values and gradients of nodes over the board in blocks, beside the
// plain ones, and what a step of the oneDNN trainer is. See nn/training/tape.h for the plain side.
#pragma once

#include <memory>
#include <new>
#include <utility>

#include "nn/training/onednn/convolution.h"
#include "nn/training/tape.h"

namespace nn::training {

// Zeros, aligned for any vector.
template <class Number>
class Buffer {
   public:
    void resize(std::size_t count) { numbers_.reset(new (std::align_val_t{64}) Number[count]()); }
    Number* data() { return numbers_.get(); }
    explicit operator bool() const { return numbers_ != nullptr; }

   private:
    struct Free {
        void operator()(Number* numbers) const {
            ::operator delete[](numbers, std::align_val_t{64});
        }
    };
    std::unique_ptr<Number[], Free> numbers_;
};

template <class Number>
struct Field {
    Buffer<Number> value, gradient;
    bool written = false;  // the gradient, on this way back: else what it holds is old
};

template <class Number>
struct Blocked {
    Tape& tape;
    Device& device;
    const Loops<Number>& loops;
    std::vector<Field<Number>> fields = {};  // per node; empty where only plain
    Buffer<Number> scratch = {};

    Extent extent(int n) const { return {tape.size, tape.channels(n), tape.points(n)}; }
    Number* value(int n) { return fields[at(n)].value.data(); }
    bool has(int n) const { return static_cast<bool>(fields[at(n)].value); }
    void reserve(int n) {
        fields[at(n)].value.resize(extent(n).count());
        if (tape.wants_gradient(n)) fields[at(n)].gradient.resize(extent(n).count());
    }

    // To read: zeros if nothing has flown back.
    Number* gradient(int n) {
        auto& field = fields[at(n)];
        if (!std::exchange(field.written, true))
            std::fill_n(field.gradient.data(), extent(n).count(), Number{});
        return field.gradient.data();
    }
    // Lets `write(place)` fill the gradient of `n`, or something to be added to it.
    template <class Write>
    void give_gradient(int n, Write write) {
        auto& field = fields[at(n)];
        if (!tape.wants_gradient(n)) return;
        auto* const place = field.gradient.data();
        if (!std::exchange(field.written, true)) return write(place);
        write(scratch.data());
        loops.sum(extent(n).count(), place, scratch.data(), place);
    }
};

class Step {
   public:
    virtual ~Step() = default;
    virtual void load() {}  // new weights are on the tape
    virtual void forward() = 0;
    virtual void backward() = 0;
    virtual void collect() {}  // what is summed elsewhere goes to the tape's weight gradients
};

}  // namespace nn::training
