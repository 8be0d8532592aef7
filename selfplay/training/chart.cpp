#include "selfplay/training/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace selfplay::training {

namespace {

constexpr double width = 460, height = 250;
constexpr double left = 58, right = 14, top = 34, bottom = 34;
// Told apart by people who see few colours too (Okabe and Ito).
constexpr std::array<const char*, 4> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void take(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    // Something to draw on whatever there was.
    void settle() {
        if (!(low <= high)) low = 0, high = 1;
        if (high - low < 1e-9) low -= 0.5, high += 0.5;
    }
};

// A step of 1, 2 or 5 times a power of ten that divides the range into about `count` parts.
double round_step(const Range& range, int count) {
    const double rough = (range.high - range.low) / count;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= rough) return factor * power;
    return 10 * power;
}

std::string number(double value, double step) {
    if (std::abs(value) < step / 1e6) value = 0;
    if (std::abs(value) >= 10'000 && step >= 1000) return fmt::format("{:.4g} k", value / 1000);
    const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    return fmt::format("{:.{}f}", value, digits);
}

constexpr std::string_view head = R"(<svg viewBox="0 0 {} {}" role="img">
<style>
svg text {{ font: 11px system-ui, sans-serif; fill: #555; }}
svg .title {{ font-size: 13px; font-weight: 600; fill: #222; }}
svg .down {{ text-anchor: end; }} svg .along {{ text-anchor: middle; }}
svg polyline {{ fill: none; stroke-width: 1.6; stroke-linejoin: round; }}
svg .grid {{ stroke: #eee; }} svg .axis {{ stroke: #999; }}
svg .level {{ stroke: #999; stroke-dasharray: 4 3; }}
</style>
<rect width="100%" height="100%" fill="#fff"/>
<text class="title" x="8" y="18">{}</text>
)";

class Drawing {
   public:
    explicit Drawing(const Chart& chart) : chart_(chart) {
        for (const auto& line : chart.lines)
            for (const auto& point : line.points) take(point);
        for (const auto& level : chart.levels) y_.take(level.y);
        if (chart.from_zero) y_.take(0);
        x_.settle();
        y_.settle();
        if (!chart.from_zero) y_.low -= (y_.high - y_.low) * 0.04;
        y_.high += (y_.high - y_.low) * 0.06;
    }

    std::string text() {
        svg_ = fmt::format(head, width, height, escaped(chart_.title));
        draw_axes();
        for (std::size_t i = 0; i < chart_.levels.size(); ++i)
            draw(chart_.levels[i], left + 4 + static_cast<double>(i % 4) * 92);
        for (std::size_t i = 0; i < chart_.lines.size(); ++i)
            draw(chart_.lines[i], colours[i % colours.size()]);
        draw_names();
        return svg_ + "</svg>\n";
    }

   private:
    void take(const ChartPoint& point) {
        x_.take(point.x);
        y_.take(point.y);
        if (point.low < point.high) y_.take(point.low), y_.take(point.high);
    }
    double across(double x) const {
        return left + (x - x_.low) / (x_.high - x_.low) * (width - left - right);
    }
    double up(double y) const {
        return height - bottom - (y - y_.low) / (y_.high - y_.low) * (height - top - bottom);
    }
    void line(const char* kind, double x1, double y1, double x2, double y2) {
        svg_ += fmt::format(
            "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind,
            x1, y1, x2, y2);
    }
    void label(const char* kind, double x, double y, const std::string& text) {
        svg_ += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", kind, x, y,
                            escaped(text));
    }

    void draw_axes() {
        const double y_step = round_step(y_, 5), x_step = round_step(x_, 6);
        for (double y = std::ceil(y_.low / y_step) * y_step; y <= y_.high; y += y_step) {
            line("grid", left, up(y), width - right, up(y));
            label("down", left - 6, up(y) + 4, number(y, y_step));
        }
        for (double x = std::ceil(x_.low / x_step) * x_step; x <= x_.high; x += x_step)
            label("along", across(x), height - bottom + 16, number(x, x_step));
        line("axis", left, height - bottom, width - right, height - bottom);
        label("along", (left + width - right) / 2, height - 4, chart_.x_unit);
        label("down", width - right, 18, chart_.y_unit);
    }

    // Names stand beside each other, as levels may lie close together.
    void draw(const ChartLevel& level, double name_x) {
        line("level", left, up(level.y), width - right, up(level.y));
        label("name", name_x, up(level.y) - 3, level.name);
    }

    void draw(const ChartLine& line, const char* colour) {
        std::string path;
        for (const auto& point : line.points)
            path += fmt::format("{:.1f},{:.1f} ", across(point.x), up(point.y));
        svg_ += fmt::format("<polyline stroke=\"{}\" points=\"{}\"/>\n", colour, path);
        for (const auto& point : line.points) {
            if (point.low < point.high)
                svg_ += fmt::format(
                    "<line stroke=\"{0}\" x1=\"{1:.1f}\" y1=\"{2:.1f}\" x2=\"{1:.1f}\" "
                    "y2=\"{3:.1f}\"/>\n",
                    colour, across(point.x), up(point.low), up(point.high));
            if (line.dots)
                svg_ += fmt::format("<circle fill=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>\n",
                                    colour, across(point.x), up(point.y));
        }
    }

    // Only where there is more than one line to tell apart.
    void draw_names() {
        if (chart_.lines.size() < 2) return;
        double x = left + 4;
        for (std::size_t i = 0; i < chart_.lines.size(); ++i) {
            const auto& name = chart_.lines[i].name;
            svg_ += fmt::format(
                "<text class=\"name\" fill=\"{}\" style=\"fill:{}\" x=\"{:.1f}\" "
                "y=\"{}\">{}</text>\n",
                colours[i % colours.size()], colours[i % colours.size()], x, top - 2,
                escaped(name));
            x += 14 + 6.2 * static_cast<double>(name.size());
        }
    }

    const Chart& chart_;
    Range x_, y_;
    std::string svg_;
};

}  // namespace

std::string to_svg(const Chart& chart) { return Drawing(chart).text(); }

std::string to_svg_file(const Chart& chart) {
    constexpr std::string_view element = "<svg", space = R"( xmlns="http://www.w3.org/2000/svg")";
    return to_svg(chart).insert(element.size(), space);
}

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (c == '&')
            safe += "&amp;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += c;
    }
    return safe;
}

}  // namespace selfplay::training
