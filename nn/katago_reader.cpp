#include "nn/katago_reader.h"

#include <charconv>
#include <cmath>
#include <cstring>

#include "engine/base/error.h"

namespace nn::katago {

namespace {

using engine::fail;

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// What a message may quote of a file that could hold anything.
std::string quoted(std::string_view text) {
    std::string shown;
    for (const char c : text.substr(0, 40)) shown += c > ' ' && c < '\x7f' ? c : '?';
    return shown;
}

}  // namespace

void Reader::refuse(std::string_view what, std::string_view found) const {
    fail("expected {} at byte {}, found \"{}\"", what, at_, quoted(found));
}

void Reader::skip_space() {
    while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
}

std::string_view Reader::word(std::string_view what) {
    skip_space();
    const auto start = at_;
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
    if (at_ == start) fail("expected {} at byte {}, found the end of the file", what, at_);
    return bytes_.substr(start, at_ - start);
}

int Reader::integer(std::string_view what, int least, int most) {
    const auto text = word(what);
    int value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size() || value < least || value > most)
        refuse(fmt::format("{} ({}..{})", what, least, most), text);
    return value;
}

float Reader::number(std::string_view what) {
    const auto text = word(what);
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    // Below the smallest double is as good as zero.
    if (status == std::errc::result_out_of_range && text.find("e-") != text.npos) return 0;
    if (status != std::errc{} || end != text.data() + text.size() || !std::isfinite(value) ||
        std::abs(value) > 3e38)
        refuse(what, text);
    return static_cast<float>(value);
}

std::vector<float> Reader::floats(std::string_view what, std::int64_t count) {
    skip_space();
    const auto left = bytes_.size() - at_;
    // A float takes at least two characters as text and four in binary.
    if (count < 0 || static_cast<std::uint64_t>(count) > left / 2 + 1)
        fail("expected {} floats of {} at byte {}, found {} bytes", count, what, at_, left);
    std::vector<float> values(static_cast<std::size_t>(count));
    constexpr std::string_view mark = "@BIN@";
    if (!bytes_.substr(at_).starts_with(mark)) {
        for (auto& value : values) value = number(what);
        return values;
    }
    at_ += mark.size();
    if (values.size() * 4 > bytes_.size() - at_)
        fail("expected {} bytes of {}, found {}", values.size() * 4, what, bytes_.size() - at_);
    std::memcpy(values.data(), bytes_.data() + at_, values.size() * 4);
    at_ += values.size() * 4;
    return values;
}

Convolution read_convolution(Reader& reader, int inputs) {
    const std::string name(reader.word("the name of a convolution"));
    const int height = reader.integer("kernel height", 1, 9);
    const int width = reader.integer("kernel width", 1, 9);
    const int in = reader.integer("input channels", 1, most_channels);
    const int out = reader.integer("output channels", 1, most_channels);
    const int dilation = reader.integer("dilation", 1, 100) * reader.integer("dilation", 1, 100);
    if (height != width || height % 2 == 0 || dilation != 1)
        fail("{}: expected a square, odd, undilated kernel, found {}x{}", name, height, width);
    if (in != inputs) fail("{}: expected {} input channels, found {}", name, inputs, in);
    const int area = height * width;
    const auto values = reader.floats(name, std::int64_t{area} * in * out);  // [y, x, in, out]
    Tensor kernel{{out, in, height, width}, std::vector<float>(values.size())};
    std::size_t next = 0;
    for (int k = 0; k < area; ++k)
        for (int i = 0; i < in; ++i)
            for (int o = 0; o < out; ++o)
                kernel.values[(static_cast<std::size_t>(o) * static_cast<std::size_t>(in) +
                               static_cast<std::size_t>(i)) *
                                  static_cast<std::size_t>(area) +
                              static_cast<std::size_t>(k)] = values[next++];
    return {name, std::move(kernel)};
}

Matrix read_matrix(Reader& reader, int inputs) {
    const std::string name(reader.word("the name of a matrix"));
    const int in = reader.integer("input channels", 1, most_channels);
    const int out = reader.integer("output channels", 1, most_channels);
    if (in != inputs) fail("{}: expected {} inputs, found {}", name, inputs, in);
    const auto values = reader.floats(name, std::int64_t{in} * out);  // [in, out]
    Tensor weight{{out, in}, std::vector<float>(values.size())};
    for (int i = 0; i < in; ++i)
        for (int o = 0; o < out; ++o)
            weight.values[static_cast<std::size_t>(o) * static_cast<std::size_t>(in) +
                          static_cast<std::size_t>(i)] =
                values[static_cast<std::size_t>(i) * static_cast<std::size_t>(out) +
                       static_cast<std::size_t>(o)];
    return {name, std::move(weight)};
}

Norm read_norm(Reader& reader, int channels) {
    Norm norm{std::string(reader.word("the name of a batch norm")), {}, 0};
    const int count = reader.integer("channels", 1, most_channels);
    if (count != channels) fail("{}: expected {} channels, found {}", norm.name, channels, count);
    norm.epsilon = reader.number("epsilon");
    const bool has_scale = reader.integer("whether it scales", 0, 1) == 1;
    const bool has_shift = reader.integer("whether it shifts", 0, 1) == 1;
    const auto read = [&](bool there, float otherwise) {
        return Tensor{{channels},
                      there ? reader.floats(norm.name, channels)
                            : std::vector<float>(static_cast<std::size_t>(channels), otherwise)};
    };
    norm.weights = {read(true, 0)};
    norm.weights.push_back(read(true, 0));
    norm.weights.push_back(read(has_scale, 1));
    norm.weights.push_back(read(has_shift, 0));
    return norm;
}

Tensor read_bias(Reader& reader, int channels) {
    const std::string name(reader.word("the name of a bias"));
    const int count = reader.integer("channels", 1, most_channels);
    if (count != channels) fail("{}: expected {} channels, found {}", name, channels, count);
    return {{channels}, reader.floats(name, channels)};
}

Activation read_activation(Reader& reader, int version) {
    const std::string name(reader.word("the name of an activation"));
    if (version < 11) return Activation::relu;
    const auto kind = reader.word("a kind of activation");
    if (kind == "ACTIVATION_IDENTITY") return Activation::identity;
    if (kind == "ACTIVATION_RELU") return Activation::relu;
    if (kind == "ACTIVATION_MISH") return Activation::mish;
    if (kind == "ACTIVATION_SILU") return Activation::silu;
    fail("{}: unknown activation \"{}\"", name, quoted(kind));
}

}  // namespace nn::katago
