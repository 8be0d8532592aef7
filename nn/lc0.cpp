#include "nn/lc0.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "engine/base/error.h"
#include "nn/compose.h"
#include "nn/lc0.pb.h"

namespace nn {

namespace {

using engine::fail;

constexpr int lc0_planes = 112, lc0_moves = 1858, squares = 64;
constexpr float lc0_epsilon = 1e-5f;

enum : int { classical_policy = 1, convolutional_policy = 2 };
enum : int { scalar_value = 1, wdl_value = 2 };

// --- weights

float from_half(std::uint16_t half) {
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    const float size = exponent == 0
                           ? std::ldexp(static_cast<float>(fraction), -24)
                           : std::ldexp(static_cast<float>(fraction + 1024), exponent - 25);
    return half & 0x8000 ? -size : size;
}

template <class Word>
Word word_at(std::string_view data, std::size_t i) {
    Word word;
    std::memcpy(&word, data.data() + i * sizeof word, sizeof word);
    return word;
}

std::vector<float> values_of(const lc0::Layer& layer, const std::string& name) {
    enum : int { linear16 = 1, float16, bfloat16, float32 };
    const int encoding = layer.has_encoding() ? layer.encoding() : int{linear16};
    if (encoding < linear16 || encoding > float32)
        fail("{}: expected weights encoded as 1 to 4, found {}", name, encoding);
    const std::size_t width = encoding == float32 ? 4 : 2;
    const std::string_view data = layer.data();
    if (data.size() % width != 0)
        fail("{}: expected whole numbers of {} bytes, found {}", name, width, data.size());
    std::vector<float> values(data.size() / width);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (encoding == float32) {
            values[i] = word_at<float>(data, i);
            continue;
        }
        const auto word = word_at<std::uint16_t>(data, i);
        const float share = static_cast<float>(word) / 65535;
        values[i] = encoding == float16    ? from_half(word)
                    : encoding == bfloat16 ? std::bit_cast<float>(std::uint32_t{word} << 16)
                                           : layer.least() * (1 - share) + layer.most() * share;
    }
    return values;
}

Tensor tensor_of(const lc0::Layer& layer, const std::string& name, std::vector<int> shape) {
    std::size_t count = 1;
    for (const int side : shape) count *= static_cast<std::size_t>(side);
    Tensor tensor{std::move(shape), values_of(layer, name)};
    if (tensor.values.size() != count)
        fail("{}: expected {} weights, found {}", name, count, tensor.values.size());
    return tensor;
}

int count_of(const lc0::Layer& layer, const std::string& name) {
    const auto count = values_of(layer, name).size();
    if (count == 0 || count > 1 << 14)
        fail("{}: expected 1 to 16384 numbers, found {}", name, count);
    return static_cast<int>(count);
}

// --- the network

class Lc0Importer {
   public:
    explicit Lc0Importer(const lc0::Net& net) : net_(net), weights_(net.weights()) {}

    Graph run() {
        check_format();
        read_facts();
        body_ = add_input(graph_, "planes", {lc0_planes, true});
        channels_ = lc0_planes;
        body_ = active("input", convolution("input", weights_.input(), body_, 3));
        for (int i = 0; i < weights_.blocks_size(); ++i) read_block(i);
        read_policy();
        read_value();
        if (weights_.has_moves_left() && weights_.moves_left().has_kernel()) read_moves_left();
        graph_.facts.channels = channels_;
        validate(graph_);
        return std::move(graph_);
    }

   private:
    void check_format();
    void read_facts();
    void read_block(int index);
    int excite(const std::string& name, const lc0::Excitation& excitation, int x);
    void read_policy();
    void read_value();
    void read_moves_left();

    // With its batch norm; leaves the number of its channels in channels_ of the layer.
    int convolution(const std::string& name, const lc0::Convolution& layer, int x, int side);
    int dense(const std::string& name, const lc0::Layer& weight, const lc0::Layer& bias, int x,
              int inputs);
    int active(const std::string& name, int x) {
        return add_activation(graph_, name + ".activation", x, activation_);
    }
    int flat(const std::string& name, int x) {
        return add_operation(graph_, Operation::flatten, name + ".flat", {x});
    }

    const lc0::Net& net_;
    const lc0::Weights& weights_;
    Graph graph_;
    int body_ = 0, channels_ = 0, policy_ = classical_policy, value_ = scalar_value;
    Activation activation_ = Activation::relu;
};

void Lc0Importer::check_format() {
    if (net_.has_onnx()) fail("expected a residual network of lc0, found an ONNX model");
    if (!net_.has_weights()) fail("expected weights, found none");
    const auto& format = net_.format().network();
    if (weights_.encoders_size() > 0 || weights_.has_value_heads() || weights_.has_policy_heads() ||
        format.network() > 5)
        fail("expected a residual network of lc0, found an attention network");
    if (format.network() == 5) fail("expected a residual network of lc0, found an ONNX model");
    if (format.has_input() && format.input() > 1)
        fail("expected lc0's input format 1 (classical 112 planes), found format {}",
             format.input());
    if (format.network() >= 3) {
        policy_ = std::max(format.policy(), 1);
        value_ = std::max(format.value(), 1);
    }
    if (policy_ > convolutional_policy)
        fail("expected a classical or convolutional policy, found {}",
             policy_ == 3 ? "an attention policy" : fmt::format("policy {}", policy_));
    if (value_ > wdl_value) fail("expected a scalar or win-draw-loss value, found {}", value_);
    if (format.activation() > 1)
        fail("expected the activation 0 (ReLU) or 1 (Mish), found {}", format.activation());
    if (format.activation() == 1) activation_ = Activation::mish;
}

void Lc0Importer::read_facts() {
    graph_.facts.game = "chess";
    graph_.facts.encoding = "lc0-112";
    graph_.facts.source = "lc0";
    graph_.facts.licence = net_.licence();
    graph_.facts.board = 8;
    graph_.facts.blocks = weights_.blocks_size();
    graph_.facts.steps = net_.training().steps();
}

int Lc0Importer::convolution(const std::string& name, const lc0::Convolution& layer, int x,
                             int side) {
    const bool normed = layer.has_mean() && !layer.mean().data().empty();
    const int out = count_of(normed ? layer.mean() : layer.bias(), name);
    std::vector<Tensor> weights = {tensor_of(layer.kernel(), name, {out, channels_, side, side})};
    if (layer.has_bias() && !layer.bias().data().empty())
        weights.push_back(tensor_of(layer.bias(), name, {out}));
    channels_ = out;
    const int y = add_convolution(graph_, name, x, std::move(weights));
    if (!normed) return y;
    const auto otherwise = [&](const lc0::Layer& values, float standard) {
        if (!values.data().empty()) return tensor_of(values, name, {out});
        return Tensor{{out}, std::vector<float>(static_cast<std::size_t>(out), standard)};
    };
    return add_batch_norm(
        graph_, name + ".norm", y,
        {tensor_of(layer.mean(), name, {out}), tensor_of(layer.variance(), name, {out}),
         otherwise(layer.scale(), 1), otherwise(layer.shift(), 0)},
        lc0_epsilon);
}

int Lc0Importer::dense(const std::string& name, const lc0::Layer& weight, const lc0::Layer& bias,
                       int x, int inputs) {
    const int out = count_of(bias, name);
    return add_dense(graph_, name, x,
                     {tensor_of(weight, name, {out, inputs}), tensor_of(bias, name, {out})});
}

void Lc0Importer::read_block(int index) {
    const auto& block = weights_.blocks(index);
    const auto name = fmt::format("block{}", index);
    const int first =
        active(name + ".first", convolution(name + ".first", block.first(), body_, 3));
    int y = convolution(name + ".second", block.second(), first, 3);
    if (block.has_excitation()) y = excite(name, block.excitation(), y);
    body_ = active(name, add_operation(graph_, Operation::add, name + ".sum", {y, body_}));
}

int Lc0Importer::excite(const std::string& name, const lc0::Excitation& excitation, int x) {
    const int pooled = add_pool(graph_, name + ".mean", x, Pooling::mean);
    const int narrow = count_of(excitation.bias1(), name);
    const int squeezed = active(name + ".squeeze", dense(name + ".squeeze", excitation.weight1(),
                                                         excitation.bias1(), pooled, channels_));
    const int excited =
        dense(name + ".excite", excitation.weight2(), excitation.bias2(), squeezed, narrow);
    return add_operation(graph_, Operation::squeeze_scale, name + ".scale", {x, excited});
}

void Lc0Importer::read_policy() {
    const int body_channels = channels_;
    int y = body_;
    if (policy_ == convolutional_policy) {
        y = active("policy1", convolution("policy1", weights_.policy1(), y, 3));
        y = flat("policy", convolution("policy", weights_.policy(), y, 3));
        y = add_gather(graph_, "policy.moves", y, lc0_policy_map());
    } else {
        y = active("policy", convolution("policy", weights_.policy(), y, 1));
        y = dense("policy.moves", weights_.policy_weight(), weights_.policy_bias(),
                  flat("policy", y), channels_ * squares);
        if (const int found = count_of(weights_.policy_bias(), "policy.moves"); found != lc0_moves)
            fail("expected {} moves, found {}", lc0_moves, found);
    }
    name_output(graph_, "policy", y);
    channels_ = body_channels;
}

void Lc0Importer::read_value() {
    const int body_channels = channels_;
    int y = active("value", convolution("value", weights_.value(), body_, 1));
    y = active("value1", dense("value1", weights_.value1_weight(), weights_.value1_bias(),
                               flat("value", y), channels_ * squares));
    y = dense("value2", weights_.value2_weight(), weights_.value2_bias(), y,
              count_of(weights_.value1_bias(), "value1"));
    const int found = count_of(weights_.value2_bias(), "value2");
    if (found != (value_ == wdl_value ? 3 : 1))
        fail("expected {} values, found {}", value_ == wdl_value ? 3 : 1, found);
    if (value_ == wdl_value)
        name_output(graph_, "wdl", y);
    else
        name_output(graph_, "value", add_activation(graph_, "value.tanh", y, Activation::tanh));
    channels_ = body_channels;
}

void Lc0Importer::read_moves_left() {
    const int body_channels = channels_;
    int y = active("moves", convolution("moves", weights_.moves_left(), body_, 1));
    y = active("moves1", dense("moves1", weights_.moves1_weight(), weights_.moves1_bias(),
                               flat("moves", y), channels_ * squares));
    y = dense("moves2", weights_.moves2_weight(), weights_.moves2_bias(), y,
              count_of(weights_.moves1_bias(), "moves1"));
    name_output(graph_, "moves_left", add_activation(graph_, "moves.relu", y, Activation::relu));
    channels_ = body_channels;
}

// --- the policy map

// The plane of a move by (dx, dy) that is no underpromotion; -1 where no piece moves like that.
int plane_of(int dx, int dy) {
    constexpr std::array<std::array<int, 2>, 8> rays = {
        {{0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}}};
    constexpr std::array<std::array<int, 2>, 8> jumps = {
        {{1, 2}, {2, 1}, {2, -1}, {1, -2}, {-1, -2}, {-2, -1}, {-2, 1}, {-1, 2}}};
    for (int i = 0; i < 8; ++i)
        if (jumps[static_cast<std::size_t>(i)] == std::array{dx, dy}) return 56 + i;
    const int distance = std::max(std::abs(dx), std::abs(dy));
    for (int i = 0; i < 8; ++i) {
        const auto [x, y] = rays[static_cast<std::size_t>(i)];
        if (dx == x * distance && dy == y * distance) return 7 * i + distance - 1;
    }
    return -1;
}

}  // namespace

std::vector<int> lc0_policy_map() {
    std::vector<int> map;
    for (int from = 0; from < squares; ++from)
        for (int to = 0; to < squares; ++to) {
            const int plane = plane_of(to % 8 - from % 8, to / 8 - from / 8);
            if (from != to && plane >= 0) map.push_back(plane * squares + from);
        }
    // Promotions to queen, rook and bishop; to a knight is the plain move.
    constexpr std::array<int, 3> queen_rook_bishop = {2, 0, 1};
    for (int file = 0; file < 8; ++file)
        for (int to = std::max(file - 1, 0); to <= std::min(file + 1, 7); ++to)
            for (const int piece : queen_rook_bishop)
                map.push_back((64 + 3 * (to - file + 1) + piece) * squares + 48 + file);
    return map;
}

bool is_lc0(std::string_view bytes) {
    using namespace std::string_view_literals;
    return bytes.starts_with("\x0d\xc0\x01\x00\x00"sv);
}

Graph graph_from_lc0(std::string_view bytes) {
    lc0::Net net;
    if (bytes.size() > std::size_t{1} << 30 ||
        !net.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
        fail("expected lc0's protobuf message, found a damaged or cut one");
    return Lc0Importer(net).run();
}

}  // namespace nn
