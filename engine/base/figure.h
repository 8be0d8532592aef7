// One measured figure, as every `bench` prints it: "go9_rollouts 145000 rollouts/s".
#pragma once

#include <string>

namespace engine {

struct Figure {
    std::string name;  // stable from one version to the next
    double value = 0;
    std::string unit;
};

}  // namespace engine
