#include "selfplay/training/report.h"

#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "selfplay/training/chart.h"
#include "selfplay/training/report_page.h"

namespace selfplay::training {

namespace {

using Field = std::function<double(const Entry&)>;

// The unit in which a run of that length is told.
struct TimeUnit {
    std::string name;
    double seconds;
};
TimeUnit time_unit(double seconds) {
    if (seconds < 3 * 3600) return {"minutes", 60};
    return seconds < 3 * 86400 ? TimeUnit{"hours", 3600} : TimeUnit{"days", 86400};
}

// At most so many points, each the mean of its neighbours.
ChartLine line_of(const std::string& name, std::span<const Entry> entries, const TimeUnit& unit,
                  const Field& field) {
    constexpr std::size_t most = 240;
    const std::size_t group = entries.size() / most + 1;
    ChartLine line{name, {}, false};
    for (std::size_t at = 0; at < entries.size(); at += group) {
        const auto part = entries.subspan(at, std::min(group, entries.size() - at));
        ChartPoint point;
        for (const auto& entry : part) {
            point.x += entry.seconds / unit.seconds / static_cast<double>(part.size());
            point.y += field(entry) / static_cast<double>(part.size());
        }
        line.points.push_back(point);
    }
    return line;
}

double share(std::uint64_t part, std::uint64_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

bool is_empty(const Chart& chart) { return chart.lines[0].points.empty(); }

class Page {
   public:
    explicit Page(const ReportInput& input)
        : input_(input),
          unit_(time_unit(input.entries.empty() ? 0 : input.entries.back().seconds)) {}

    std::string text() {
        html_ = page_head;
        html_ += fmt::format("<h1>{}</h1>\n", escaped(title()));
        if (!input_.entries.empty()) html_ += summary(input_.entries.back());
        html_ += "<div class=\"charts\">\n";
        if (const auto chart = ladder(); !is_empty(chart)) html_ += to_svg(chart);
        add_learning();
        add_games();
        html_ += "</div>\n";
        add_table();
        add_sample();
        add_settings();
        return html_ + std::string(page_end);
    }

    Chart ladder() const {
        Chart chart{"Strength", unit_.name, "Elo", {{"", {}, true}}, {}, false};
        for (const auto& rung : input_.rungs) {
            const auto& [elo, deviation] = rung.strength;
            if (rung.seconds >= 0 && rung.games > 0)
                chart.lines[0].points.push_back(
                    {rung.seconds / unit_.seconds, elo, elo - 2 * deviation, elo + 2 * deviation});
            if (rung.seconds < 0 && (rung.games > 0 || &rung == input_.rungs.data()))
                chart.levels.push_back({rung.name, elo});
        }
        return chart;
    }

   private:
    std::string title() const {
        const auto& settings = input_.settings;
        const auto size = settings.actors.size;
        return settings.game == "go"
                   ? fmt::format("Go on {0}x{0}, komi {1}: {2} blocks of {3}", size,
                                 settings.actors.komi, settings.network.blocks,
                                 settings.network.channels)
                   : fmt::format("{}: {} blocks of {}", settings.game, settings.network.blocks,
                                 settings.network.channels);
    }

    std::string summary(const Entry& entry) const {
        auto text = fmt::format(
            "<p>{:.0f} {} · {} games · {} positions to learn from · {} steps · {:.0f} games an "
            "hour",
            entry.seconds / unit_.seconds, unit_.name, entry.games, entry.positions, entry.steps,
            entry.games_per_hour);
        for (const auto& rung : input_.rungs)
            if (&rung == &input_.rungs.back() && rung.seconds >= 0 && rung.games > 0)
                text += fmt::format(" · {:+.0f} ± {:.0f} Elo against UCT 1000", rung.strength.elo,
                                    2 * rung.strength.deviation);
        return text + "</p>\n";
    }

    void add(std::string name, std::string y_unit, std::vector<ChartLine> lines,
             bool from_zero = true) {
        html_ += to_svg(
            {std::move(name), unit_.name, std::move(y_unit), std::move(lines), {}, from_zero});
    }
    ChartLine line(const std::string& name, const Field& field) const {
        return line_of(name, input_.entries, unit_, field);
    }
    // What was learned from beside what was held out.
    std::vector<ChartLine> both(double Quality::*field, double factor = 1) const {
        return {line("learned", [=](const Entry& e) { return factor * e.learned.*field; }),
                line("held out", [=](const Entry& e) { return factor * e.held_out.*field; })};
    }

    void add_learning() {
        add("Loss", "", both(&Quality::loss), false);
        add("Policy: likeliest move is the search's", "%", both(&Quality::policy_accuracy, 100));
        add("Policy loss", "nats", both(&Quality::policy_loss), false);
        add("Value error", "square", both(&Quality::value_error));
        if (input_.settings.game == "go" && input_.settings.network.ownership)
            add("Ownership loss", "nats", both(&Quality::ownership_loss), false);
    }

    void add_games() {
        add("Games an hour", "", {line("", [](const Entry& e) { return e.games_per_hour; })});
        add("Network evaluations a second", "",
            {line("", [](const Entry& e) { return e.evaluations_per_second; })});
        add("Length of games", "plies", {line("", [](const Entry& e) {
                return e.played.games > 0 ? static_cast<double>(e.played.plies) /
                                                static_cast<double>(e.played.games)
                                          : 0;
            })});
        add("Endings", "% of games",
            {line("first player wins",
                  [](const Entry& e) { return share(e.played.first_wins, e.played.games); }),
             line("draws", [](const Entry& e) { return share(e.played.draws, e.played.games); }),
             line("resigned",
                  [](const Entry& e) { return share(e.played.resigned, e.played.games); }),
             line("cut off",
                  [](const Entry& e) { return share(e.played.cut_off, e.played.games); })});
    }

    void add_table() {
        html_ +=
            "<h2>Ladder</h2>\n<table><tr><th>player</th><th>Elo</th><th>± (95 %)</th>"
            "<th>games</th></tr>\n";
        for (const auto& rung : input_.rungs)
            html_ += fmt::format("<tr><td>{}</td><td>{:+.0f}</td><td>{:.0f}</td><td>{}</td></tr>\n",
                                 escaped(rung.name), rung.strength.elo, 2 * rung.strength.deviation,
                                 rung.games);
        html_ += "</table>\n";
    }

    void add_sample() {
        if (input_.sample.positions.empty()) return;
        const nlohmann::ordered_json json{{"game", input_.settings.game},
                                          {"positions", input_.sample.positions},
                                          {"moves", input_.sample.moves},
                                          {"values", input_.sample.values}};
        html_ += fmt::format(
            "<h2>A game of self-play</h2>\n<p>{}</p>\n{}<script>\nconst sample = "
            "{};\n{}</script>\n",
            escaped(input_.sample.result), page_board, json.dump(), page_script);
    }

    void add_settings() {
        html_ += "<h2>Settings</h2>\n<table class=\"settings\">\n";
        html_ +=
            fmt::format("<tr><td>preset</td><td>{}</td></tr>\n", escaped(input_.settings.preset));
        html_ += setting_lines(setting_rows(input_.settings)) + "</table>\n";
    }

    const ReportInput& input_;
    TimeUnit unit_;
    std::string html_;
};

}  // namespace

std::string report_html(const ReportInput& input) { return Page(input).text(); }

std::string ladder_svg(const ReportInput& input) {
    const auto chart = Page(input).ladder();
    return is_empty(chart) ? "" : to_svg_file(chart);
}

}  // namespace selfplay::training
