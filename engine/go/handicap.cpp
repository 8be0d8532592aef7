// Handicap points: GTP's fixed ones (gtp2-spec-draft2, 4.1.1) and good ones for free placement.
#include <algorithm>
#include <cstdlib>

#include "engine/base/error.h"
#include "engine/go/go.h"

namespace go {

namespace {

struct Lines {
    int low, middle, high;
};

Lines star_lines(int size) {
    const int low = size < 13 ? 2 : 3;
    return {low, size / 2, size - 1 - low};
}

bool contains(const std::vector<Point>& points, Point point) {
    return std::find(points.begin(), points.end(), point) != points.end();
}

int distance(Point a, Point b) { return std::abs(a.x - b.x) + std::abs(a.y - b.y); }

// Lines from the nearest edge, counted up to 4.
int height(Point point, int size) {
    const int x = std::min(point.x, size - 1 - point.x);
    const int y = std::min(point.y, size - 1 - point.y);
    return std::min({x, y, 3}) + 1;
}

// Far from other stones and from the edge is better.
int spread(Point point, const std::vector<Point>& others, int size) {
    int nearest = 2 * size;
    for (const Point other : others) nearest = std::min(nearest, distance(point, other));
    return std::min(nearest, 2 * height(point, size)) * 8 + height(point, size);
}

Point next_free_point(int size, const std::vector<Point>& taken) {
    Point best;
    int best_spread = -1;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const int value = spread({x, y}, taken, size);
            if (contains(taken, {x, y}) || value <= best_spread) continue;
            best = {x, y};
            best_spread = value;
        }
    return best;
}

}  // namespace

int most_fixed_handicap(int size) {
    if (size < 7) return 0;
    return size % 2 == 0 || size == 7 ? 4 : 9;
}

std::vector<Point> fixed_handicap(int size, int stones) {
    const int most = most_fixed_handicap(size);
    if (most == 0) engine::fail("no fixed handicap on boards smaller than 7x7");
    if (stones < 2 || stones > most)
        engine::fail("fixed handicap on {0}x{0} is 2 to {1} stones, not {2}", size, most, stones);
    const auto [low, middle, high] = star_lines(size);
    std::vector<Point> points{{low, low},    {high, high},   {low, high},   {high, low},
                              {low, middle}, {high, middle}, {middle, low}, {middle, high}};
    points.resize(static_cast<std::size_t>(stones >= 8 ? 8 : stones - stones % 2 * (stones > 4)));
    if (stones > 4 && stones % 2 == 1) points.push_back({middle, middle});
    return points;
}

std::vector<Point> free_handicap(int size, int stones) {
    if (stones < 2 || stones >= size * size)
        engine::fail("free handicap on {0}x{0} is 2 to {1} stones, not {2}", size, size * size - 1,
                     stones);
    const int fixed = std::min(stones, most_fixed_handicap(size));
    std::vector<Point> points;
    if (fixed >= 2) points = fixed_handicap(size, fixed);
    while (static_cast<int>(points.size()) < stones)
        points.push_back(next_free_point(size, points));
    return points;
}

}  // namespace go
