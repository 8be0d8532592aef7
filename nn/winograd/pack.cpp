#include "nn/winograd/pack.h"

#include <algorithm>
#include <cmath>

#include "nn/index.h"

namespace nn::winograd {

namespace {

// One 3x3 kernel seen from a cell of the tile: (G g G^T) there.
double kernel_at(const Tiling& tiling, int cell, const float* g) {
    const auto& down = tiling.kernel[at(cell / tiling.side())];
    const auto& along = tiling.kernel[at(cell % tiling.side())];
    double sum = 0;
    for (std::size_t y = 0; y < 3; ++y)
        for (std::size_t x = 0; x < 3; ++x) sum += down[y] * along[x] * double{g[y * 3 + x]};
    return sum;
}

// The weights of one output channel at one cell, in units of the inputs' steps.
struct Row {
    std::vector<double> weights;
    double largest_input = 0;

    // As small as may be: no weight over 15 bits, no sum of products over 31, rounding included.
    double scale() const {
        double most = 0, sum = 0;
        for (const double weight : weights) {
            most = std::max(most, std::abs(weight));
            sum += std::abs(weight);
        }
        const double room =
            2147483000.0 / largest_input - 0.5 * static_cast<double>(weights.size());
        return std::max({most / 32767, sum / room, 1e-30});
    }
};

class Packer {
   public:
    Packer(const Tensor& kernel, const Quantisation& input, const Tiling* tiling)
        : kernel_(kernel), input_(input), tiling_(tiling) {}

    Group pack(int channel, int width) const {
        const int cells = tiling_ ? tiling_->cells() : 1, pairs = padded(inputs()) / 2;
        Group group{width, channel, Buffer<std::int16_t>(at(cells * pairs * width * lanes * 2)),
                    Buffer<float>(at(cells * width * lanes))};
        for (int cell = 0; cell < cells; ++cell)
            for (int o = 0; o < width * lanes && channel + o < kernel_.shape[0]; ++o) {
                const auto row = row_of(cell, channel + o);
                const double scale = row.scale();
                group.scale[at(cell * width * lanes + o)] = static_cast<float>(scale);
                for (int i = 0; i < inputs(); ++i)
                    group.weights[at((((cell * pairs + i / 2) * width * lanes) + o) * 2 + i % 2)] =
                        static_cast<std::int16_t>(std::lrint(row.weights[at(i)] / scale));
            }
        return group;
    }

   private:
    int inputs() const { return kernel_.shape[1]; }

    Row row_of(int cell, int output) const {
        Row row;
        const int size = kernel_.shape[2] * kernel_.shape[3];
        for (int i = 0; i < inputs(); ++i) {
            const float* g = kernel_.values.data() + at(output * inputs() + i) * at(size);
            const double weight = tiling_ ? kernel_at(*tiling_, cell, g) : double{*g};
            row.weights.push_back(weight * double{input_.steps[at(i)]});
        }
        row.largest_input = tiling_ ? tiling_->gain(cell, input_.low, input_.high)
                                    : std::max(input_.low, input_.high);
        return row;
    }

    const Tensor& kernel_;
    const Quantisation& input_;
    const Tiling* tiling_;
};

// The taps of a kernel that lie on the board, cut as border class `kind` says.
bool on_board(int tap, int kind, int radius) {
    return kind <= radius ? tap >= radius - kind : tap <= 3 * radius - kind;
}

}  // namespace

std::vector<int> split_widths(int vectors, int most) {
    if (most < 3) return std::vector<int>(at(vectors), 1);
    if (vectors == 5) return {3, 2};
    if (vectors < 3) return {vectors};
    if (vectors % 3 == 0) return std::vector<int>(at(vectors / 3), 3);
    std::vector<int> widths;
    for (; vectors % 3 != 0; vectors -= 4) widths.push_back(4);
    for (; vectors > 0; vectors -= 3) widths.push_back(3);
    return widths;
}

std::vector<Group> pack_convolution(const Tensor& kernel, const Quantisation& input,
                                    const Tiling* tiling, int widest) {
    const Packer packer(kernel, input, tiling);
    std::vector<Group> groups;
    int channel = 0;
    for (const int width : split_widths(padded(kernel.shape[0]) / lanes, widest)) {
        groups.push_back(packer.pack(channel, width));
        channel += width * lanes;
    }
    return groups;
}

Buffer<float> pack_first(const Tensor& kernel) {
    const int outs = kernel.shape[0], planes = kernel.shape[1];
    const int taps = kernel.shape[2] * kernel.shape[3];
    Buffer<float> packed(at(taps * planes) * at(padded(outs)));
    for (int o = 0; o < outs; ++o)
        for (int i = 0; i < planes; ++i)
            for (int tap = 0; tap < taps; ++tap)
                packed[at(tap * planes + i) * at(padded(outs)) + at(o)] =
                    kernel.values[at((o * planes + i) * taps + tap)];
    return packed;
}

Buffer<float> pack_borders(const Tensor& kernel) {
    const int outs = kernel.shape[0], planes = kernel.shape[1], side = kernel.shape[2];
    Buffer<float> packed(at(planes * side * side) * at(padded(outs)));
    for (int i = 0; i < planes; ++i)
        for (int kind = 0; kind < side * side; ++kind)
            for (int tap = 0; tap < side * side; ++tap) {
                if (!on_board(tap / side, kind / side, side / 2) ||
                    !on_board(tap % side, kind % side, side / 2))
                    continue;
                for (int o = 0; o < outs; ++o)
                    packed[at(i * side * side + kind) * at(padded(outs)) + at(o)] +=
                        kernel.values[at((o * planes + i) * side * side + tap)];
            }
    return packed;
}

Buffer<float> pack_dense(const Tensor& weights) {
    const int outs = weights.shape[0], ins = weights.shape[1];
    Buffer<float> packed(at(ins) * at(padded(outs)));
    for (int o = 0; o < outs; ++o)
        for (int i = 0; i < ins; ++i)
            packed[at(i) * at(padded(outs)) + at(o)] = weights.values[at(o) * at(ins) + at(i)];
    return packed;
}

Buffer<float> pack_vector(const std::vector<float>& values, float filler) {
    Buffer<float> packed(at(padded(static_cast<int>(values.size()))));
    std::fill_n(packed.data(), packed.size(), filler);
    std::copy(values.begin(), values.end(), packed.data());
    return packed;
}

}  // namespace nn::winograd
