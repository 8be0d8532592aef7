#include "nn/graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

#include "engine/base/error.h"

namespace nn {

namespace {

using engine::fail;

constexpr int most_channels = 1 << 17, most_board = 32, most_nodes = 20000;
constexpr std::int64_t most_numbers = std::int64_t{1} << 29;

constexpr std::array<std::string_view, 14> operation_names = {
    "input", "convolution",   "dense",   "batch_norm",  "affine", "activation", "add", "add_vector",
    "pool",  "squeeze_scale", "flatten", "concatenate", "gather", "point_bias"};
constexpr std::array<std::string_view, 8> activation_names = {
    "identity", "relu", "mish", "silu", "tanh", "sigmoid", "softplus", "square_root"};
constexpr std::array<std::string_view, 3> pooling_names = {"mean", "mean_maximum",
                                                           "mean_quadratic"};

template <class Kind, std::size_t count>
std::optional<Kind> find_name(const std::array<std::string_view, count>& names,
                              std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return {};
    return static_cast<Kind>(found - names.begin());
}

std::string text_of(std::span<const int> shape) {
    return fmt::format("[{}]", fmt::join(shape, ","));
}

std::string text_of(Shape shape) {
    return fmt::format("{} {}", shape.channels, shape.over_board ? "planes" : "numbers");
}

// One node under inspection with the shapes before it.
struct Inference {
    const Node& node;
    std::vector<Shape> inputs;
    int board;

    int points() const { return board * board; }
    const Tensor& weight(std::size_t i) const { return node.weights[i]; }

    template <class... Parts>
    [[noreturn]] void refuse(fmt::format_string<Parts...> text, Parts&&... parts) const {
        fail("{} \"{}\": {}", name_of(node.operation), node.name,
             fmt::format(text, std::forward<Parts>(parts)...));
    }

    void expect_inputs(std::size_t count, bool residual_allowed = false) const {
        const auto found = inputs.size();
        if (found != count && !(residual_allowed && found == count + 1))
            refuse("expected {} inputs, found {}", count, found);
    }
    void expect_board(std::size_t i) const {
        if (!inputs[i].over_board) refuse("expected planes as input {}, found a vector", i);
    }
    void expect_vector(std::size_t i) const {
        if (inputs[i].over_board) refuse("expected a vector as input {}, found planes", i);
    }
    void expect_weights(std::size_t least, std::size_t most) const {
        const auto found = node.weights.size();
        if (found < least || found > most)
            refuse("expected {} to {} weights, found {}", least, most, found);
    }
    void expect_shape(std::size_t i, const std::vector<int>& shape) const {
        if (weight(i).shape == shape) return;
        refuse("expected {} of shape {}, found {}", weight_names(node.operation)[i], text_of(shape),
               text_of(weight(i).shape));
    }
    // The fused residual, if any, must look like the result.
    Shape with_residual(std::size_t own_inputs, Shape result) const {
        if (inputs.size() > own_inputs && inputs[own_inputs] != result)
            refuse("expected a residual of {}, found {}", text_of(result),
                   text_of(inputs[own_inputs]));
        return result;
    }
};

Shape shape_of_input(const Inference& c) {
    c.expect_inputs(0);
    c.expect_weights(0, 0);
    if (c.node.shape.channels < 1 || c.node.shape.channels > most_channels)
        c.refuse("expected 1 to {} channels, found {}", most_channels, c.node.shape.channels);
    return c.node.shape;
}

Shape shape_of_convolution(const Inference& c) {
    c.expect_inputs(1, true);
    c.expect_board(0);
    c.expect_weights(1, 2);
    const auto& kernel = c.weight(0).shape;
    if (kernel.size() != 4 || kernel[2] != kernel[3] || kernel[2] % 2 == 0 || kernel[2] > 9)
        c.refuse("expected a square kernel of odd side up to 9, found {}", text_of(kernel));
    c.expect_shape(0, {kernel[0], c.inputs[0].channels, kernel[2], kernel[2]});
    if (c.node.weights.size() > 1) c.expect_shape(1, {kernel[0]});
    return c.with_residual(1, {kernel[0], true});
}

Shape shape_of_dense(const Inference& c) {
    c.expect_inputs(1, true);
    c.expect_vector(0);
    c.expect_weights(1, 2);
    const auto& weights = c.weight(0).shape;
    if (weights.size() != 2) c.refuse("expected a matrix, found {}", text_of(weights));
    if (weights[1] != c.inputs[0].channels)
        c.refuse("expected {} numbers, found {} on a board of {}", weights[1], c.inputs[0].channels,
                 c.board);
    if (c.node.weights.size() > 1) c.expect_shape(1, {weights[0]});
    return c.with_residual(1, {weights[0], false});
}

Shape shape_of_channelwise(const Inference& c, std::size_t weights) {
    c.expect_inputs(1);
    c.expect_weights(weights, weights);
    for (std::size_t i = 0; i < weights; ++i) c.expect_shape(i, {c.inputs[0].channels});
    return c.inputs[0];
}

Shape shape_of_add(const Inference& c) {
    c.expect_inputs(2);
    c.expect_weights(0, 0);
    return c.with_residual(1, c.inputs[0]);
}

Shape shape_of_add_vector(const Inference& c) {
    c.expect_inputs(2);
    c.expect_weights(0, 0);
    c.expect_board(0);
    c.expect_vector(1);
    if (c.inputs[0].channels != c.inputs[1].channels)
        c.refuse("expected a vector of {}, found {}", c.inputs[0].channels, c.inputs[1].channels);
    return c.inputs[0];
}

Shape shape_of_pool(const Inference& c) {
    c.expect_inputs(1);
    c.expect_weights(0, 0);
    c.expect_board(0);
    return {c.inputs[0].channels * (c.node.pooling == Pooling::mean ? 1 : 3), false};
}

Shape shape_of_squeeze_scale(const Inference& c) {
    c.expect_inputs(2, true);
    c.expect_weights(0, 0);
    c.expect_board(0);
    c.expect_vector(1);
    if (c.inputs[1].channels != 2 * c.inputs[0].channels)
        c.refuse("expected a vector of {}, found {}", 2 * c.inputs[0].channels,
                 c.inputs[1].channels);
    return c.with_residual(2, c.inputs[0]);
}

Shape shape_of_flatten(const Inference& c) {
    c.expect_inputs(1);
    c.expect_weights(0, 0);
    c.expect_board(0);
    return {c.inputs[0].channels * c.points(), false};
}

Shape shape_of_concatenate(const Inference& c) {
    c.expect_weights(0, 0);
    if (c.inputs.empty()) c.refuse("expected inputs, found none");
    std::int64_t channels = 0;
    for (std::size_t i = 0; i < c.inputs.size(); ++i) {
        c.expect_vector(i);
        channels += c.inputs[i].channels;
    }
    if (channels > most_numbers) c.refuse("too many numbers: {}", channels);
    return {static_cast<int>(channels), false};
}

Shape shape_of_gather(const Inference& c) {
    c.expect_inputs(1);
    c.expect_weights(0, 0);
    c.expect_vector(0);
    if (c.node.table.empty()) c.refuse("its table is empty");
    for (const int index : c.node.table)
        if (index < 0 || index >= c.inputs[0].channels)
            c.refuse("expected indices under {}, found {}", c.inputs[0].channels, index);
    return {static_cast<int>(c.node.table.size()), false};
}

Shape shape_of_point_bias(const Inference& c) {
    c.expect_inputs(1);
    c.expect_weights(1, 1);
    c.expect_board(0);
    c.expect_shape(0, {c.inputs[0].channels, c.points()});
    return c.inputs[0];
}

Shape shape_of(const Inference& c) {
    switch (c.node.operation) {
        case Operation::input:
            return shape_of_input(c);
        case Operation::convolution:
            return shape_of_convolution(c);
        case Operation::dense:
            return shape_of_dense(c);
        case Operation::batch_norm:
            return shape_of_channelwise(c, 4);
        case Operation::affine:
            return shape_of_channelwise(c, 2);
        case Operation::activation:
            return shape_of_channelwise(c, 0);
        case Operation::add:
            return shape_of_add(c);
        case Operation::add_vector:
            return shape_of_add_vector(c);
        case Operation::pool:
            return shape_of_pool(c);
        case Operation::squeeze_scale:
            return shape_of_squeeze_scale(c);
        case Operation::flatten:
            return shape_of_flatten(c);
        case Operation::concatenate:
            return shape_of_concatenate(c);
        case Operation::gather:
            return shape_of_gather(c);
        case Operation::point_bias:
            return shape_of_point_bias(c);
    }
    c.refuse("unknown operation");
}

void check_tensor(const Node& node, const Tensor& tensor) {
    std::int64_t count = 1;
    for (const int side : tensor.shape) {
        if (side < 1 || side > most_numbers || (count *= side) > most_numbers)
            fail("\"{}\": impossible shape {}", node.name, text_of(tensor.shape));
    }
    if (static_cast<std::int64_t>(tensor.values.size()) != count)
        fail("\"{}\": shape {} wants {} numbers, found {}", node.name, text_of(tensor.shape), count,
             tensor.values.size());
    for (const float value : tensor.values)
        if (!std::isfinite(value))
            fail("\"{}\": expected finite weights, found {}", node.name, value);
}

void check_weights(const Node& node) {
    for (const auto& tensor : node.weights) check_tensor(node, tensor);
    if (node.operation != Operation::batch_norm) return;
    if (!std::isfinite(node.epsilon) || node.epsilon < 0)
        fail("\"{}\": expected an epsilon of 0 or more, found {}", node.name, node.epsilon);
    for (const float variance : node.weights[1].values)
        if (!(variance + node.epsilon > 0))
            fail("\"{}\": expected positive variances, found {}", node.name, variance);
}

std::int64_t flops_of(const Node& node, Shape shape, Shape input, int points) {
    const auto size = static_cast<std::int64_t>(shape.size(points));
    switch (node.operation) {
        case Operation::convolution:
            return 2 * size * node.weights[0].shape[1] * node.weights[0].shape[2] *
                   node.weights[0].shape[3];
        case Operation::dense:
            return 2 * size * node.weights[0].shape[1];
        case Operation::batch_norm:
        case Operation::affine:
        case Operation::squeeze_scale:
            return 2 * size;
        case Operation::add:
        case Operation::add_vector:
        case Operation::point_bias:
        case Operation::activation:
            return size;
        case Operation::pool:
            return static_cast<std::int64_t>(input.size(points));
        default:
            return 0;
    }
}

}  // namespace

int Graph::append(Node node) {
    nodes.push_back(std::move(node));
    return static_cast<int>(nodes.size()) - 1;
}

std::optional<int> Graph::output(std::string_view name) const {
    for (const auto& output : outputs)
        if (output.name == name) return output.node;
    return {};
}

std::vector<int> Graph::input_nodes() const {
    std::vector<int> found;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].operation == Operation::input) found.push_back(static_cast<int>(i));
    return found;
}

std::string_view name_of(Operation operation) {
    return operation_names[static_cast<std::size_t>(operation)];
}
std::string_view name_of(Activation activation) {
    return activation_names[static_cast<std::size_t>(activation)];
}
std::string_view name_of(Pooling pooling) {
    return pooling_names[static_cast<std::size_t>(pooling)];
}

std::optional<Operation> operation_from(std::string_view name) {
    return find_name<Operation>(operation_names, name);
}
std::optional<Activation> activation_from(std::string_view name) {
    return find_name<Activation>(activation_names, name);
}
std::optional<Pooling> pooling_from(std::string_view name) {
    return find_name<Pooling>(pooling_names, name);
}

std::span<const std::string_view> weight_names(Operation operation) {
    static constexpr std::array<std::string_view, 2> linear = {"weight", "bias"};
    static constexpr std::array<std::string_view, 4> norm = {"mean", "variance", "scale", "shift"};
    static constexpr std::array<std::string_view, 2> affine = {"scale", "shift"};
    switch (operation) {
        case Operation::convolution:
        case Operation::dense:
            return linear;
        case Operation::batch_norm:
            return norm;
        case Operation::affine:
            return affine;
        case Operation::point_bias:
            return std::span(linear).last(1);
        default:
            return {};
    }
}

namespace {

float softplus(float x) { return x > 20 ? x : std::log1p(std::exp(x)); }

}  // namespace

float activate(Activation activation, float x) {
    switch (activation) {
        case Activation::identity:
            return x;
        case Activation::relu:
            return std::max(x, 0.0f);
        case Activation::mish:
            return x * std::tanh(softplus(x));
        case Activation::silu:
            return x / (1 + std::exp(-x));
        case Activation::tanh:
            return std::tanh(x);
        case Activation::sigmoid:
            return 1 / (1 + std::exp(-x));
        case Activation::softplus:
            return softplus(x);
        case Activation::square_root:
            return std::sqrt(std::max(x, 0.0f));
    }
    return x;
}

std::vector<Shape> infer_shapes(const Graph& graph, int board) {
    std::vector<Shape> shapes;
    shapes.reserve(graph.nodes.size());
    for (const auto& node : graph.nodes) {
        Inference current{node, {}, board};
        for (const int input : node.inputs) {
            if (input < 0 || input >= static_cast<int>(shapes.size()))
                current.refuse("input {} is no earlier operation", input);
            current.inputs.push_back(shapes[static_cast<std::size_t>(input)]);
        }
        const auto shape = shape_of(current);
        if (static_cast<std::int64_t>(shape.size(board * board)) > most_numbers)
            current.refuse("yields too many numbers");
        shapes.push_back(shape);
    }
    return shapes;
}

void validate(const Graph& graph) {
    if (graph.nodes.empty()) fail("the network has no operations");
    if (graph.nodes.size() > most_nodes)
        fail("expected at most {} operations, found {}", most_nodes, graph.nodes.size());
    const int board = graph.facts.board;
    if (board < 0 || board > most_board)
        fail("expected a board of 0 to {}, found {}", most_board, board);
    infer_shapes(graph, board == 0 ? 9 : board);
    std::unordered_set<std::string_view> names;
    for (const auto& node : graph.nodes) {
        if (node.name.empty() || !names.insert(node.name).second)
            fail("expected names that differ, found \"{}\" again", node.name);
        check_weights(node);
    }
    if (graph.outputs.empty()) fail("the network has no outputs");
    for (const auto& output : graph.outputs)
        if (output.node < 0 || output.node >= static_cast<int>(graph.nodes.size()))
            fail("output \"{}\": no operation {}", output.name, output.node);
}

std::int64_t parameter_count(const Graph& graph) {
    std::size_t count = 0;
    for (const auto& node : graph.nodes)
        for (const auto& tensor : node.weights) count += tensor.values.size();
    return static_cast<std::int64_t>(count);
}

std::int64_t flop_count(const Graph& graph, int board) {
    const auto shapes = infer_shapes(graph, board);
    std::int64_t count = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const auto& node = graph.nodes[i];
        const auto input =
            node.inputs.empty() ? Shape{} : shapes[static_cast<std::size_t>(node.inputs[0])];
        count += flops_of(node, shapes[i], input, board * board);
    }
    return count;
}

}  // namespace nn
