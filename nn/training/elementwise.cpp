// Operations that treat every number alone, or with its channel's own weight.
#include <cmath>

#include "nn/training/operations.h"

namespace nn::training {

namespace {

// --- affine: y = scale x + shift

void affine_forward(Tape& tape, int n) {
    tape.for_samples([&](int i) {
        const auto x = tape.sample(tape.input(n, 0), i).array();
        tape.sample(n, i) = (x.colwise() * tape.weight(n, 0).col(0).array()).colwise() +
                            tape.weight(n, 1).col(0).array();
    });
}

void affine_backward(Tape& tape, int n) {
    const int x = tape.input(n, 0);
    tape.for_samples([&](int i) {
        const auto gradient = tape.sample_gradient(n, i).array();
        tape.weight_gradient(n, 0).array() +=
            (gradient * tape.sample(x, i).array()).rowwise().sum();
        tape.weight_gradient(n, 1).array() += gradient.rowwise().sum();
        if (tape.wants_gradient(x))
            tape.sample_gradient(x, i).array() +=
                gradient.colwise() * tape.weight(n, 0).col(0).array();
    });
}

// --- activation

float sigmoid(float x) { return activate(Activation::sigmoid, x); }

// The derivative of `activate`; 0 where it has a kink.
float slope(Activation activation, float x) {
    switch (activation) {
        case Activation::identity:
            return 1;
        case Activation::relu:
            return x > 0 ? 1.0f : 0.0f;
        case Activation::mish: {
            const float inner = std::tanh(activate(Activation::softplus, x));
            return inner + x * (1 - inner * inner) * sigmoid(x);
        }
        case Activation::silu:
            return sigmoid(x) * (1 + x * (1 - sigmoid(x)));
        case Activation::tanh: {
            const float y = std::tanh(x);
            return 1 - y * y;
        }
        case Activation::sigmoid:
            return sigmoid(x) * (1 - sigmoid(x));
        case Activation::softplus:
            return sigmoid(x);
        case Activation::square_root:
            return x > 0 ? 0.5f / std::sqrt(x) : 0.0f;
    }
    return 1;
}

void activation_forward(Tape& tape, int n) {
    const auto kind = tape.node(n).activation;
    tape.samples(n) =
        tape.samples(tape.input(n, 0)).unaryExpr([=](float x) { return activate(kind, x); });
}

void activation_backward(Tape& tape, int n) {
    const int x = tape.input(n, 0);
    if (!tape.wants_gradient(x)) return;
    const auto kind = tape.node(n).activation;
    const auto slopes = tape.samples(x).unaryExpr([=](float value) { return slope(kind, value); });
    tape.sample_gradients(x).array() += tape.sample_gradients(n).array() * slopes.array();
}

// --- add: y = a + b

void add_forward(Tape& tape, int n) {
    tape.samples(n) = tape.samples(tape.input(n, 0)) + tape.samples(tape.input(n, 1));
}

void add_backward(Tape& tape, int n) {
    for (const int x : tape.node(n).inputs)
        if (tape.wants_gradient(x)) tape.sample_gradients(x) += tape.sample_gradients(n);
}

// --- add_vector: y = x + v at every point

void add_vector_forward(Tape& tape, int n) {
    tape.for_samples([&](int i) {
        tape.sample(n, i) =
            tape.sample(tape.input(n, 0), i).colwise() + tape.sample(tape.input(n, 1), i).col(0);
    });
}

void add_vector_backward(Tape& tape, int n) {
    const int x = tape.input(n, 0), v = tape.input(n, 1);
    if (tape.wants_gradient(x)) tape.sample_gradients(x) += tape.sample_gradients(n);
    if (!tape.wants_gradient(v)) return;
    tape.for_samples(
        [&](int i) { tape.sample_gradient(v, i) += tape.sample_gradient(n, i).rowwise().sum(); });
}

// --- point_bias: y = x + a bias for every channel and point

void point_bias_forward(Tape& tape, int n) {
    tape.for_samples(
        [&](int i) { tape.sample(n, i) = tape.sample(tape.input(n, 0), i) + tape.weight(n, 0); });
}

void point_bias_backward(Tape& tape, int n) {
    const int x = tape.input(n, 0);
    tape.for_samples([&](int i) { tape.weight_gradient(n, 0) += tape.sample_gradient(n, i); });
    if (tape.wants_gradient(x)) tape.sample_gradients(x) += tape.sample_gradients(n);
}

}  // namespace

Rule affine_rule() { return {affine_forward, affine_backward}; }
Rule activation_rule() { return {activation_forward, activation_backward}; }
Rule add_rule() { return {add_forward, add_backward}; }
Rule add_vector_rule() { return {add_vector_forward, add_vector_backward}; }
Rule point_bias_rule() { return {point_bias_forward, point_bias_backward}; }

}  // namespace nn::training
