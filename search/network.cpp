#include "search/network.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "engine/base/error.h"
#include "nn/load.h"

namespace search {

namespace {

namespace fs = std::filesystem;

// $XDG_DATA_HOME/sanban, or its place by default.
std::optional<fs::path> data_folder() {
    if (const char* folder = std::getenv("XDG_DATA_HOME"); folder && *folder)
        return fs::path(folder) / "sanban";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".local/share/sanban";
    return std::nullopt;
}

std::vector<fs::path> places(const fs::path& name) {
    if (name.has_parent_path()) return {name};
    std::vector<fs::path> paths;
    std::error_code ignored;
    const auto executable = fs::read_symlink("/proc/self/exe", ignored);
    if (!executable.empty()) paths.push_back(executable.parent_path() / name);
    paths.push_back(fs::current_path(ignored) / name);
    if (const auto folder = data_folder()) paths.push_back(*folder / name);
    return paths;
}

}  // namespace

Network::Network(nn::Graph graph, nn::Precision precision)
    : graph_(std::move(graph)), precision_(precision), inputs_(graph_.input_nodes().size()) {
    if (precision != nn::Precision::fp32)
        engine::fail("networks are run in fp32 only, not in {}", nn::name_of(precision));
}

std::unique_ptr<nn::Executor> Network::make_executor(int) const {
    const std::lock_guard lock(mutex_);
    if (!program_) program_ = std::make_unique<nn::eigen::Program>(graph_);
    return program_->make_executor();
}

std::vector<std::size_t> Network::output_sizes(int board) const {
    const auto shapes = nn::infer_shapes(graph_, board);
    std::vector<std::size_t> sizes;
    sizes.reserve(graph_.outputs.size());
    for (const auto& output : graph_.outputs)
        sizes.push_back(shapes[static_cast<std::size_t>(output.node)].size(board * board));
    return sizes;
}

void Network::check(int planes, int globals, int policy, int board) const {
    const auto shapes = nn::infer_shapes(graph_, board);
    const auto wrong = [&](std::string_view what, std::size_t found, int wanted) {
        if (found != static_cast<std::size_t>(wanted))
            engine::fail("the network {} has {} {}, but {} on a board of {}x{} has {}",
                         graph_.facts.name, found, what, graph_.facts.encoding, board, board,
                         wanted);
    };
    const auto inputs = graph_.input_nodes();
    const auto channels = [&](std::size_t i) {
        return i < inputs.size()
                   ? static_cast<std::size_t>(
                         graph_.nodes[static_cast<std::size_t>(inputs[i])].shape.channels)
                   : 0;
    };
    wrong("planes", channels(0), planes);
    wrong("other inputs", channels(1), globals);
    const auto node = static_cast<std::size_t>(*graph_.output("policy"));
    wrong("moves", shapes[node].size(board * board), policy);
}

fs::path find_weights(const std::string& name) {
    const auto tried = places(name);
    std::error_code ignored;
    const auto found = std::find_if(tried.begin(), tried.end(), [&](const fs::path& path) {
        return fs::is_regular_file(path, ignored);
    });
    if (found != tried.end()) return *found;
    std::vector<std::string> texts;
    texts.reserve(tried.size());
    for (const auto& path : tried) texts.push_back(path.string());
    engine::fail("there is no weight file {}; tried {}", name, fmt::join(texts, ", "));
}

std::shared_ptr<const Network> load_network(const std::string& name, nn::Precision precision) {
    const auto path = find_weights(name);
    auto graph = nn::load(path);
    if (graph.facts.name.empty()) graph.facts.name = path.filename().string();
    return std::make_shared<Network>(std::move(graph), precision);
}

}  // namespace search
