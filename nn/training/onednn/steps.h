// The steps that a graph becomes, each forward and backward side by side: on blocked values where
// it pays, by the reference's rules on plain ones elsewhere, and the ways between the two.
#pragma once

#include <optional>

#include "nn/training/onednn/field.h"
#include "nn/training/onednn/paired_gradient.h"
#include "nn/training/onednn/tiled.h"
#include "nn/training/operations.h"

namespace nn::training {

// By Kernel, which is a Convolution<Number> or, in fp32, a TiledConvolution.
template <class Number, class Kernel = Convolution<Number>>
class ConvolutionStep : public Step {
   public:
    ConvolutionStep(Blocked<Number>& blocked, int n);
    void load() override;
    void forward() override;
    void backward() override;
    void collect() override;

   private:
    int side() const { return blocked_.tape.node(n_).weights[0].shape[2]; }
    Kernel kernel() const;

    Blocked<Number>& blocked_;
    int n_, x_;
    bool biased_;
    Kernel convolution_;
    std::optional<PairedGradient> paired_;  // of bf16 without AMX, in place of the library's
};

// A batch norm with the addition of `residual` (unless -1) and the relu that follow: y =
// relu(norm(x)
// + residual), the value of node `y`.
template <class Number>
class NormStep : public Step {
   public:
    struct Nodes {
        int norm, residual, y;
        bool relu;
    };
    NormStep(Blocked<Number>& blocked, Nodes nodes);
    void forward() override;
    void backward() override;

   private:
    using Row = std::vector<float>;

    float weight(int which, int channel) const;
    void measure();

    Blocked<Number>& blocked_;
    Nodes nodes_;
    int x_;
    Row mean_, inverse_, scale_, shift_;  // inverse of the deviation; y = scale x + shift
};

template <class Number>
class AddStep : public Step {
   public:
    AddStep(Blocked<Number>& blocked, int n) : blocked_(blocked), n_(n) {}
    void forward() override;
    void backward() override;

   private:
    Blocked<Number>& blocked_;
    int n_;
};

template <class Number>
class ReluStep : public Step {
   public:
    ReluStep(Blocked<Number>& blocked, int n) : blocked_(blocked), n_(n) {}
    void forward() override;
    void backward() override;

   private:
    Blocked<Number>& blocked_;
    int n_;
};

// From a plain value to blocks.
template <class Number>
class BlockStep : public Step {
   public:
    BlockStep(Blocked<Number>& blocked, int n) : blocked_(blocked), n_(n) {}
    void forward() override;
    void backward() override;

   private:
    Blocked<Number>& blocked_;
    int n_;
};

// From blocks to a plain value.
template <class Number>
class UnblockStep : public Step {
   public:
    UnblockStep(Blocked<Number>& blocked, int n) : blocked_(blocked), n_(n) {}
    void forward() override;
    void backward() override;

   private:
    Blocked<Number>& blocked_;
    int n_;
};

class PlainStep : public Step {
   public:
    PlainStep(Tape& tape, int n) : tape_(tape), n_(n), rule_(rule_of(tape.node(n).operation)) {}
    void forward() override { rule_.forward(tape_, n_); }
    void backward() override { rule_.backward(tape_, n_); }

   private:
    Tape& tape_;
    int n_;
    Rule rule_;
};

}  // namespace nn::training
