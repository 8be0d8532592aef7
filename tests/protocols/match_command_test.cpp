#include "protocols/match_command.h"

#include <gtest/gtest.h>

namespace protocols {

TEST(MatchCommand, ALineSaysWhoseFaultItWas) {
    selfplay::GameRecord record;
    record.names = {"ours", "theirs"};
    record.outcome = engine::Outcome::first_wins;
    record.reason = "crash";
    record.detail = "theirs: killed by signal 11 (Segmentation fault)";
    selfplay::Standing standing;
    standing.tally.wins = 1;
    standing.games_wanted = 2;
    EXPECT_TRUE(progress_line(record, standing)
                    .starts_with("game 1/2 ours crash (theirs: killed by signal 11 (Segmentation "
                                 "fault)) | 1 0 0 | 100.0 % |"))
        << progress_line(record, standing);
    record.reason = "score";
    record.score = "B+3.5";
    EXPECT_TRUE(
        progress_line(record, standing).starts_with("game 1/2 ours score B+3.5 | 1 0 0 | "));
}

}  // namespace protocols
