#include "nn/katago.h"

#include <algorithm>
#include <array>

#include "engine/base/error.h"
#include "nn/compose.h"
#include "nn/katago_reader.h"

namespace nn {

namespace {

using engine::fail;
using katago::Reader;

constexpr int spatial_inputs = 22, global_inputs = 19;

struct Multipliers {
    float time_difference = 20, mean = 20, deviation = 20, lead = 20, variance_time = 40,
          value_error = 0.25f, score_error = 30;
};

// Rows of a matrix or bias, each times a factor, as a layer of their own.
Tensor rows(const Tensor& tensor, std::initializer_list<int> which, float factor = 1) {
    const auto width = tensor.values.size() / static_cast<std::size_t>(tensor.shape[0]);
    Tensor chosen{tensor.shape, {}};
    chosen.shape[0] = static_cast<int>(which.size());
    for (const int row : which) {
        const auto first = tensor.values.begin() + static_cast<std::ptrdiff_t>(width) * row;
        std::transform(first, first + static_cast<std::ptrdiff_t>(width),
                       std::back_inserter(chosen.values), [&](float x) { return x * factor; });
    }
    return chosen;
}

class KatagoImporter {
   public:
    explicit KatagoImporter(std::string_view bytes) : reader_(bytes) {}

    Graph run() {
        read_header();
        const int trunk = read_trunk();
        read_policy_head(trunk);
        read_value_head(trunk);
        validate(graph_);
        return std::move(graph_);
    }

   private:
    void read_header();
    void read_version_15_header();
    int read_trunk();
    int read_block(int x, int channels, int depth);
    int read_ordinary_block(const std::string& name, int x, int channels);
    int read_pooling_block(const std::string& name, int x, int channels);
    int read_nested_block(const std::string& name, int x, int channels, int depth);
    void read_policy_head(int trunk);
    int read_pass(int pooled, int pooled_channels, int channels);
    void read_value_head(int trunk);
    void add_score_outputs(int hidden, const Tensor& weight, const Tensor& bias);
    void add_short_term_errors(int hidden, const Tensor& weight, const Tensor& bias);

    // The names in a file need not differ; with a counter ours do.
    std::string unique(std::string_view name) { return fmt::format("{}.{}", count_++, name); }

    int norm_and_activation(int x, int channels) {
        auto norm = katago::read_norm(reader_, channels);
        const int y =
            add_batch_norm(graph_, unique(norm.name), x, std::move(norm.weights), norm.epsilon);
        return activation(y);
    }
    int activation(int x) {
        const auto kind = katago::read_activation(reader_, version_);
        return kind == Activation::identity ? x
                                            : add_activation(graph_, unique("activation"), x, kind);
    }
    // Yields the node and its channels.
    std::pair<int, int> convolution(int x, int channels) {
        auto layer = katago::read_convolution(reader_, channels);
        const int out = layer.kernel.shape[0];
        return {add_convolution(graph_, unique(layer.name), x, {std::move(layer.kernel)}), out};
    }
    std::pair<int, int> dense(int x, int channels) {
        auto layer = katago::read_matrix(reader_, channels);
        const int out = layer.weight.shape[0];
        return {add_dense(graph_, unique(layer.name), x, {std::move(layer.weight)}), out};
    }
    int sum(Operation operation, int a, int b) {
        return add_operation(graph_, operation, unique("sum"), {a, b});
    }
    int pool(int x, Pooling kind) { return add_pool(graph_, unique("pool"), x, kind); }
    void output(const char* name, int hidden, std::vector<Tensor> weights, Activation kind) {
        const int y = add_dense(graph_, unique(name), hidden, std::move(weights));
        name_output(graph_, name,
                    kind == Activation::identity
                        ? y
                        : add_activation(graph_, unique("activation"), y, kind));
    }
    void expect_equal(int found, int expected, const char* what) const {
        if (found != expected) fail("expected {} {}, found {}", expected, what, found);
    }

    Reader reader_;
    Graph graph_;
    Multipliers multipliers_;
    int version_ = 0, count_ = 0, trunk_channels_ = 0;
};

void KatagoImporter::read_header() {
    graph_.facts.name = std::string(reader_.word("the name of the network"));
    version_ = reader_.integer("a version of KataGo's format", 1, 1000);
    if (version_ < 8 || version_ > 16)
        fail("expected KataGo's format version 8 to 16, found version {}{}", version_,
             version_ < 8 ? " (inputs older than V7)" : " (transformers)");
    const int planes = reader_.integer("planes", 1, 1000);
    const int globals = reader_.integer("globals", 1, 1000);
    expect_equal(planes, spatial_inputs, "planes");
    expect_equal(globals, global_inputs, "globals");
    if (version_ >= 13)
        multipliers_ = {reader_.number("a multiplier"), reader_.number("a multiplier"),
                        reader_.number("a multiplier"), reader_.number("a multiplier"),
                        reader_.number("a multiplier"), reader_.number("a multiplier"),
                        reader_.number("a multiplier")};
    if (version_ >= 15) read_version_15_header();
    graph_.facts.game = "go";
    graph_.facts.encoding = "katago-v7";
    graph_.facts.source = fmt::format("KataGo version {}", version_);
}

void KatagoImporter::read_version_15_header() {
    if (reader_.integer("a metadata encoder", 0, 1000) != 0)
        fail("expected no metadata encoder, found one (a human-imitating network)");
    reader_.integer("how it likes passing-alive", 0, 1);
    for (int i = 0; i < 6; ++i) reader_.integer("a reserved zero", 0, 0);
}

int KatagoImporter::read_trunk() {
    reader_.word("the name of the trunk");
    const int blocks = reader_.integer("blocks", 1, 1000);
    trunk_channels_ = reader_.integer("trunk channels", 1, katago::most_channels);
    for (int i = 0; i < 4; ++i) reader_.integer("channels of a kind", 0, katago::most_channels);
    if (version_ >= 15) {
        if (reader_.integer("a kind of norm", 0, 1000) != 0)
            fail("expected batch norms in the trunk, found RMS norms (a transformer)");
        for (int i = 0; i < 5; ++i) reader_.integer("a reserved zero", 0, 0);
    }
    graph_.facts.blocks = blocks;
    graph_.facts.channels = trunk_channels_;

    const int planes = add_input(graph_, "planes", {spatial_inputs, true});
    const int globals = add_input(graph_, "globals", {global_inputs, false});
    const auto [first, channels] = convolution(planes, spatial_inputs);
    expect_equal(channels, trunk_channels_, "trunk channels");
    const auto side = dense(globals, global_inputs);
    int x = sum(Operation::add_vector, first, side.first);
    for (int i = 0; i < blocks; ++i) x = read_block(x, trunk_channels_, 0);
    return norm_and_activation(x, trunk_channels_);
}

int KatagoImporter::read_block(int x, int channels, int depth) {
    const std::string kind(reader_.word("a kind of block"));
    const std::string name(reader_.word("the name of a block"));
    if (kind == "ordinary_block") return read_ordinary_block(name, x, channels);
    if (kind == "gpool_block") return read_pooling_block(name, x, channels);
    if (kind == "nested_bottleneck_block" && depth < 4)
        return read_nested_block(name, x, channels, depth);
    if (kind.starts_with("transformer"))
        fail("expected a convolutional network, found a {} (a transformer)", kind.substr(0, 40));
    fail("{}: expected a kind of block that KataGo 1.16 knows, found another", name.substr(0, 40));
}

int KatagoImporter::read_ordinary_block(const std::string&, int x, int channels) {
    const int before = norm_and_activation(x, channels);
    const auto [middle, middle_channels] = convolution(before, channels);
    const int active = norm_and_activation(middle, middle_channels);
    return sum(Operation::add, x, convolution(active, middle_channels).first);
}

int KatagoImporter::read_pooling_block(const std::string&, int x, int channels) {
    const int before = norm_and_activation(x, channels);
    const auto [regular, regular_channels] = convolution(before, channels);
    const auto [pooling, pooling_channels] = convolution(before, channels);
    const int active = norm_and_activation(pooling, pooling_channels);
    const int pooled = pool(active, Pooling::mean_maximum);
    const int bias = dense(pooled, 3 * pooling_channels).first;
    const int biased = sum(Operation::add_vector, regular, bias);
    const int middle = norm_and_activation(biased, regular_channels);
    return sum(Operation::add, x, convolution(middle, regular_channels).first);
}

int KatagoImporter::read_nested_block(const std::string&, int x, int channels, int depth) {
    const int inner = reader_.integer("inner blocks", 1, 1000);
    const int before = norm_and_activation(x, channels);
    auto [y, inner_channels] = convolution(before, channels);
    for (int i = 0; i < inner; ++i) y = read_block(y, inner_channels, depth + 1);
    const int after = norm_and_activation(y, inner_channels);
    return sum(Operation::add, x, convolution(after, inner_channels).first);
}

void KatagoImporter::read_policy_head(int trunk) {
    reader_.word("the name of the policy head");
    const auto [first, channels] = convolution(trunk, trunk_channels_);
    const auto [pooling, pooling_channels] = convolution(trunk, trunk_channels_);
    const int active = norm_and_activation(pooling, pooling_channels);
    const int pooled = pool(active, Pooling::mean_maximum);
    const int bias = dense(pooled, 3 * pooling_channels).first;
    const int biased = sum(Operation::add_vector, first, bias);
    const int middle = norm_and_activation(biased, channels);
    auto last = katago::read_convolution(reader_, channels);
    const int planes = add_convolution(graph_, unique(last.name), middle, {rows(last.kernel, {0})});
    const int flat = add_operation(graph_, Operation::flatten, unique("flat"), {planes});
    const int pass = read_pass(pooled, 3 * pooling_channels, channels);
    name_output(graph_, "policy",
                add_operation(graph_, Operation::concatenate, unique("policy"), {flat, pass}));
}

int KatagoImporter::read_pass(int pooled, int pooled_channels, int channels) {
    auto weight = katago::read_matrix(reader_, pooled_channels).weight;
    if (version_ < 15) return add_dense(graph_, unique("pass"), pooled, {rows(weight, {0})});
    expect_equal(weight.shape[0], channels, "channels before the pass");
    auto bias = katago::read_bias(reader_, channels);
    const int hidden =
        activation(add_dense(graph_, unique("pass"), pooled, {std::move(weight), std::move(bias)}));
    return add_dense(graph_, unique("pass"), hidden,
                     {rows(katago::read_matrix(reader_, channels).weight, {0})});
}

void KatagoImporter::read_value_head(int trunk) {
    reader_.word("the name of the value head");
    const auto [first, channels] = convolution(trunk, trunk_channels_);
    const int active = norm_and_activation(first, channels);
    auto second = katago::read_matrix(reader_, 3 * channels);
    const int width = second.weight.shape[0];
    auto bias = katago::read_bias(reader_, width);
    const int hidden =
        activation(add_dense(graph_, unique(second.name), pool(active, Pooling::mean_quadratic),
                             {std::move(second.weight), std::move(bias)}));
    const auto value = katago::read_matrix(reader_, width);
    expect_equal(value.weight.shape[0], 3, "values");
    const auto value_bias = katago::read_bias(reader_, 3);
    const auto scores = katago::read_matrix(reader_, width);
    expect_equal(scores.weight.shape[0], version_ >= 9 ? 6 : 4, "score values");
    const auto score_bias = katago::read_bias(reader_, version_ >= 9 ? 6 : 4);
    // Theirs is win, loss, no result.
    output("wdl", hidden, {rows(value.weight, {0, 2, 1}), rows(value_bias, {0, 2, 1})},
           Activation::identity);
    add_score_outputs(hidden, scores.weight, score_bias);
    const auto ownership = convolution(active, channels);
    expect_equal(ownership.second, 1, "planes of ownership");
    name_output(graph_, "ownership",
                add_activation(graph_, unique("ownership"), ownership.first, Activation::tanh));
}

void KatagoImporter::add_score_outputs(int hidden, const Tensor& weight, const Tensor& bias) {
    const auto straight = [&](const char* name, int row, float factor) {
        output(name, hidden, {rows(weight, {row}, factor), rows(bias, {row}, factor)},
               Activation::identity);
    };
    const auto positive = [&](const char* name, int row, float factor) {
        const int y =
            add_dense(graph_, unique(name), hidden, {rows(weight, {row}), rows(bias, {row})});
        const int z = add_activation(graph_, unique("softplus"), y, Activation::softplus);
        name_output(graph_, name,
                    add_operation(graph_, Operation::affine, unique(name), {z},
                                  {{{1}, {factor}}, {{1}, {0.0f}}}));
    };
    straight("score", 0, multipliers_.mean);
    positive("score_deviation", 1, multipliers_.deviation);
    straight("lead", 2, multipliers_.lead);
    positive("variance_time", 3, multipliers_.variance_time);
    if (version_ >= 9) add_short_term_errors(hidden, weight, bias);
}

// Version 9: softplus(x) and 10 softplus(x). To 13: sqrt(m softplus(x)). From 14 on:
// sqrt(m) softplus(x / 2).
void KatagoImporter::add_short_term_errors(int hidden, const Tensor& weight, const Tensor& bias) {
    const auto add = [&](const char* name, int row, float multiplier, float old_factor) {
        const float inside = version_ >= 14 ? 0.5f : 1.0f;
        int y = add_dense(graph_, unique(name), hidden,
                          {rows(weight, {row}, inside), rows(bias, {row}, inside)});
        y = add_activation(graph_, unique("softplus"), y, Activation::softplus);
        const float factor = version_ == 9    ? old_factor
                             : version_ >= 14 ? activate(Activation::square_root, multiplier)
                                              : multiplier;
        y = add_operation(graph_, Operation::affine, unique(name), {y},
                          {{{1}, {factor}}, {{1}, {0.0f}}});
        if (version_ > 9 && version_ < 14)
            y = add_activation(graph_, unique("root"), y, Activation::square_root);
        name_output(graph_, name, y);
    };
    add("winloss_error", 4, multipliers_.value_error, 1);
    add("score_error", 5, multipliers_.score_error, 10);
}

}  // namespace

bool is_katago(std::string_view bytes) {
    // A name of their alphabet, then a version.
    const auto start = bytes.find_first_not_of(" \t\r\n");
    if (start == bytes.npos) return false;
    const auto end = bytes.find_first_of(" \t\r\n", start);
    if (end == bytes.npos || end - start > 300) return false;
    const auto name = bytes.substr(start, end - start);
    const auto next = bytes.find_first_not_of(" \t\r\n", end);
    return next != bytes.npos && bytes[next] >= '0' && bytes[next] <= '9' &&
           std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c < '\x7f'; });
}

Graph graph_from_katago(std::string_view bytes) { return KatagoImporter(bytes).run(); }

}  // namespace nn
