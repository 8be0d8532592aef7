#include "nn/leela_zero.h"

#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "nn/compose.h"

namespace nn {

namespace {

using engine::fail;

constexpr int leela_planes = 18;
constexpr std::size_t most_leela_channels = 1 << 12, most_lines = 4000;

using Line = std::vector<float>;

Line numbers_of(std::string_view text, std::size_t line) {
    Line numbers;
    while (!text.empty()) {
        if (text.front() == ' ' || text.front() == '\t' || text.front() == '\r') {
            text.remove_prefix(1);
            continue;
        }
        double value = 0;
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool tiny = status == std::errc::result_out_of_range && std::abs(value) < 1;
        if ((status != std::errc{} && !tiny) || !std::isfinite(value) || std::abs(value) > 3e38)
            fail("line {}: expected a number, found something else", line);
        numbers.push_back(tiny ? 0 : static_cast<float>(value));
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    return numbers;
}

std::vector<Line> lines_of(std::string_view text) {
    std::vector<Line> lines;
    while (!text.empty()) {
        if (lines.size() > most_lines) fail("expected at most {} lines, found more", most_lines);
        const auto end = std::min(text.find('\n'), text.size());
        lines.push_back(numbers_of(text.substr(0, end), lines.size() + 1));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    while (!lines.empty() && lines.back().empty()) lines.pop_back();
    return lines;
}

class LeelaZeroImporter {
   public:
    explicit LeelaZeroImporter(std::vector<Line> lines) : lines_(std::move(lines)) {}

    Graph run() {
        measure();
        int x = add_input(graph_, "planes", {leela_planes, true});
        x = normed("input", x, leela_planes, channels_, 3);
        x = relu("input", x);
        for (int i = 0; i < graph_.facts.blocks; ++i) x = block(fmt::format("block{}", i), x);
        policy(x);
        value(x);
        validate(graph_);
        return std::move(graph_);
    }

   private:
    void measure() {
        constexpr std::size_t heads = 19, per_block = 8;
        if (lines_.size() < heads || (lines_.size() - heads) % per_block != 0)
            fail("expected {} lines and {} for each block, found {}", heads, per_block,
                 lines_.size());
        if (lines_[0].size() != 1)
            fail("line 1: expected the version, found {} numbers", lines_[0].size());
        const auto channels = lines_[2].size();
        if (channels == 0 || channels > most_leela_channels)
            fail("expected 1 to {} channels, found {}", most_leela_channels, channels);
        channels_ = static_cast<int>(channels);
        if (lines_[1].size() != channels * leela_planes * 9)
            fail("expected {} weights for {} planes, found {} (a text network of lc0?)",
                 channels * leela_planes * 9, leela_planes, lines_[1].size());
        const auto moves = lines_[lines_.size() - 9].size();
        int board = 2;
        const auto moves_of = [](int size) {
            const auto side = static_cast<std::size_t>(size);
            return side * side + 1;
        };
        while (board < 25 && moves_of(board) < moves) ++board;
        if (moves_of(board) != moves)
            fail("expected moves for a square board and a pass, found {}", moves);
        auto& facts = graph_.facts;
        facts.game = "go";
        facts.encoding = lines_[0][0] == 2 ? "leela-zero-18-black" : "leela-zero-18";
        facts.source = "Leela Zero";
        facts.board = board;
        facts.blocks = static_cast<int>((lines_.size() - heads) / per_block);
        facts.channels = channels_;
    }

    Tensor take(const std::string& name, std::vector<int> shape) {
        std::size_t count = 1;
        for (const int side : shape) count *= static_cast<std::size_t>(side);
        auto& line = lines_[next_++];
        if (line.size() != count)
            fail("line {} ({}): expected {} numbers, found {}", next_, name, count, line.size());
        return {std::move(shape), std::move(line)};
    }

    int normed(const std::string& name, int x, int in, int out, int side) {
        auto kernel = take(name, {out, in, side, side});
        auto bias = take(name, {out});
        auto mean = take(name, {out});
        auto variance = take(name, {out});
        const auto count = static_cast<std::size_t>(out);
        x = add_convolution(graph_, name, x, {std::move(kernel), std::move(bias)});
        return add_batch_norm(
            graph_, name + ".norm", x,
            {std::move(mean), std::move(variance), Tensor{{out}, std::vector<float>(count, 1)},
             Tensor{{out}, std::vector<float>(count, 0)}},
            1e-5f);
    }

    int relu(const std::string& name, int x) {
        return add_activation(graph_, name + ".relu", x, Activation::relu);
    }

    int block(const std::string& name, int x) {
        const int first =
            relu(name + ".first", normed(name + ".first", x, channels_, channels_, 3));
        const int second = normed(name + ".second", first, channels_, channels_, 3);
        return relu(name, add_operation(graph_, Operation::add, name + ".sum", {second, x}));
    }

    int dense(const std::string& name, int x, int in, int out) {
        auto weight = take(name, {out, in});
        auto bias = take(name, {out});
        return add_dense(graph_, name, x, {std::move(weight), std::move(bias)});
    }

    int flat(const std::string& name, int x) {
        return add_operation(graph_, Operation::flatten, name + ".flat", {x});
    }

    int points() const { return graph_.facts.board * graph_.facts.board; }

    void policy(int x) {
        const int planes = relu("policy", normed("policy", x, channels_, 2, 1));
        name_output(graph_, "policy",
                    dense("policy.moves", flat("policy", planes), 2 * points(), points() + 1));
    }

    void value(int x) {
        const int planes = relu("value", normed("value", x, channels_, 1, 1));
        const int width = static_cast<int>(std::min(lines_[next_ + 1].size(), most_leela_channels));
        const int hidden = relu("value1", dense("value1", flat("value", planes), points(), width));
        name_output(graph_, "value",
                    add_activation(graph_, "value.tanh", dense("value2", hidden, width, 1),
                                   Activation::tanh));
    }

    std::vector<Line> lines_;
    std::size_t next_ = 1;  // line 1 is the version
    Graph graph_;
    int channels_ = 0;
};

}  // namespace

bool is_leela_zero(std::string_view bytes) {
    const auto end = bytes.find('\n');
    const auto line = bytes.substr(0, std::min<std::size_t>(end, 3));
    return end != bytes.npos && (line == "1" || line == "2" || line == "1\r" || line == "2\r");
}

Graph graph_from_leela_zero(std::string_view bytes) {
    return LeelaZeroImporter(lines_of(bytes)).run();
}

}  // namespace nn
