// Curves as SVG: a title, axes with round numbers, lines, points with error bars, and levels
// to compare with. Pure functions from numbers to text.
#pragma once

#include <string>
#include <vector>

namespace selfplay::training {

struct ChartPoint {
    double x = 0, y = 0;
    double low = 0, high = 0;  // of an error bar, where they differ
};

struct ChartLine {
    std::string name;
    std::vector<ChartPoint> points;
    bool dots = false;  // points are marked
};

struct ChartLevel {
    std::string name;
    double y = 0;
};

struct Chart {
    std::string title, x_unit, y_unit;
    std::vector<ChartLine> lines;
    std::vector<ChartLevel> levels;
    bool from_zero = false;  // the axis of y begins at 0
};

std::string to_svg(const Chart& chart);  // to stand in a page
std::string to_svg_file(const Chart& chart);

// Text that may stand in HTML.
std::string escaped(std::string_view text);

}  // namespace selfplay::training
