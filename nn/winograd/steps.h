// A network as a list of steps over a workspace: what lowering makes of a graph. Steps hold packed
// weights and numbers of buffers, and are shared by executors.
#pragma once

#include <memory>
#include <vector>

#include "nn/graph.h"
#include "nn/winograd/pack.h"
#include "nn/winograd/workspace.h"

namespace nn::winograd {

class Step {
   public:
    virtual ~Step() = default;
    virtual void run(Workspace& space) const = 0;
};

// Where the values of a board go and what they pass on the way; -1: absent. See Finish.
struct Target {
    int channels = 0, word_channels = 0;
    int floats = -1, words = -1, residual = -1;
    int bias_vector = -1, bias_offset = 0;  // a vector that is added at every point
    Curve first = Curve::identity, second = Curve::identity;
    float lowest = 0, highest = 0;
    Buffer<float> bias, scale, shift, inverse_step;
    Buffer<float> point_bias;  // a residual of all positions

    Finish finish(const Workspace& space) const;
};

// A convolution of the input planes, at the cost of those numbers that are not zero: nine in ten
// are.
class FirstStep : public Step {
   public:
    FirstStep(int input, const Tensor& kernel, Target target);
    void run(Workspace& space) const override;

   private:
    void encode(Workspace& space, const float* planes) const;
    void mark(Workspace& space, const float* planes) const;
    bool uniform(const Workspace& space, const float* plane, std::size_t bits) const;
    void add_border(const Workspace& space, int plane, float value) const;
    void list_entries(Workspace& space, const float* planes) const;

    int input_, kernel_, planes_;
    Buffer<float> weights_, borders_;
    Target target_;
};

// A 3x3 convolution. With `reuse` the step before it transformed the same words.
class TowerStep : public Step {
   public:
    TowerStep(int words, int word_channels, const Tensor& kernel, std::vector<Group> groups,
              Target target);
    void reuse_transform() { reuse_ = true; }
    void run(Workspace& space) const override;

   private:
    int words_, word_channels_, pairs_;
    bool reuse_ = false;
    std::vector<Group> groups_;
    Target target_;
};

class PointsStep : public Step {
   public:
    PointsStep(int words, int word_channels, const Tensor& kernel, std::vector<Group> groups,
               Target target);
    void run(Workspace& space) const override;

   private:
    int words_, word_channels_, pairs_;
    std::vector<Group> groups_;
    Target target_;
};

// Point by point: scaled by constants, or by the sigmoid of a vector, and finished.
class PointwiseStep : public Step {
   public:
    PointwiseStep(int source, Target target) : source_(source), target_(std::move(target)) {}
    void scale_by(Buffer<float> scale) { scale_ = std::move(scale); }
    void excite_by(int vector) { excitation_ = vector; }
    void run(Workspace& space) const override;

   private:
    int source_, excitation_ = -1;
    Buffer<float> scale_;
    Target target_;
};

class PoolStep : public Step {
   public:
    PoolStep(int source, int channels, Pooling pooling, int out)
        : source_(source), channels_(channels), pooling_(pooling), out_(out) {}
    void run(Workspace& space) const override;

   private:
    int source_, channels_;
    Pooling pooling_;
    int out_;
};

class DenseStep : public Step {
   public:
    DenseStep(int source, const Node& node, int out);
    void run(Workspace& space) const override;

   private:
    int source_, inputs_, out_;
    Buffer<float> weights_, bias_;
};

// Copies a network's input that has no place on the board.
class InputStep : public Step {
   public:
    InputStep(int input, int size, int out) : input_(input), size_(size), out_(out) {}
    void run(Workspace& space) const override;

   private:
    int input_, size_, out_;
};

// A vector from other vectors or a board, number by number: out[i] = sum over the parts that have
// an i-th source, times scale, plus shift.
class VectorStep : public Step {
   public:
    struct Part {
        int source = 0;
        bool over_board = false;
        int begin = 0;             // in the result
        std::vector<int> indices;  // of the source; empty: in order, `count` of them
        int count = 0;
    };
    VectorStep(std::vector<Part> parts, int size, int out)
        : parts_(std::move(parts)), size_(size), out_(out) {}
    void scale_and_shift(std::vector<float> scale, std::vector<float> shift) {
        scale_ = std::move(scale);
        shift_ = std::move(shift);
    }
    void run(Workspace& space) const override;

   private:
    void add(const Workspace& space, const Part& part, int position, float* out) const;

    std::vector<Part> parts_;
    int size_, out_;
    std::vector<float> scale_, shift_;
};

// The activation of a vector, in place.
class ActivationStep : public Step {
   public:
    ActivationStep(int vector, int size, Activation kind)
        : vector_(vector), size_(size), kind_(kind) {}
    void run(Workspace& space) const override;

   private:
    int vector_, size_;
    Activation kind_;
};

// None for softplus, which no kernel has.
std::optional<Curve> curve_of(Activation activation);

}  // namespace nn::winograd
