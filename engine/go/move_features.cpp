#include "engine/go/move_features.h"

#include <algorithm>
#include <cassert>

#include "engine/go/symmetry.h"

namespace go::features {

namespace {

constexpr std::uint32_t mixed(std::uint32_t x) {
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

// About the middle of a 3x3 or larger square.
constexpr Offset turned(Offset offset, int symmetry) {
    const auto to = transformed({offset.dx, offset.dy}, 1, symmetry);
    return {to.x, to.y};
}

// Eight points around in RolloutBoard's order.
constexpr std::array<Offset, 8> around{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

template <std::size_t size>
constexpr std::size_t place(const std::array<Offset, size>& offsets, Offset wanted) {
    std::size_t i = 0;
    while (offsets[i].dx != wanted.dx || offsets[i].dy != wanted.dy) ++i;
    return i;
}

// Where each point goes, a symmetry.
template <std::size_t size>
constexpr auto places(const std::array<Offset, size>& offsets) {
    std::array<std::array<std::uint8_t, size>, 8> result{};
    for (int s = 0; s < symmetries; ++s)
        for (std::size_t i = 0; i < size; ++i)
            result[static_cast<std::size_t>(s)][i] =
                static_cast<std::uint8_t>(place(offsets, turned(offsets[i], s)));
    return result;
}

constexpr auto around_places = places(around);
constexpr auto diamond_places = places(diamond_offsets);

// By point and colour, for all symmetries.
constexpr auto diamond_hashes = [] {
    std::array<std::array<std::array<std::uint32_t, 8>, 4>, diamond_points> table{};
    for (std::size_t point = 0; point < table.size(); ++point)
        for (std::size_t colour = 0; colour < 4; ++colour)
            for (std::size_t s = 0; s < 8; ++s)
                table[point][colour][s] =
                    mixed(static_cast<std::uint32_t>(std::size_t{diamond_places[s][point]} * 4 +
                                                     colour + 1) *
                          0x9e3779b9u);
    return table;
}();

std::uint16_t turned_code(std::uint16_t code, std::size_t symmetry) {
    unsigned result = 0;
    for (std::size_t i = 0; i < 8; ++i)
        result |= (code >> (2 * i) & 3u) << (2 * std::size_t{around_places[symmetry][i]});
    return static_cast<std::uint16_t>(result);
}

std::vector<std::uint16_t> number_patterns() {
    std::vector<std::uint16_t> numbers(65536);
    int next = 0;
    for (unsigned code = 0; code < 65536; ++code) {
        unsigned least = code;
        for (std::size_t s = 1; s < 8; ++s)
            least = std::min<unsigned>(least, turned_code(static_cast<std::uint16_t>(code), s));
        numbers[code] =
            static_cast<std::uint16_t>(least == code ? pattern + next++ : numbers[least]);
    }
    assert(next == pattern_count);
    return numbers;
}

}  // namespace

const std::vector<std::uint16_t>& patterns_of_black() {
    static const auto numbers = number_patterns();
    return numbers;
}

void Diamond::add(int point, int colour) {
    const auto& hashes =
        diamond_hashes[static_cast<std::size_t>(point)][static_cast<std::size_t>(colour)];
    for (std::size_t s = 0; s < 8; ++s) hashes_[s] += hashes[s];
}

void Diamond::settle() {
    least_ = *std::min_element(hashes_.begin(), hashes_.end());
    symmetries_ = 0;
    for (std::size_t s = 0; s < 8; ++s) symmetries_ |= (hashes_[s] == least_ ? 1u : 0u) << s;
}

int Diamond::feature() const { return diamond + static_cast<int>(mixed(least_) % diamond_count); }

// Of the symmetries that make the same diamond of it, the one that puts the move first.
int Diamond::response_feature(int point) const {
    std::uint32_t first = diamond_points;
    for (std::size_t s = 0; s < 8; ++s)
        if (symmetries_ >> s & 1)
            first =
                std::min<std::uint32_t>(first, diamond_places[s][static_cast<std::size_t>(point)]);
    return response + static_cast<int>(mixed(least_ + (first + 1) * 0x9e3779b9u) % response_count);
}

int nakade_feature(const std::vector<Offset>& points) {
    auto least = ~std::uint32_t{0};
    for (int s = 0; s < symmetries; ++s) {
        std::uint32_t hash = 0;
        for (const auto& point : points) {
            const auto to = turned(point, s);
            hash += mixed(static_cast<std::uint32_t>((to.dx + 64) * 128 + to.dy + 64));
        }
        least = std::min(least, mixed(hash));
    }
    return nakade + static_cast<int>(least % nakade_count);
}

}  // namespace go::features
