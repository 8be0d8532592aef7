// A network ready to run on a fixed number of positions of one board: buffers, layers of the
// library, and the steps in order. Belongs to the thread that made it.
#pragma once

#include <functional>
#include <memory>

#include "nn/onednn/buffers.h"
#include "nn/onednn/layer.h"
#include "nn/onednn/layout.h"

namespace nn::onednn {

// Where the numbers of this run are: per input and output; an output that is null is left out.
struct Ends {
    std::vector<const float*> inputs;
    std::vector<float*> outputs;
};

class Stage {
   public:
    Stage(std::shared_ptr<const Layout> layout, PackedWeights& packed, int positions);
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    void run(const Ends& ends) const {
        for (const auto& step : steps_) step(ends);
    }
    // What the library chose for every layer.
    std::vector<std::string> implementations() const;

   private:
    using Step = std::function<void(const Ends&)>;
    struct Value {
        std::array<std::byte*, formats> data{};
        int uses = 0;
    };

    void add_node(std::size_t n);
    void add_input(std::size_t n, std::size_t index);
    void add_transform(std::size_t n);
    void add_layer(std::size_t n);
    void add_small(std::size_t n);
    void add_pool(std::size_t n);
    void add_flatten(std::size_t n);
    void add_concatenate(std::size_t n);
    void add_gather(std::size_t n);
    void add_output(std::size_t index);
    void transform_terms(std::size_t n, Transform& transform);
    void squeeze_terms(std::size_t n, Transform& transform);
    const float* bias_rows(std::size_t n);
    Format layer_format(std::size_t n) const;
    std::byte* sum_buffer(std::size_t n);
    void convert_rest(std::size_t n);
    void release_inputs(std::size_t n);

    void step(const Transform& transform);
    Transform shaped(std::size_t n) const;
    std::byte* make(std::size_t n, Format format);
    float* make_f32(std::size_t n) { return reinterpret_cast<float*>(make(n, Format::f32)); }
    const float* input_f32(std::size_t n, std::size_t i) const;
    const Node& node(std::size_t n) const { return layout_->graph.nodes[n]; }
    std::size_t source(std::size_t n, std::size_t i) const {
        return static_cast<std::size_t>(node(n).inputs[i]);
    }
    int points_of(std::size_t n) const {
        return layout_->shapes[n].over_board ? layout_->points : 1;
    }
    bool wants(std::size_t n, Format format) const {
        return layout_->wanted[n][static_cast<std::size_t>(format)];
    }

    std::shared_ptr<const Layout> layout_;
    PackedWeights& packed_;
    int positions_;
    dnnl::stream stream_;
    Buffers buffers_;
    std::vector<Bytes> constants_;
    std::vector<Value> values_;
    std::vector<std::unique_ptr<Layer>> layers_;
    std::vector<Step> steps_;
};

}  // namespace nn::onednn
