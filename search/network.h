// A network in memory, ready to be run on any board it serves: the graph, and the programs that
// were made of it. Shared by all evaluators, from any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nn/calibration.h"
#include "nn/executor.h"
#include "nn/graph.h"
#include "nn/program.h"

namespace search {

// What a network is to be run in; none: the fastest precision that loses nothing play would notice.
using PrecisionChoice = std::optional<nn::Precision>;
// "auto", or a precision's name; fails where there is none of that name.
PrecisionChoice precision_choice(std::string_view name);
std::string_view name_of(PrecisionChoice choice);
// "auto" and the precisions.
std::span<const std::string_view> precision_choices();

class Network {
   public:
    // `graph` must be valid. A precision that is lacking here gives way as nn::compile says; int8
    // and int16 need a calibration of the graph.
    Network(nn::Graph graph, nn::Precision precision, nn::Calibration calibration = {});
    // The same network in another precision.
    std::shared_ptr<const Network> in(nn::Precision precision,
                                      const nn::Calibration& calibration = {}) const;

    const nn::Graph& graph() const { return *graph_; }
    nn::Precision precision() const { return precision_; }
    const nn::Calibration& calibration() const { return calibration_; }
    std::size_t input_count() const { return inputs_; }

    // For boards of that side. Takes the time of packing the weights where it is the first.
    std::unique_ptr<nn::Executor> make_executor(int board) const;
    // Numbers that each output has for a position.
    std::vector<std::size_t> output_sizes(int board) const;
    // Fails when inputs and policy are not of these sizes.
    void check(int planes, int globals, int policy, int board) const;

   private:
    Network(std::shared_ptr<const nn::Graph> graph, nn::Precision precision,
            nn::Calibration calibration);

    std::shared_ptr<const nn::Graph> graph_;
    nn::Precision precision_;
    nn::Calibration calibration_;
    std::size_t inputs_ = 0;
    mutable std::mutex mutex_;
    mutable std::map<int, std::unique_ptr<nn::Program>> programs_;  // by the board's side
};

// The file that `name` means: a path, or a bare name beside the executable, in the working folder
// or in the user's data folder. Fails, naming every path tried.
std::filesystem::path find_weights(const std::string& name);

}  // namespace search
