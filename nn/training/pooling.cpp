// Operations between a board and a vector: pooling, and squeeze and excitation's scaling.
#include <cmath>

#include "nn/training/operations.h"

namespace nn::training {

namespace {

// The factors that take the mean to the second and, unless it is a maximum, the third part.
struct Factors {
    float second, third;
};
Factors factors_of(const Tape& tape) {
    const float side = static_cast<float>(tape.board) - 14;
    return {side * 0.1f, side * side * 0.01f - 0.1f};
}

void pool_forward(Tape& tape, int n) {
    const int x = tape.input(n, 0), count = tape.channels(x);
    const auto kind = tape.node(n).pooling;
    const auto [second, third] = factors_of(tape);
    for (int i = 0; i < tape.size; ++i) {
        const auto planes = tape.sample(x, i);
        auto out = tape.sample(n, i).col(0);
        out.head(count) = planes.rowwise().mean();
        if (kind == Pooling::mean) continue;
        out.segment(count, count) = out.head(count) * second;
        if (kind == Pooling::mean_maximum)
            out.tail(count) = planes.rowwise().maxCoeff();
        else
            out.tail(count) = out.head(count) * third;
    }
}

void pool_backward(Tape& tape, int n) {
    const int x = tape.input(n, 0), count = tape.channels(x);
    if (!tape.wants_gradient(x)) return;
    const auto kind = tape.node(n).pooling;
    const auto [second, third] = factors_of(tape);
    for (int i = 0; i < tape.size; ++i) {
        const auto gradient = tape.sample_gradient(n, i).col(0);
        auto planes = tape.sample_gradient(x, i);
        for (int c = 0; c < count; ++c) {
            float mean = gradient[c];
            if (kind != Pooling::mean) mean += gradient[count + c] * second;
            if (kind == Pooling::mean_quadratic) mean += gradient[2 * count + c] * third;
            planes.row(c).array() += mean / static_cast<float>(tape.points(x));
            if (kind != Pooling::mean_maximum) continue;
            Eigen::Index peak = 0;
            tape.sample(x, i).row(c).maxCoeff(&peak);
            planes(c, peak) += gradient[2 * count + c];
        }
    }
}

float gate(float z) { return activate(Activation::sigmoid, z); }

void squeeze_scale_forward(Tape& tape, int n) {
    const int u = tape.input(n, 0), z = tape.input(n, 1), count = tape.channels(n);
    for (int i = 0; i < tape.size; ++i) {
        const auto vector = tape.sample(z, i).col(0);
        for (int c = 0; c < count; ++c)
            tape.sample(n, i).row(c) =
                tape.sample(u, i).row(c).array() * gate(vector[c]) + vector[count + c];
    }
}

void squeeze_scale_backward(Tape& tape, int n) {
    const int u = tape.input(n, 0), z = tape.input(n, 1), count = tape.channels(n);
    for (int i = 0; i < tape.size; ++i)
        for (int c = 0; c < count; ++c) {
            const float open = gate(tape.sample(z, i)(c, 0));
            const auto gradient = tape.sample_gradient(n, i).row(c);
            if (tape.wants_gradient(u)) tape.sample_gradient(u, i).row(c) += gradient * open;
            if (!tape.wants_gradient(z)) continue;
            auto vector = tape.sample_gradient(z, i).col(0);
            vector[c] += gradient.dot(tape.sample(u, i).row(c)) * open * (1 - open);
            vector[count + c] += gradient.sum();
        }
}

}  // namespace

Rule pool_rule() { return {pool_forward, pool_backward}; }
Rule squeeze_scale_rule() { return {squeeze_scale_forward, squeeze_scale_backward}; }

}  // namespace nn::training
