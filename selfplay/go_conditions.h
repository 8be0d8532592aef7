// The conditions under which the games of a Go match are played.
#pragma once

#include <string>
#include <vector>

#include "engine/go/go.h"

namespace selfplay {

struct GoConditions {
    int size = 19;
    double komi = 7.5;
    std::string rules = "chinese";      // as go::rules_from_text takes it
    std::vector<std::string> handicap;  // vertices
    bool operator==(const GoConditions&) const = default;
};

// The position before the first move. Fails with engine::Error on bad conditions.
go::Go start_of(const GoConditions& conditions);

}  // namespace selfplay
