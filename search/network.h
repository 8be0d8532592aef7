// A network in memory, ready to be run on any board it serves: the graph, and the programs that
// were made of it. Shared by all evaluators, from any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "nn/eigen/executor.h"
#include "nn/executor.h"
#include "nn/graph.h"

namespace search {

class Network {
   public:
    // `graph` must be valid.
    Network(nn::Graph graph, nn::Precision precision);

    const nn::Graph& graph() const { return graph_; }
    nn::Precision precision() const { return precision_; }
    std::size_t input_count() const { return inputs_; }

    // For boards of that side. Takes the time of packing the weights where it is the first.
    std::unique_ptr<nn::Executor> make_executor(int board) const;
    // Numbers that each output has for a position.
    std::vector<std::size_t> output_sizes(int board) const;
    // Fails when inputs and policy are not of these sizes.
    void check(int planes, int globals, int policy, int board) const;

   private:
    nn::Graph graph_;
    nn::Precision precision_;
    std::size_t inputs_ = 0;
    mutable std::mutex mutex_;
    mutable std::unique_ptr<nn::eigen::Program> program_;
};

// The file that `name` means: a path, or a bare name beside the executable, in the working folder
// or in the user's data folder. Fails, naming every path tried.
std::filesystem::path find_weights(const std::string& name);

// Fails with engine::Error, one line.
std::shared_ptr<const Network> load_network(const std::string& name, nn::Precision precision);

}  // namespace search
