// Operations that only move numbers: flatten, concatenate, gather.
#include "nn/training/operations.h"

namespace nn::training {

namespace {

void flatten_forward(Tape& tape, int n) { tape.samples(n) = tape.samples(tape.input(n, 0)); }

void flatten_backward(Tape& tape, int n) {
    const int x = tape.input(n, 0);
    if (tape.wants_gradient(x)) tape.sample_gradients(x) += tape.sample_gradients(n);
}

void concatenate_forward(Tape& tape, int n) {
    Eigen::Index start = 0;
    for (const int x : tape.node(n).inputs) {
        tape.samples(n).middleCols(start, tape.channels(x)) = tape.samples(x);
        start += tape.channels(x);
    }
}

void concatenate_backward(Tape& tape, int n) {
    Eigen::Index start = 0;
    for (const int x : tape.node(n).inputs) {
        const auto part = tape.sample_gradients(n).middleCols(start, tape.channels(x));
        if (tape.wants_gradient(x)) tape.sample_gradients(x) += part;
        start += tape.channels(x);
    }
}

void gather_forward(Tape& tape, int n) {
    const auto& table = tape.node(n).table;
    for (std::size_t i = 0; i < table.size(); ++i)
        tape.samples(n).col(static_cast<Eigen::Index>(i)) =
            tape.samples(tape.input(n, 0)).col(table[i]);
}

void gather_backward(Tape& tape, int n) {
    const int x = tape.input(n, 0);
    if (!tape.wants_gradient(x)) return;
    const auto& table = tape.node(n).table;
    for (std::size_t i = 0; i < table.size(); ++i)
        tape.sample_gradients(x).col(table[i]) +=
            tape.sample_gradients(n).col(static_cast<Eigen::Index>(i));
}

}  // namespace

Rule flatten_rule() { return {flatten_forward, flatten_backward}; }
Rule concatenate_rule() { return {concatenate_forward, concatenate_backward}; }
Rule gather_rule() { return {gather_forward, gather_backward}; }

}  // namespace nn::training
