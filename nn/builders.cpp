#include "nn/builders.h"

#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "nn/compose.h"

namespace nn {

namespace {

using engine::fail;

constexpr int pooled_width = 32;  // channels of a head that is pooled
constexpr int alphago_layers = 12;

// Box and Muller 1958, so that a seed gives the same weights with every standard library.
float normal(engine::Random& random) {
    const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 1) * 0x1p-53; };
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return static_cast<float>(radius * std::cos(2 * std::numbers::pi * uniform()));
}

class Builder {
   public:
    Builder(const Facts& facts, engine::Random& random) : random_(random) { graph_.facts = facts; }

    Graph& graph() { return graph_; }
    Graph finish() {
        validate(graph_);
        return std::move(graph_);
    }

    // `gain` scales He's deviation.
    Tensor weights(std::vector<int> shape, float gain = 1) {
        std::size_t count = 1;
        for (const int side : shape) count *= static_cast<std::size_t>(side);
        const auto inputs = static_cast<float>(count) / static_cast<float>(shape[0]);
        Tensor tensor{std::move(shape), std::vector<float>(count)};
        for (auto& value : tensor.values) value = normal(random_) * gain * std::sqrt(2 / inputs);
        return tensor;
    }
    static Tensor constant(int count, float value) {
        return {{count}, std::vector<float>(static_cast<std::size_t>(count), value)};
    }

    int convolution(const std::string& name, int x, int in, int out, int side, float gain = 1) {
        return add_convolution(graph_, name, x,
                               {weights({out, in, side, side}, gain), constant(out, 0)});
    }
    int dense(const std::string& name, int x, int in, int out, float gain = 1) {
        return add_dense(graph_, name, x, {weights({out, in}, gain), constant(out, 0)});
    }
    int relu(const std::string& name, int x) {
        return add_activation(graph_, name + ".relu", x, Activation::relu);
    }
    // A convolution without bias and its batch norm.
    int normed(const std::string& name, int x, int in, int out, int side) {
        x = add_convolution(graph_, name, x, {weights({out, in, side, side})});
        return add_batch_norm(
            graph_, name + ".norm", x,
            {constant(out, 0), constant(out, 1), constant(out, 1), constant(out, 0)});
    }
    int normed_relu(const std::string& name, int x, int in, int out, int side) {
        return relu(name, normed(name, x, in, out, side));
    }
    int dense_relu(const std::string& name, int x, int in, int out) {
        return relu(name, dense(name, x, in, out));
    }
    int sum(Operation operation, const std::string& name, int a, int b) {
        return add_operation(graph_, operation, name, {a, b});
    }
    int flat(const std::string& name, int x) {
        return add_operation(graph_, Operation::flatten, name + ".flat", {x});
    }

   private:
    engine::Random& random_;
    Graph graph_;
};

// Near zero, yet not zero: a last layer that is all zeros passes no gradient on.
constexpr float last_layer = 0.1f;

class Tower {
   public:
    Tower(const TowerDescription& description, engine::Random& random)
        : about_(description), builder_(description.facts, random) {}

    Graph run() {
        check();
        int x = add_input(builder_.graph(), "planes", {about_.planes, true});
        x = builder_.normed("first", x, about_.planes, channels(), 3);
        if (about_.globals > 0) {
            const int globals = add_input(builder_.graph(), "globals", {about_.globals, false});
            const int bias = builder_.dense("globals.dense", globals, about_.globals, channels());
            x = builder_.sum(Operation::add_vector, "first.sum", x, bias);
        }
        x = builder_.relu("first", x);
        for (int i = 0; i < about_.facts.blocks; ++i) x = block(fmt::format("block{}", i), x);
        policy_head(x);
        value_heads(x);
        if (about_.moves_left) moves_left_head(x);
        return builder_.finish();
    }

   private:
    int channels() const { return about_.facts.channels; }
    int points() const { return about_.facts.board * about_.facts.board; }

    void check() const {
        const auto& facts = about_.facts;
        if (facts.blocks < 0 || facts.blocks > 200)
            fail("expected 0 to 200 blocks, found {}", facts.blocks);
        if (facts.channels < 1 || facts.channels > 2048)
            fail("expected 1 to 2048 channels, found {}", facts.channels);
        if (facts.board == 0 && (about_.policy == PolicyHead::flat || about_.flat_value))
            fail("a flat head serves one board only: expected its size, found none");
        if (about_.policy == PolicyHead::flat && about_.policy_size < 1)
            fail("expected a policy of 1 or more moves, found {}", about_.policy_size);
        if (about_.policy == PolicyHead::planes && about_.move_planes < 1)
            fail("expected 1 or more planes of moves, found {}", about_.move_planes);
    }

    int block(const std::string& name, int x) {
        int y = builder_.normed(name + ".first", x, channels(), channels(), 3);
        if (about_.attention == Attention::global_pooling) y = pooled_bias(name, x, y);
        y = builder_.relu(name + ".first", y);
        y = builder_.normed(name + ".second", y, channels(), channels(), 3);
        if (about_.attention == Attention::squeeze_excitation) y = excite(name, y);
        return builder_.relu(name, builder_.sum(Operation::add, name + ".sum", y, x));
    }

    // Hu et al. 2018, with the shift that lc0 added to the scale.
    int excite(const std::string& name, int x) {
        const int narrow = std::max(channels() / 4, 1);
        int z = add_pool(builder_.graph(), name + ".mean", x, Pooling::mean);
        z = builder_.dense_relu(name + ".squeeze", z, channels(), narrow);
        z = builder_.dense(name + ".excite", z, narrow, 2 * channels(), last_layer);
        return builder_.sum(Operation::squeeze_scale, name + ".scale", x, z);
    }

    // Wu 2019: what is pooled over the board becomes a bias at every point.
    int pooled_bias(const std::string& name, int x, int y) {
        const int narrow = std::max(channels() / 4, 1);
        int g = builder_.normed_relu(name + ".pooling", x, channels(), narrow, 1);
        g = add_pool(builder_.graph(), name + ".pooled", g, Pooling::mean_maximum);
        g = builder_.dense(name + ".bias", g, 3 * narrow, channels(), last_layer);
        return builder_.sum(Operation::add_vector, name + ".biased", y, g);
    }

    void policy_head(int x) {
        auto& graph = builder_.graph();
        int y = 0;
        if (about_.policy == PolicyHead::flat) {
            constexpr int width = 2;
            y = builder_.normed_relu("policy", x, channels(), width, 1);
            y = builder_.dense("policy.moves", builder_.flat("policy", y), width * points(),
                               about_.policy_size, last_layer);
        } else if (about_.policy == PolicyHead::planes) {
            y = builder_.normed_relu("policy", x, channels(), channels(), 3);
            y = builder_.flat("policy", builder_.convolution("policy.planes", y, channels(),
                                                             about_.move_planes, 1, last_layer));
        } else {
            y = builder_.normed_relu("policy", x, channels(), pooled_width, 1);
            int pass = add_pool(graph, "policy.pooled", y, Pooling::mean_maximum);
            pass = builder_.dense("policy.pass", pass, 3 * pooled_width, 1, last_layer);
            y = builder_.flat(
                "policy", builder_.convolution("policy.points", y, pooled_width, 1, 1, last_layer));
            y = builder_.sum(Operation::concatenate, "policy.all", y, pass);
        }
        name_output(graph, "policy", y);
    }

    void value_heads(int x) {
        auto& graph = builder_.graph();
        const int width = about_.flat_value ? 1 : pooled_width;
        const int planes = builder_.normed_relu("value", x, channels(), width, 1);
        const int gathered = about_.flat_value
                                 ? builder_.flat("value", planes)
                                 : add_pool(graph, "value.pooled", planes, Pooling::mean_quadratic);
        const int hidden = builder_.dense_relu(
            "value.hidden", gathered, about_.flat_value ? points() : 3 * width, about_.value_width);
        const auto head = [&](const char* name, int outputs) {
            return builder_.dense(fmt::format("{}.last", name), hidden, about_.value_width, outputs,
                                  last_layer);
        };
        if (about_.wdl)
            name_output(graph, "wdl", head("wdl", 3));
        else
            name_output(graph, "value",
                        add_activation(graph, "value.tanh", head("value", 1), Activation::tanh));
        if (about_.score) name_output(graph, "score", head("score", 1));
        if (about_.ownership) ownership_head(x);
    }

    void ownership_head(int x) {
        const int y = builder_.normed_relu("ownership", x, channels(), pooled_width, 1);
        const int z = builder_.convolution("ownership.last", y, pooled_width, 1, 1, last_layer);
        name_output(builder_.graph(), "ownership",
                    add_activation(builder_.graph(), "ownership.tanh", z, Activation::tanh));
    }

    void moves_left_head(int x) {
        auto& graph = builder_.graph();
        int y = builder_.normed_relu("moves", x, channels(), pooled_width, 1);
        y = add_pool(graph, "moves.pooled", y, Pooling::mean);
        y = builder_.dense_relu("moves.hidden", y, pooled_width, 64);
        y = builder_.dense("moves.last", y, 64, 1, last_layer);
        name_output(graph, "moves_left",
                    add_activation(graph, "moves.softplus", y, Activation::softplus));
    }

    const TowerDescription& about_;
    Builder builder_;
};

// Both AlphaGo networks begin with these; no batch norm, as in 2016.
int alphago_trunk(Builder& builder, int planes) {
    auto& facts = builder.graph().facts;
    if (facts.blocks == 0) facts.blocks = alphago_layers;
    const int layers = facts.blocks, channels = facts.channels;
    int x = add_input(builder.graph(), "planes", {planes, true});
    x = builder.relu("layer1", builder.convolution("layer1", x, planes, channels, 5));
    for (int layer = 2; layer <= layers; ++layer) {
        const auto name = fmt::format("layer{}", layer);
        x = builder.relu(name, builder.convolution(name, x, channels, channels, 3));
    }
    return x;
}

}  // namespace

Graph build_tower(const TowerDescription& description, engine::Random& random) {
    return Tower(description, random).run();
}

Graph build_alphago_policy(const Facts& facts, int planes, engine::Random& random) {
    Builder builder(facts, random);
    const int trunk = alphago_trunk(builder, planes);
    const int plane = add_convolution(builder.graph(), "last", trunk,
                                      {builder.weights({1, facts.channels, 1, 1}, last_layer)});
    const int points = facts.board * facts.board;
    const Tensor zeros{{1, points}, std::vector<float>(static_cast<std::size_t>(points), 0.0f)};
    const int biased =
        add_operation(builder.graph(), Operation::point_bias, "last.points", {plane}, {zeros});
    const int mean = add_pool(builder.graph(), "pass.mean", plane, Pooling::mean);
    const int pass = builder.dense("pass", mean, 1, 1, last_layer);
    name_output(builder.graph(), "policy",
                builder.sum(Operation::concatenate, "all", builder.flat("policy", biased), pass));
    return builder.finish();
}

Graph build_alphago_value(const Facts& facts, int planes, engine::Random& random, int pooled) {
    Builder builder(facts, random);
    const int trunk = alphago_trunk(builder, planes);
    const int points = facts.board * facts.board;
    const int filters = pooled == 0 ? 1 : pooled;
    const int seen =
        builder.relu("layer13", builder.convolution("layer13", trunk, facts.channels, filters, 1));
    const int head = pooled == 0 ? builder.flat("layer13", seen)
                                 : add_pool(builder.graph(), "layer13.mean", seen, Pooling::mean);
    const int hidden = builder.dense_relu("hidden", head, pooled == 0 ? points : pooled, 256);
    const int last = builder.dense("last", hidden, 256, 1, last_layer);
    name_output(builder.graph(), "value",
                add_activation(builder.graph(), "value", last, Activation::tanh));
    return builder.finish();
}

Graph build_mlp(const Facts& facts, const std::vector<int>& widths, engine::Random& random) {
    if (widths.size() < 2) fail("expected 2 or more widths, found {}", widths.size());
    for (const int width : widths)
        if (width < 1) fail("expected widths of 1 or more, found {}", width);
    Builder builder(facts, random);
    int x = add_input(builder.graph(), "globals", {widths[0], false});
    for (std::size_t i = 1; i < widths.size(); ++i) {
        const auto name = fmt::format("layer{}", i);
        x = builder.dense(name, x, widths[i - 1], widths[i]);
        if (i + 1 < widths.size()) x = builder.relu(name, x);
    }
    name_output(builder.graph(), "output", x);
    return builder.finish();
}

}  // namespace nn
