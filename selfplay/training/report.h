// A run as one page of HTML that refers to nothing outside itself: curves, the ladder, and a game
// to step through. Pure functions from what is known to text.
#pragma once

#include <span>
#include <string>

#include "selfplay/training/journal.h"
#include "selfplay/training/ladder.h"
#include "selfplay/training/sample_game.h"
#include "selfplay/training/settings.h"

namespace selfplay::training {

struct ReportInput {
    const Settings& settings;
    std::span<const Entry> entries;
    std::span<const Rung> rungs;
    SampleGame sample;  // may be empty
};

std::string report_html(const ReportInput& input);
// The ladder's curve alone, as a file; empty before anything is on it.
std::string ladder_svg(const ReportInput& input);

}  // namespace selfplay::training
