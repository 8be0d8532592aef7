// Networks as data: a list of operations in topological order with their weights, named inputs and
// outputs, and the facts of the network (game, encoding, licence …). Builders and importers make
// graphs, passes rewrite them, executors run them, files hold them. A graph is a value; nothing
// here computes an activation. Batch and board size are free wherever the operations allow it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nn {

// Row-major numbers: the last index runs fastest.
struct Tensor {
    std::vector<int> shape;
    std::vector<float> values;
    bool operator==(const Tensor&) const = default;
};

// Weights are listed in the order of Node::weights; [shapes] in brackets; a `?` may be absent, but
// then so is every weight after it.
enum class Operation : std::uint8_t {
    input,          // a named input of the network
    convolution,    // stride 1, zero padding, no kernel flip: kernel [out, in, k, k], bias? [out]
    dense,          // y = W x + b: weights [out, in], bias? [out]
    batch_norm,     // mean [c], variance [c], scale [c], shift [c]; uses Node::epsilon
    affine,         // scale [c], shift [c]
    activation,     // Node::activation alone
    add,            // two values of one shape
    add_vector,     // a board plus a vector, at every point
    pool,           // a board to a vector by Node::pooling
    squeeze_scale,  // board u, vector z of twice its channels: sigmoid(z[0..c)) u + z[c..2c)
    flatten,        // a board to a vector, channel after channel
    concatenate,    // vectors, one after another
    gather,         // a vector by Node::table
    point_bias,     // bias [c, points]: fixes the board size
};

// Softplus is ln(1 + e^x), mish x tanh(softplus(x)), silu x sigmoid(x).
enum class Activation : std::uint8_t {
    identity,
    relu,
    mish,
    silu,
    tanh,
    sigmoid,
    softplus,
    square_root,
};

// With m the mean over the board and d the board's side less 14:
enum class Pooling : std::uint8_t {
    mean,            // m
    mean_maximum,    // m, m d / 10, maximum (KataGo's pooling in blocks and policy heads)
    mean_quadratic,  // m, m d / 10, m (d² / 100 - 0.1) (KataGo's pooling in value heads)
};

// What a node yields for one position: numbers over the board, or just numbers.
struct Shape {
    int channels = 0;
    bool over_board = false;
    bool operator==(const Shape&) const = default;
    std::size_t size(int points) const {
        return static_cast<std::size_t>(channels) *
               static_cast<std::size_t>(over_board ? points : 1);
    }
};

// A convolution, dense or squeeze_scale may carry a fused residual, one input more than its own
// count: act(operation + residual). Every operation may carry a fused activation.
struct Node {
    Operation operation = Operation::input;
    std::string name = {};         // unique in its graph
    std::vector<int> inputs = {};  // indices of earlier nodes
    std::vector<Tensor> weights = {};
    Activation activation = Activation::identity;
    Pooling pooling = Pooling::mean;
    Shape shape = {};             // of an input; elsewhere it follows
    float epsilon = 0;            // of a batch norm
    std::vector<int> table = {};  // of a gather
    bool operator==(const Node&) const = default;
};

struct Output {
    std::string name;
    int node = 0;
    bool operator==(const Output&) const = default;
};

// Empty or zero where unknown.
struct Facts {
    std::string game;      // "go", "chess", "shogi"
    std::string encoding;  // the name of an engine encoding
    std::string name;
    std::string source;  // the format it was read from, or who made it
    std::string licence;
    int board = 0;  // side of the only board it serves; 0: any
    int blocks = 0, channels = 0;
    std::int64_t steps = 0;  // of training
    bool operator==(const Facts&) const = default;
};

// Inputs are named "planes" (over the board) and "globals". Outputs that have a meaning to others:
//   policy      logits, in the encoding's order
//   wdl         three logits: win, draw or no result, loss, as the mover sees it
//   value       in [-1, 1], as the mover sees it
//   ownership   per point in [-1, 1], 1 the mover's
//   score, lead         expected final score and lead in points, the mover's less the opponent's
//   score_deviation     of the score, in points
//   variance_time       remaining turns over which the value still moves
//   winloss_error, score_error   expected short-term errors of value and score
//   moves_left  in plies
struct Graph {
    Facts facts;
    std::vector<Node> nodes;
    std::vector<Output> outputs;

    bool operator==(const Graph&) const = default;

    // Appends a node and yields its index.
    int append(Node node);
    std::optional<int> output(std::string_view name) const;  // its node
    std::vector<int> input_nodes() const;
};

std::string_view name_of(Operation operation);
std::string_view name_of(Activation activation);
std::string_view name_of(Pooling pooling);
std::optional<Operation> operation_from(std::string_view name);
std::optional<Activation> activation_from(std::string_view name);
std::optional<Pooling> pooling_from(std::string_view name);
// What the weights of an operation are called, in order.
std::span<const std::string_view> weight_names(Operation operation);

// The activation functions, as every executor must compute them.
float activate(Activation activation, float x);

// The shape of every node on a board of this side. Fails with engine::Error naming the node and
// what it wants when an operation does not fit its inputs, its weights or the board.
std::vector<Shape> infer_shapes(const Graph& graph, int board);

// Everything that infer_shapes checks, on the network's own board (9 if it serves any), and names,
// limits and weights that are numbers. Fails with engine::Error.
void validate(const Graph& graph);

std::int64_t parameter_count(const Graph& graph);
// Floating-point operations for one position; a multiplication with its addition counts two.
std::int64_t flop_count(const Graph& graph, int board);

}  // namespace nn
