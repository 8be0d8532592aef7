#include "selfplay/alphago/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "engine/base/files.h"
#include "selfplay/training/chart.h"
#include "selfplay/training/report_page.h"

namespace selfplay::alphago {

namespace {

namespace fs = std::filesystem;
using training::ChartLine;
using Json = nlohmann::ordered_json;
using Journal = std::vector<Json>;

Journal read_journal(const fs::path& path) {
    Journal journal;
    if (!fs::exists(path)) return journal;
    std::istringstream text(engine::read_file(path));
    for (std::string line; std::getline(text, line);)
        if (auto json = Json::parse(line, nullptr, false); json.is_object())
            journal.push_back(std::move(json));
    return journal;
}

// The lines that have such a number, over the stage's minutes.
ChartLine line_of(std::string name, const Journal& journal, const char* field, double factor = 1) {
    ChartLine line{std::move(name), {}, false};
    for (const auto& entry : journal)
        if (const auto found = entry.find(field); found != entry.end() && found->is_number())
            line.points.push_back({entry.value("minutes", 0.0), factor * found->get<double>()});
    return line;
}

// Each point the mean of `group` of them, for what is noisy.
ChartLine smoothed(const ChartLine& line, std::size_t group) {
    ChartLine smooth{line.name, {}, line.dots};
    for (std::size_t at = 0; at < line.points.size(); at += group) {
        const auto end = std::min(at + group, line.points.size());
        const auto count = static_cast<double>(end - at);
        training::ChartPoint mean;
        for (std::size_t i = at; i < end; ++i) {
            mean.x += line.points[i].x / count;
            mean.y += line.points[i].y / count;
        }
        smooth.points.push_back(mean);
    }
    return smooth;
}

class Page {
   public:
    explicit Page(const fs::path& folder)
        : rollout_(read_journal(folder / "rollout" / "rollout.jsonl")),
          policy_(read_journal(folder / "policy" / "policy.jsonl")),
          rl_(read_journal(folder / "rl" / "rl.jsonl")),
          value_(read_journal(folder / "value" / "value.jsonl")),
          value_of_all_(read_journal(folder / "value" / "all" / "value.jsonl")) {}

    std::string text(const std::string& title, std::span<const engine::OptionRow> settings) {
        html_ = training::page_head;
        html_ += fmt::format("<h1>{}</h1>\n<div class=\"charts\">\n", training::escaped(title));
        add_policies();
        add_reinforcement();
        add_value();
        html_ += "</div>\n";
        add_newest();
        add_settings(settings);
        return html_ + std::string(training::page_end);
    }

   private:
    void add(const char* title, const char* unit, std::vector<ChartLine> lines, bool from_zero) {
        std::erase_if(lines, [](const ChartLine& line) { return line.points.empty(); });
        if (lines.empty()) return;
        html_ += training::to_svg({title, "minutes", unit, std::move(lines), {}, from_zero});
    }

    void add_policies() {
        add("1. Rollouts: held-out moves foretold", "%",
            {line_of("rollout policy", rollout_, "rollout_accuracy", 100),
             line_of("tree policy", rollout_, "tree_accuracy", 100)},
            true);
        add("2. Policy: experts' moves foretold", "%",
            {line_of("learned", policy_, "accuracy", 100),
             line_of("held out", policy_, "held_out_accuracy", 100)},
            true);
        add("2. Policy: loss", "nats",
            {line_of("learned", policy_, "loss"), line_of("held out", policy_, "held_out_loss")},
            false);
    }
    void add_reinforcement() {
        constexpr std::size_t updates = 10;
        auto against_first = line_of("its beginning", rl_, "score_against_first", 100);
        against_first.dots = true;
        add("3. Reinforced: score without search against", "%",
            {smoothed(line_of("its past", rl_, "score", 100), updates), against_first}, true);
        add("3. Reinforced: length of games", "plies",
            {smoothed(line_of("", rl_, "plies"), updates)}, true);
    }
    void add_value() {
        const auto errors = [](const Journal& journal, const char* learned, const char* held_out) {
            return std::vector{line_of(learned, journal, "train_error"),
                               line_of(held_out, journal, "test_error")};
        };
        auto lines = errors(value_, "learned", "held out");
        for (auto& line : errors(value_of_all_, "all turns: learned", "all turns: held out"))
            lines.push_back(std::move(line));
        add("4. Value: squared error", "", std::move(lines), true);
    }

    // What each stage said last, by the names of its journal.
    void add_newest() {
        html_ += "<h2>Newest figures</h2>\n<table>\n";
        for (const auto* journal : {&rollout_, &policy_, &rl_, &value_, &value_of_all_}) {
            if (journal->empty()) continue;
            const auto& newest = journal->back();
            for (const auto& [name, value] : newest.items())
                if (value.is_number_float())
                    add_row(newest, name, fmt::format("{:.4g}", value.get<double>()));
                else if (value.is_number())
                    add_row(newest, name, value.dump());
        }
        html_ += "</table>\n";
    }
    void add_row(const Json& entry, const std::string& name, const std::string& value) {
        html_ += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                             training::escaped(entry.value("stage", "")), training::escaped(name),
                             training::escaped(value));
    }

    void add_settings(std::span<const engine::OptionRow> settings) {
        html_ += "<h2>Settings</h2>\n<table class=\"settings\">\n";
        html_ += training::setting_lines(settings) + "</table>\n";
    }

    Journal rollout_, policy_, rl_, value_, value_of_all_;
    std::string html_;
};

}  // namespace

std::string report_html(const fs::path& folder, const std::string& title,
                        std::span<const engine::OptionRow> settings) {
    return Page(folder).text(title, settings);
}

}  // namespace selfplay::alphago
