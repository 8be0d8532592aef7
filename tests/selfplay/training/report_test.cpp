#include "selfplay/training/report.h"

#include <gtest/gtest.h>

namespace selfplay::training {
namespace {

struct RunSoFar {
    Settings settings;
    std::vector<Entry> entries = std::vector<Entry>(3);
    std::vector<Rung> rungs;

    RunSoFar() {
        for (std::size_t i = 0; i < entries.size(); ++i)
            entries[i].seconds = 60 * static_cast<double>(i + 1);
    }
    void climb(const std::string& name, double seconds, double elo) {
        Rung rung;
        rung.name = name;
        rung.seconds = seconds;
        rung.strength = {elo, 20};
        rung.games = 10;
        rungs.push_back(rung);
    }
    ReportInput told() const { return {settings, entries, rungs, {}}; }
};

TEST(Report, RefersToNothingOutside) {
    RunSoFar run;
    run.climb("UCT 1000", -1, 0);
    run.climb("step 100", 60, -300);
    const auto page = report_html(run.told());
    for (const char* reference : {"http:", "https:", "src=", "href=", "@import", "url("})
        EXPECT_EQ(page.find(reference), std::string::npos) << reference;
    EXPECT_NE(page.find("step 100"), std::string::npos);
    EXPECT_NE(page.find("<svg"), std::string::npos);
}

TEST(Report, TheCurveIsAFileOfItsOwn) {
    RunSoFar run;
    EXPECT_EQ(ladder_svg(run.told()), "");
    run.climb("UCT <1000>", -1, 0);
    EXPECT_EQ(ladder_svg(run.told()), "");
    run.climb("step 100", 60, -300);
    run.climb("step 200", 120, 50);
    const auto curve = ladder_svg(run.told());
    EXPECT_EQ(curve.find("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox"), 0u);
    EXPECT_NE(curve.find("UCT &lt;1000&gt;"), std::string::npos);
    EXPECT_TRUE(curve.ends_with("</svg>\n"));
    std::size_t dots = 0;
    for (auto at = curve.find("<circle"); at != std::string::npos;
         at = curve.find("<circle", at + 1))
        ++dots;
    EXPECT_EQ(dots, 2u);
}

}  // namespace
}  // namespace selfplay::training
