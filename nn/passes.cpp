#include "nn/passes.h"

#include <algorithm>
#include <cmath>

#include "nn/compose.h"
#include "nn/index.h"

namespace nn {

namespace {

// How often every node is read, by nodes and as an output.
std::vector<int> use_counts(const Graph& graph) {
    std::vector<int> uses(graph.nodes.size(), 0);
    for (const auto& node : graph.nodes)
        for (const int input : node.inputs) ++uses[at(input)];
    for (const auto& output : graph.outputs) ++uses[at(output.node)];
    return uses;
}

// Lets everything that reads `from` read `to`; `from` is then dead.
void redirect(Graph& graph, int from, int to) {
    for (auto& node : graph.nodes) std::replace(node.inputs.begin(), node.inputs.end(), from, to);
    for (auto& output : graph.outputs)
        if (output.node == from) output.node = to;
}

// The scale and shift that a batch norm amounts to, computed in double.
void fold_to_affine(Node& node) {
    auto& scale = node.weights[2].values;
    auto& shift = node.weights[3].values;
    for (std::size_t c = 0; c < scale.size(); ++c) {
        const double factor = scale[c] / deviation(node, c);
        shift[c] = static_cast<float>(shift[c] - factor * node.weights[0].values[c]);
        scale[c] = static_cast<float>(factor);
    }
    node.operation = Operation::affine;
    node.weights.erase(node.weights.begin(), node.weights.begin() + 2);
    node.epsilon = 0;
}

bool linear(const Node& node) {
    return (node.operation == Operation::convolution || node.operation == Operation::dense) &&
           node.inputs.size() == 1 && node.activation == Activation::identity;
}

void absorb_affine(Node& layer, const Node& affine) {
    const auto& scale = affine.weights[0].values;
    const auto& shift = affine.weights[1].values;
    if (layer.weights.size() == 1)
        layer.weights.push_back({{layer.weights[0].shape[0]}, std::vector<float>(scale.size())});
    auto& weights = layer.weights[0].values;
    auto& bias = layer.weights[1].values;
    const auto row = weights.size() / scale.size();
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= scale[i / row];
    for (std::size_t c = 0; c < bias.size(); ++c) bias[c] = bias[c] * scale[c] + shift[c];
    layer.activation = affine.activation;
}

// act(x + r) may be computed by the operation that yields x.
bool takes_residual(const Node& node) {
    return linear(node) || (node.operation == Operation::squeeze_scale && node.inputs.size() == 2 &&
                            node.activation == Activation::identity);
}

// Which of an addition's two inputs can absorb it: one that nothing else reads. The later one,
// since by then the other is known.
int absorbing_input(const Graph& graph, const std::vector<int>& uses, const Node& add) {
    const int later = std::max(add.inputs[0], add.inputs[1]);
    const bool ok = add.inputs[0] != add.inputs[1] && uses[at(later)] == 1 &&
                    takes_residual(graph.nodes[at(later)]);
    return ok ? later : -1;
}

void fuse_additions(Graph& graph) {
    const auto uses = use_counts(graph);
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        const auto& node = graph.nodes[i];
        if (node.operation != Operation::add) continue;
        const int layer = absorbing_input(graph, uses, node);
        if (layer < 0) continue;
        const int residual = node.inputs[0] == layer ? node.inputs[1] : node.inputs[0];
        graph.nodes[at(layer)].inputs.push_back(residual);
        graph.nodes[at(layer)].activation = node.activation;
        redirect(graph, static_cast<int>(i), layer);
    }
}

void fuse_activations(Graph& graph) {
    const auto uses = use_counts(graph);
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        const auto& node = graph.nodes[i];
        if (node.operation != Operation::activation) continue;
        auto& before = graph.nodes[at(node.inputs[0])];
        if (before.operation == Operation::input || before.activation != Activation::identity ||
            uses[at(node.inputs[0])] != 1)
            continue;
        before.activation = node.activation;
        redirect(graph, static_cast<int>(i), node.inputs[0]);
    }
}

std::vector<bool> needed_nodes(const Graph& graph) {
    std::vector<bool> needed(graph.nodes.size(), false);
    for (const auto& output : graph.outputs) needed[at(output.node)] = true;
    for (std::size_t i = graph.nodes.size(); i-- > 0;) {
        // The caller hands over every input, needed or not.
        if (graph.nodes[i].operation == Operation::input) needed[i] = true;
        if (needed[i])
            for (const int input : graph.nodes[i].inputs) needed[at(input)] = true;
    }
    return needed;
}

void drop_dead_nodes(Graph& graph) {
    const auto needed = needed_nodes(graph);
    std::vector<int> moved(graph.nodes.size(), -1);
    std::vector<Node> kept;
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        if (!needed[i]) continue;
        moved[i] = static_cast<int>(kept.size());
        kept.push_back(std::move(graph.nodes[i]));
        for (int& input : kept.back().inputs) input = moved[at(input)];
    }
    graph.nodes = std::move(kept);
    for (auto& output : graph.outputs) output.node = moved[at(output.node)];
}

// The convolutions that one activation reads and nothing else.
std::vector<bool> before_activations(const Graph& graph) {
    const auto uses = use_counts(graph);
    std::vector<bool> found(graph.nodes.size(), false);
    for (const auto& node : graph.nodes) {
        if (node.operation != Operation::activation) continue;
        const auto before = at(node.inputs[0]);
        found[before] = graph.nodes[before].operation == Operation::convolution &&
                        linear(graph.nodes[before]) && uses[before] == 1;
    }
    return found;
}

// Behind the layer at `place`, whose bias it takes over: a norm that does nothing else.
int add_norm_after(Graph& graph, int place) {
    auto& layer = graph.nodes[at(place)];
    const int channels = layer.weights[0].shape[0];
    const auto filled = [&](float value) {
        return Tensor{{channels}, std::vector<float>(at(channels), value)};
    };
    auto shift = filled(0);
    if (layer.weights.size() == 2) {
        shift = std::move(layer.weights[1]);
        layer.weights.pop_back();
    }
    return add_batch_norm(graph, layer.name + ".norm", place,
                          {filled(0), filled(1 - usual_epsilon), filled(1), std::move(shift)});
}

}  // namespace

double deviation(const Node& norm, std::size_t channel) {
    return std::sqrt(double{norm.weights[1].values[channel]} + double{norm.epsilon});
}

Graph unfold_batch_norms(const Graph& graph) {
    const auto normed = before_activations(graph);
    Graph unfolded = graph;
    unfolded.nodes.clear();
    std::vector<int> moved;  // where whoever read a node reads now
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        Node node = graph.nodes[i];
        for (int& input : node.inputs) input = moved[at(input)];
        moved.push_back(unfolded.append(std::move(node)));
        if (normed[i]) moved.back() = add_norm_after(unfolded, moved.back());
    }
    for (auto& output : unfolded.outputs) output.node = moved[at(output.node)];
    return unfolded;
}

Graph fold_batch_norms(Graph graph) {
    const auto uses = use_counts(graph);
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        auto& node = graph.nodes[i];
        if (node.operation != Operation::batch_norm) continue;
        fold_to_affine(node);
        const int before = node.inputs[0];
        if (!linear(graph.nodes[at(before)]) || uses[at(before)] != 1) continue;
        absorb_affine(graph.nodes[at(before)], node);
        redirect(graph, static_cast<int>(i), before);
    }
    drop_dead_nodes(graph);
    return graph;
}

Graph fuse(Graph graph) {
    fuse_activations(graph);
    drop_dead_nodes(graph);
    fuse_additions(graph);
    drop_dead_nodes(graph);
    fuse_activations(graph);
    drop_dead_nodes(graph);
    return graph;
}

Graph optimise(Graph graph) { return fuse(fold_batch_norms(std::move(graph))); }

}  // namespace nn
