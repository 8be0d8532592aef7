#include "nn/growth.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string_view>

#include "nn/index.h"

namespace nn {

namespace {

// Where in the large network each channel of a node of the small one is.
using Places = std::vector<int>;

class Growth {
   public:
    Growth(const Graph& small, Graph& large)
        : small_(small),
          large_(large),
          board_(small.facts.board > 0 ? small.facts.board : 9),
          small_shapes_(infer_shapes(small, board_)),
          large_shapes_(infer_shapes(large, board_)),
          twins_(large.nodes.size(), nullptr),
          places_(large.nodes.size()) {}

    // Whether the small network fits; else the large one is left half done.
    bool run() {
        if (!find_twins()) return false;
        for (std::size_t i = 0; i < large_.nodes.size(); ++i)
            if (!twins_[i])
                pass_through(i);
            else if (reads_alike(i) && place(i) && places_[i].size() == at(channels_of(*twins_[i])))
                fill(i);
            else
                return false;
        return true;
    }

   private:
    Node& large(int node) { return large_.nodes[at(node)]; }

    static bool same_kind(const Node& one, const Node& other) {
        const auto same_kernel = [](const Tensor& a, const Tensor& b) {
            return a.shape.size() == b.shape.size() &&
                   (a.shape.size() <= 2 ||
                    std::equal(a.shape.begin() + 2, a.shape.end(), b.shape.begin() + 2));
        };
        return one.operation == other.operation && one.activation == other.activation &&
               one.pooling == other.pooling && one.inputs.size() == other.inputs.size() &&
               std::ranges::equal(one.weights, other.weights, same_kernel);
    }

    // Whether a node reads what its twin does, or a new block behind it.
    bool reads_alike(std::size_t i) const {
        return std::ranges::equal(large_.nodes[i].inputs, twins_[i]->inputs,
                                  [&](int in_large, int in_small) {
                                      const auto* twin = twins_[at(in_large)];
                                      return !twin || twin == &small_.nodes[at(in_small)];
                                  });
    }

    // A node's twin is that of its name.
    bool find_twins() {
        std::map<std::string_view, std::size_t> named;
        for (std::size_t i = 0; i < large_.nodes.size(); ++i) named[large_.nodes[i].name] = i;
        for (const auto& node : small_.nodes) {
            const auto found = named.find(node.name);
            if (found == named.end()) return false;
            const auto& other = large_.nodes[found->second];
            if (!same_kind(node, other)) return false;
            twins_[found->second] = &node;
        }
        return std::ranges::equal(small_.outputs, large_.outputs, {}, &Output::name, &Output::name);
    }

    int channels_of(const Node& twin) const {
        return small_shapes_[static_cast<std::size_t>(&twin - small_.nodes.data())].channels;
    }

    static Places first(int count) {
        Places places(at(count));
        std::iota(places.begin(), places.end(), 0);
        return places;
    }

    // `parts` stretches of channels, one after another, each of which begins like `of`; how far
    // apart they are in the large network is `stride`.
    static Places repeated(const Places& of, int parts, int stride) {
        Places places;
        for (int part = 0; part < parts; ++part)
            for (const int place : of) places.push_back(part * stride + place);
        return places;
    }

    // The sigmoid's channels, then the shifts.
    bool is_excitation(std::size_t i) const {
        return std::ranges::any_of(large_.nodes, [&](const Node& node) {
            return node.operation == Operation::squeeze_scale && at(node.inputs[1]) == i;
        });
    }

    bool place(std::size_t i) {
        const auto& node = large_.nodes[i];
        const int count = channels_of(*twins_[i]), room = large_shapes_[i].channels;
        if (count > room) return false;
        if (node.operation == Operation::input) {
            places_[i] = first(count);
            return count == room;
        }
        const auto& input = places_[at(node.inputs[0])];
        switch (node.operation) {
            case Operation::convolution:
            case Operation::dense:
                places_[i] =
                    is_excitation(i) ? repeated(first(count / 2), 2, room / 2) : first(count);
                return true;
            case Operation::batch_norm:
            case Operation::affine:
            case Operation::activation:
            case Operation::add:
            case Operation::add_vector:
            case Operation::squeeze_scale:
                places_[i] = input;
                return true;
            case Operation::pool: {
                const int input_room = large_shapes_[at(node.inputs[0])].channels;
                places_[i] = repeated(input, room / input_room, input_room);
                return true;
            }
            case Operation::flatten:
                for (const int channel : input)
                    for (int point = 0; point < board_ * board_; ++point)
                        places_[i].push_back(channel * board_ * board_ + point);
                return true;
            case Operation::concatenate: {
                int offset = 0;
                for (const int from : node.inputs) {
                    for (const int place : places_[at(from)]) places_[i].push_back(offset + place);
                    offset += large_shapes_[at(from)].channels;
                }
                return true;
            }
            case Operation::input:  // above
            case Operation::gather:
            case Operation::point_bias:
                return false;
        }
        return false;
    }

    void fill(std::size_t i) {
        auto& node = large_.nodes[i];
        const auto& twin = *twins_[i];
        for (std::size_t w = 0; w < twin.weights.size(); ++w)
            if (twin.weights[w].shape.size() > 1)
                fill_rows(twin.weights[w], node.weights[w], places_[i],
                          places_[at(node.inputs[0])]);
            else
                for (std::size_t channel = 0; channel < places_[i].size(); ++channel)
                    node.weights[w].values[at(places_[i][channel])] =
                        twin.weights[w].values[channel];
    }

    // A row for each output; of a place in it, as many numbers as a kernel has.
    static void fill_rows(const Tensor& from, Tensor& to, const Places& rows,
                          const Places& columns) {
        const auto kernel = from.values.size() / (at(from.shape[0]) * at(from.shape[1]));
        const auto width = at(to.shape[1]) * kernel;
        for (std::size_t row = 0; row < rows.size(); ++row) {
            const auto start =
                to.values.begin() + static_cast<std::ptrdiff_t>(at(rows[row]) * width);
            std::fill_n(start, width, 0.0f);
            for (std::size_t column = 0; column < columns.size(); ++column)
                std::copy_n(
                    from.values.begin() +
                        static_cast<std::ptrdiff_t>((row * columns.size() + column) * kernel),
                    kernel, start + static_cast<std::ptrdiff_t>(at(columns[column]) * kernel));
        }
    }

    // A node of a new block: behind its sum, channels are where they were before it.
    void pass_through(std::size_t i) {
        const auto& node = large_.nodes[i];
        if (node.operation == Operation::add) {
            silence(node.inputs[0]);
            places_[i] = places_[at(node.inputs[1])];
        } else if (node.operation == Operation::activation) {
            places_[i] = places_[at(node.inputs[0])];
        }
    }

    // What a new block adds to the old ones' sum becomes zero, in a way that learning can undo.
    void silence(int node) {
        auto& last = large(node);
        if (last.operation == Operation::squeeze_scale) {
            for (auto& tensor : large(last.inputs[1]).weights) std::ranges::fill(tensor.values, 0);
            return silence(last.inputs[0]);
        }
        constexpr std::size_t scale = 2;  // of a batch norm's weights
        if (last.operation == Operation::batch_norm)
            std::ranges::fill(last.weights[scale].values, 0);
    }

    const Graph& small_;
    Graph& large_;
    int board_;
    std::vector<Shape> small_shapes_, large_shapes_;
    std::vector<const Node*> twins_;
    std::vector<Places> places_;
};

}  // namespace

std::optional<Graph> grown(const Graph& small, Graph large) {
    if (small.facts.game != large.facts.game || small.facts.encoding != large.facts.encoding ||
        small.facts.board != large.facts.board)
        return std::nullopt;
    if (!Growth(small, large).run()) return std::nullopt;
    large.facts.steps = small.facts.steps;
    large.facts.licence = small.facts.licence;
    return large;
}

}  // namespace nn
