#include "nn/describe.h"

#include <fmt/format.h>

namespace nn {

namespace {

std::string shape_text(Shape shape) {
    return fmt::format("{} {}", shape.channels, shape.over_board ? "per point" : "numbers");
}

std::string or_unknown(const std::string& text) { return text.empty() ? "unknown" : text; }

// One line whatever the file says.
std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
    return text.size() <= 200 ? text : text.substr(0, 200) + "…";
}

}  // namespace

std::string describe(const Graph& graph) {
    const auto& facts = graph.facts;
    const int board = facts.board == 0 ? 19 : facts.board;
    const auto shapes = infer_shapes(graph, board);
    std::string text;
    const auto line = [&](std::string_view name, const std::string& value) {
        text += fmt::format("{:<12} {}\n", name, one_line(value));
    };
    const auto shape_of = [&](int node) {
        return shape_text(shapes[static_cast<std::size_t>(node)]);
    };
    line("game", or_unknown(facts.game));
    line("encoding", or_unknown(facts.encoding));
    line("board", facts.board == 0 ? "any" : fmt::format("{0}x{0}", facts.board));
    line("name", or_unknown(facts.name));
    line("source", or_unknown(facts.source));
    line("licence", or_unknown(facts.licence));
    line("blocks", fmt::format("{}", facts.blocks));
    line("channels", fmt::format("{}", facts.channels));
    line("steps", fmt::format("{}", facts.steps));
    for (const int node : graph.input_nodes())
        line("input", fmt::format("{}: {}", graph.nodes[static_cast<std::size_t>(node)].name,
                                  shape_of(node)));
    for (const auto& output : graph.outputs)
        line("output", fmt::format("{}: {}", output.name, shape_of(output.node)));
    line("parameters", fmt::format("{}", parameter_count(graph)));
    if (facts.board == 0) line("flop", fmt::format("{} a position on 9x9", flop_count(graph, 9)));
    line("flop", fmt::format("{0} a position on {1}x{1}", flop_count(graph, board), board));
    return text;
}

}  // namespace nn
