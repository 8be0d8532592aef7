// Convolution and dense layers: products of matrices.
#include <algorithm>

#include "nn/training/operations.h"

namespace nn::training {

namespace {

// Calls visit(plane row, column row, count) for every stretch that a plane shifted by (dx, dy)
// shares with the board.
template <class Visit>
void for_shifted_rows(int board, int dx, int dy, Visit visit) {
    const int left = std::max(0, -dx), right = std::min(board, board - dx);
    if (left >= right) return;
    for (int y = std::max(0, -dy); y < std::min(board, board - dy); ++y)
        visit((y + dy) * board + left + dx, y * board + left, right - left);
}

// Calls visit(channel, dx, dy, row) for every row of the matrix of columns.
template <class Visit>
void for_columns(int channels, int side, Visit visit) {
    int row = 0;
    for (int c = 0; c < channels; ++c)
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) visit(c, x - side / 2, y - side / 2, row++);
}

// im2col: a row for every channel and place in the kernel, a column for every point.
Matrix columns_of(const Rows& planes, int board, int side) {
    Matrix columns = Matrix::Zero(planes.rows() * side * side, planes.cols());
    for_columns(static_cast<int>(planes.rows()), side, [&](int c, int dx, int dy, int row) {
        for_shifted_rows(board, dx, dy, [&](int from, int to, int count) {
            columns.row(row).segment(to, count) = planes.row(c).segment(from, count);
        });
    });
    return columns;
}

// Its transpose: what every column says flows back into the planes.
void add_columns(const Matrix& columns, int board, int side, Rows planes) {
    for_columns(static_cast<int>(planes.rows()), side, [&](int c, int dx, int dy, int row) {
        for_shifted_rows(board, dx, dy, [&](int to, int from, int count) {
            planes.row(c).segment(to, count) += columns.row(row).segment(from, count);
        });
    });
}

bool has_bias(const Tape& tape, int n) { return tape.node(n).weights.size() > 1; }
int side_of(const Tape& tape, int n) { return tape.node(n).weights[0].shape[2]; }

void convolution_forward(Tape& tape, int n) {
    for (int i = 0; i < tape.size; ++i) {
        const auto columns =
            columns_of(tape.sample(tape.input(n, 0), i), tape.board, side_of(tape, n));
        tape.sample(n, i).noalias() = tape.weight(n, 0) * columns;
        if (has_bias(tape, n)) tape.sample(n, i).colwise() += tape.weight(n, 1).col(0);
    }
}

void convolution_backward(Tape& tape, int n) {
    const int x = tape.input(n, 0), side = side_of(tape, n);
    for (int i = 0; i < tape.size; ++i) {
        const auto gradient = tape.sample_gradient(n, i);
        const auto columns = columns_of(tape.sample(x, i), tape.board, side);
        tape.weight_gradient(n, 0).noalias() += gradient * columns.transpose();
        if (has_bias(tape, n)) tape.weight_gradient(n, 1) += gradient.rowwise().sum();
        if (tape.wants_gradient(x))
            add_columns(tape.weight(n, 0).transpose() * gradient, tape.board, side,
                        tape.sample_gradient(x, i));
    }
}

void dense_forward(Tape& tape, int n) {
    tape.samples(n).noalias() = tape.samples(tape.input(n, 0)) * tape.weight(n, 0).transpose();
    if (has_bias(tape, n)) tape.samples(n).rowwise() += tape.weight(n, 1).col(0).transpose();
}

void dense_backward(Tape& tape, int n) {
    const int x = tape.input(n, 0);
    const auto gradient = tape.sample_gradients(n);
    tape.weight_gradient(n, 0).noalias() += gradient.transpose() * tape.samples(x);
    if (has_bias(tape, n)) tape.weight_gradient(n, 1) += gradient.colwise().sum().transpose();
    if (tape.wants_gradient(x)) tape.sample_gradients(x).noalias() += gradient * tape.weight(n, 0);
}

}  // namespace

Rule convolution_rule() { return {convolution_forward, convolution_backward}; }
Rule dense_rule() { return {dense_forward, dense_backward}; }

}  // namespace nn::training
