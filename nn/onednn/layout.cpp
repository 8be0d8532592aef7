#include "nn/onednn/layout.h"

#include <algorithm>
#include <cmath>

#include "nn/index.h"

namespace nn::onednn {

namespace {

// Dense layers smaller than this cost the library more to call than to compute.
constexpr std::size_t small_layer = 40000;
// Convolutions to so few planes run as dense layers on every point.
constexpr int few_planes = 4;
// Positions may reach further than those of the calibration.
constexpr float headroom = 1.1f;

class LayoutMaker {
   public:
    LayoutMaker(const Graph& graph, Precision precision, const Calibration& calibration, int board)
        : precision_(precision), calibration_(calibration) {
        out_.graph = graph;
        out_.board = board;
        out_.points = board * board;
        out_.shapes = infer_shapes(graph, board);
    }

    Layout run() {
        dissolve_flattenings();
        count_uses();
        choose_formats();
        collect_wanted();
        return std::move(out_);
    }

   private:
    const Node& node(std::size_t n) const { return out_.graph.nodes[n]; }
    std::size_t count() const { return out_.graph.nodes.size(); }

    // Index in rows of channels of what a flattening puts at `index`.
    int turned(int index, int channels) const {
        return index % out_.points * channels + index / out_.points;
    }

    void dissolve_flattenings() {
        for (auto& reader : out_.graph.nodes) {
            if (reader.operation != Operation::dense && reader.operation != Operation::gather)
                continue;
            const auto& flat = node(at(reader.inputs[0]));
            if (flat.operation != Operation::flatten || flat.activation != Activation::identity)
                continue;
            const int source = flat.inputs[0];
            turn(reader, out_.shapes[at(source)].channels);
            reader.inputs[0] = source;
        }
    }

    void turn(Node& reader, int channels) const {
        if (reader.operation == Operation::gather) {
            for (int& index : reader.table) index = turned(index, channels);
            return;
        }
        auto& weight = reader.weights[0];
        auto values = weight.values;
        const int width = weight.shape[1];
        for (int row = 0; row < weight.shape[0]; ++row)
            for (int i = 0; i < width; ++i)
                values[at(row) * at(width) + at(turned(i, channels))] =
                    weight.values[at(row) * at(width) + at(i)];
        weight.values = std::move(values);
    }

    void count_uses() {
        out_.uses.assign(count(), 0);
        for (const auto& output : out_.graph.outputs) ++out_.uses[at(output.node)];
        for (std::size_t n = count(); n-- > 0;)
            if (out_.uses[n] > 0)
                for (const int input : node(n).inputs) ++out_.uses[at(input)];
    }

    void choose_formats() {
        out_.makers.assign(count(), Maker::loops);
        out_.reads.assign(count(), Format::f32);
        out_.steps.resize(count());
        out_.inverse_steps.resize(count());
        for (std::size_t n = 0; n < count(); ++n) {
            if (!for_library(node(n))) continue;
            out_.makers[n] = Maker::library;
            out_.reads[n] = format_of(n);
            if (out_.reads[n] >= Format::u8) add_steps(at(node(n).inputs[0]));
        }
    }

    static bool for_library(const Node& layer) {
        if (layer.operation == Operation::dense)
            return layer.weights[0].values.size() >= small_layer;
        if (layer.operation != Operation::convolution) return false;
        const auto& kernel = layer.weights[0].shape;
        return kernel[2] > 1 || kernel[0] > few_planes;
    }

    Format format_of(std::size_t n) const {
        if (precision_ == Precision::fp32) return Format::f32;
        if (precision_ == Precision::int8 && in_trunk(n)) {
            const auto source = node(at(node(n).inputs[0])).activation;
            const bool positive = source == Activation::relu || source == Activation::sigmoid;
            return positive ? Format::u8 : Format::s8;
        }
        return Format::bf16;
    }

    // What every output needs and is no first layer; narrow ones are not worth a loss.
    bool in_trunk(std::size_t n) const {
        constexpr int narrow = 16;
        const auto& layer = node(n);
        if (layer.operation != Operation::convolution) return false;
        const auto& kernel = layer.weights[0].shape;
        if (kernel[0] < narrow || kernel[1] < narrow) return false;
        if (node(at(layer.inputs[0])).operation == Operation::input) return false;
        return std::all_of(out_.graph.outputs.begin(), out_.graph.outputs.end(),
                           [&](const Output& output) { return needs(output.node, n); });
    }

    bool needs(int output, std::size_t wanted) const {
        std::vector<bool> needed(count(), false);
        needed[at(output)] = true;
        for (std::size_t n = count(); n-- > wanted;)
            if (needed[n])
                for (const int input : node(n).inputs) needed[at(input)] = true;
        return needed[wanted];
    }

    // The geometric mean of the channel's largest number and the tensor's: never clips what was
    // seen, and lets quiet channels have finer steps.
    void add_steps(std::size_t source) {
        const auto& maxima = calibration_.maxima[source];
        const float most = std::max(*std::max_element(maxima.begin(), maxima.end()), 1e-6f);
        const auto activation = node(source).activation;
        const float levels =
            activation == Activation::relu || activation == Activation::sigmoid ? 255 : 127;
        auto& steps = out_.steps[source];
        steps.clear();
        out_.inverse_steps[source].clear();
        for (const float channel : maxima) {
            const float reach = std::sqrt(std::max(channel, most * 1e-3f) * most);
            steps.push_back(headroom * reach / levels);
            out_.inverse_steps[source].push_back(1 / steps.back());
        }
    }

    void collect_wanted() {
        out_.wanted.assign(count(), {});
        const auto want = [&](int node, Format format) {
            out_.wanted[at(node)][static_cast<std::size_t>(format)] = true;
        };
        for (const auto& output : out_.graph.outputs) want(output.node, Format::f32);
        for (std::size_t n = 0; n < count(); ++n) {
            if (out_.uses[n] == 0) continue;
            const auto& inputs = node(n).inputs;
            for (std::size_t i = 0; i < inputs.size(); ++i)
                want(inputs[i], i == 0 ? out_.reads[n] : Format::f32);
        }
    }

    Precision precision_;
    const Calibration& calibration_;
    Layout out_;
};

}  // namespace

Layout lay_out(const Graph& graph, Precision precision, const Calibration& calibration, int board) {
    return LayoutMaker(graph, precision, calibration, board).run();
}

}  // namespace nn::onednn
