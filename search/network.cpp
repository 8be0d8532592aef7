#include "search/network.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "nn/backend.h"

namespace search {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> places(const fs::path& name) {
    if (name.has_parent_path()) return {name};
    std::vector<fs::path> paths;
    std::error_code ignored;
    const auto executable = fs::read_symlink("/proc/self/exe", ignored);
    if (!executable.empty()) paths.push_back(executable.parent_path() / name);
    paths.push_back(fs::current_path(ignored) / name);
    if (const auto folder = engine::user_folder("XDG_DATA_HOME", ".local/share"))
        paths.push_back(*folder / name);
    return paths;
}

constexpr std::array<std::string_view, 5> choices = {"auto", "fp32", "bf16", "int8", "int16"};

}  // namespace

PrecisionChoice precision_choice(std::string_view name) {
    if (name == choices[0]) return std::nullopt;
    if (const auto precision = nn::precision_from(name)) return precision;
    engine::fail("Precision must be one of {}, not {}", fmt::join(choices, ", "), name);
}

std::string_view name_of(PrecisionChoice choice) {
    return choice ? nn::name_of(*choice) : choices[0];
}

std::span<const std::string_view> precision_choices() { return choices; }

Network::Network(nn::Graph graph, nn::Precision precision, nn::Calibration calibration)
    : Network(std::make_shared<const nn::Graph>(std::move(graph)), precision,
              std::move(calibration)) {}

Network::Network(std::shared_ptr<const nn::Graph> graph, nn::Precision precision,
                 nn::Calibration calibration)
    : graph_(std::move(graph)),
      precision_(precision),
      calibration_(std::move(calibration)),
      inputs_(graph_->input_nodes().size()) {}

std::shared_ptr<const Network> Network::in(nn::Precision precision,
                                           const nn::Calibration& calibration) const {
    return std::shared_ptr<const Network>(new Network(graph_, precision, calibration));
}

std::unique_ptr<nn::Executor> Network::make_executor(int board) const {
    const std::lock_guard lock(mutex_);
    auto& program = programs_[board];
    if (!program) program = nn::compile(*graph_, precision_, calibration_, board);
    return program->make_executor();
}

std::vector<std::size_t> Network::output_sizes(int board) const {
    const auto shapes = nn::infer_shapes(*graph_, board);
    std::vector<std::size_t> sizes;
    sizes.reserve(graph_->outputs.size());
    for (const auto& output : graph_->outputs)
        sizes.push_back(shapes[static_cast<std::size_t>(output.node)].size(board * board));
    return sizes;
}

void Network::check(int planes, int globals, int policy, int board) const {
    const auto shapes = nn::infer_shapes(*graph_, board);
    const auto wrong = [&](std::string_view what, std::size_t found, int wanted) {
        if (found != static_cast<std::size_t>(wanted))
            engine::fail("the network {} has {} {}, but {} on a board of {}x{} has {}",
                         graph_->facts.name, found, what, graph_->facts.encoding, board, board,
                         wanted);
    };
    const auto inputs = graph_->input_nodes();
    const auto channels = [&](std::size_t i) {
        return i < inputs.size()
                   ? static_cast<std::size_t>(
                         graph_->nodes[static_cast<std::size_t>(inputs[i])].shape.channels)
                   : 0;
    };
    wrong("planes", channels(0), planes);
    wrong("other inputs", channels(1), globals);
    const auto node = static_cast<std::size_t>(*graph_->output("policy"));
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

}  // namespace search
