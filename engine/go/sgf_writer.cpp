#include <algorithm>
#include <cassert>

#include "engine/go/sgf.h"
#include "engine/go/sgf_values.h"

namespace go::sgf {

namespace {

void append_node(std::string& text, const Node& node) {
    text += ';';
    for (const auto& property : node.properties) {
        text += property.id;
        if (property.values.empty()) text += "[]";
        for (const auto& value : property.values) append_value(text, property.id, value);
    }
}

// What is left to write, the last first: a node that goes on, one that begins a variation, or
// the bracket that ends one.
struct Pending {
    enum { node, variation, end } kind;
    std::uint32_t index = 0;
};

void push_children(std::vector<Pending>& pending, const Node& node) {
    const bool divides = node.children.size() > 1;
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        pending.push_back({divides ? Pending::variation : Pending::node, *child});
}

}  // namespace

std::string to_text(const Tree& tree) {
    if (tree.nodes.empty()) return {};
    std::string text;
    std::vector<Pending> pending{{Pending::variation, 0}};
    while (!pending.empty()) {
        const auto next = pending.back();
        pending.pop_back();
        if (next.kind == Pending::end) {
            text += ')';
            continue;
        }
        if (next.kind == Pending::variation) {
            text += '(';
            pending.push_back({Pending::end});
        }
        assert(next.index < tree.nodes.size());
        append_node(text, tree.nodes[next.index]);
        push_children(pending, tree.nodes[next.index]);
    }
    return text + '\n';
}

}  // namespace go::sgf
