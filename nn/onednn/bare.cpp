#include "nn/onednn/bare.h"

#include "nn/passes.h"

namespace nn::onednn {

BareConvolutions::BareConvolutions(const Graph& graph, Precision precision,
                                   const Calibration& calibration, const Positions& positions)
    : layout_(lay_out(optimise(graph), precision, calibration, positions.board)),
      positions_(positions.size),
      stream_((use_callers_thread(), processor())) {
    for (std::size_t n = 0; n < layout_.makers.size(); ++n)
        if (layout_.makers[n] == Maker::library &&
            layout_.graph.nodes[n].operation == Operation::convolution)
            add(n);
}

double BareConvolutions::run() const {
    for (const auto& layer : layers_) layer.run(stream_);
    return positions_;
}

void BareConvolutions::add(std::size_t node) {
    auto bare = layout_.graph.nodes[node];
    bare.activation = Activation::identity;
    if (layout_.reads[node] >= Format::u8)
        int8_operations_ +=
            2.0 * static_cast<double>(bare.weights[0].values.size()) * layout_.points;
    const int source = bare.inputs[0];
    const auto buffer = [&](int of) {
        buffers_.push_back(
            allocate(layout_.size(of) * static_cast<std::size_t>(positions_) * sizeof(float)));
        return buffers_.back().get();
    };
    LayerCall call;
    call.node = node;
    call.layer = &bare;
    call.positions = positions_;
    call.board = layout_.board;
    call.in = buffer(source);
    call.in_format = layout_.reads[node];
    call.in_steps = &layout_.steps[static_cast<std::size_t>(source)];
    call.out = buffer(static_cast<int>(node));
    layers_.emplace_back(call, packed_);
}

}  // namespace nn::onednn
