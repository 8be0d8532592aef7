#include "nn/winograd/roles.h"

#include <algorithm>

#include "nn/index.h"

namespace nn::winograd {

namespace {

class Roles {
   public:
    Roles(const Graph& graph, const std::vector<Shape>& shapes)
        : graph_(graph), shapes_(shapes), readers_(graph.nodes.size()), roles_(readers_.size()) {
        for (std::size_t n = 0; n < graph.nodes.size(); ++n)
            for (const int input : graph.nodes[n].inputs)
                readers_[at(input)].push_back(static_cast<int>(n));
    }

    std::vector<Role> assign() {
        const int count = static_cast<int>(roles_.size());
        for (int n = 0; n < count; ++n) {
            if (node(n).operation == Operation::input && shapes_[at(n)].over_board)
                roles_[at(n)].hidden = true;
            carry(n);
        }
        for (int n = 0; n < count; ++n) hide_flatten(n);
        for (int n = 0; n < count; ++n) fuse_affine(n);
        for (int n = 0; n < count; ++n) demand(n);
        for (const auto& output : graph_.outputs)
            if (shapes_[at(output.node)].over_board) roles_[at(output.node)].floats = true;
        return std::move(roles_);
    }

   private:
    const Node& node(int n) const { return graph_.nodes[at(n)]; }
    bool is_output(int n) const {
        return std::any_of(graph_.outputs.begin(), graph_.outputs.end(),
                           [n](const Output& output) { return output.node == n; });
    }
    // Whether `reader` reads n as the words of a convolution, and as nothing else.
    bool reads_words(int reader, int n) const {
        const auto& inputs = node(reader).inputs;
        return node(reader).operation == Operation::convolution && inputs[0] == n &&
               std::count(inputs.begin(), inputs.end(), n) == 1;
    }

    // conv(x) + v over the board is a convolution with a bias of the position.
    void carry(int n) {
        if (node(n).operation != Operation::add_vector) return;
        const int source = node(n).inputs[0];
        if (node(source).operation != Operation::convolution || is_output(source) ||
            node(source).activation != Activation::identity || readers_[at(source)].size() != 1)
            return;
        roles_[at(n)].carrier = source;
        roles_[at(source)].hidden = true;
    }

    // Gathering and concatenating find their numbers on the board themselves.
    void hide_flatten(int n) {
        const auto& readers = readers_[at(n)];
        if (node(n).operation == Operation::flatten && !is_output(n) &&
            node(n).activation == Activation::identity &&
            std::all_of(readers.begin(), readers.end(), [&](int reader) {
                return node(reader).operation == Operation::gather ||
                       node(reader).operation == Operation::concatenate;
            }))
            roles_[at(n)].hidden = true;
    }

    // An affine that only convolutions read is applied where its input is made, to its words.
    void fuse_affine(int n) {
        if (node(n).operation != Operation::affine || !shapes_[at(n)].over_board) return;
        const int source = node(n).inputs[0];
        const auto& readers = readers_[at(n)];
        const bool words_only =
            !is_output(n) &&
            std::all_of(readers.begin(), readers.end(), [&](int r) { return reads_words(r, n); });
        const auto& siblings = readers_[at(source)];
        const bool free =
            roles_[at(source)].affine < 0 && node(source).operation != Operation::input &&
            std::none_of(siblings.begin(), siblings.end(), [&](int r) {
                return node(r).operation == Operation::convolution && node(r).inputs[0] == source;
            });
        if (!words_only || !free) return;
        roles_[at(source)].affine = n;
        roles_[at(n)].hidden = true;
    }

    // What n asks of its inputs.
    void demand(int n) {
        const auto& inputs = node(n).inputs;
        for (std::size_t slot = 0; slot < inputs.size(); ++slot) {
            auto& source = roles_[at(inputs[slot])];
            if (!shapes_[at(inputs[slot])].over_board) continue;
            const bool fused = source.affine == n || (slot == 0 && roles_[at(n)].carrier >= 0);
            if (node(n).operation == Operation::convolution && slot == 0) {
                source.words = true;
                source.wide = source.wide && node(n).weights[0].shape[2] == 1;
            } else if (!fused) {
                source.floats = true;
            }
        }
    }

    const Graph& graph_;
    const std::vector<Shape>& shapes_;
    std::vector<std::vector<int>> readers_;
    std::vector<Role> roles_;
};

}  // namespace

Kind kind_of(const Graph& graph, const std::vector<Shape>& shapes, int n) {
    const auto& node = graph.nodes[at(n)];
    switch (node.operation) {
        case Operation::convolution:
            if (graph.nodes[at(node.inputs[0])].operation == Operation::input) return Kind::first;
            return node.weights[0].shape[2] == 1 ? Kind::points : Kind::tower;
        case Operation::pool:
            return Kind::pool;
        case Operation::dense:
            return Kind::dense;
        default:
            return shapes[at(n)].over_board ? Kind::pointwise : Kind::numbers;
    }
}

std::vector<Role> assign_roles(const Graph& graph, const std::vector<Shape>& shapes) {
    return Roles(graph, shapes).assign();
}

}  // namespace nn::winograd
