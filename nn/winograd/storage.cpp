#include "nn/winograd/storage.h"

#include "nn/index.h"
#include "nn/winograd/pack.h"

namespace nn::winograd {

Storage::Storage(const Graph& graph, const std::vector<Shape>& shapes,
                 const std::vector<Role>& roles, Layout& layout)
    : graph_(graph),
      shapes_(shapes),
      roles_(roles),
      layout_(layout),
      buffers_(graph.nodes.size(), {-1, -1, -1}),
      last_(graph.nodes.size(), {-1, -1, -1}) {
    find_last_reads();
    for (int n = 0; n < static_cast<int>(graph.nodes.size()); ++n)
        if (!roles_[at(n)].hidden) place(n);
}

void Storage::read_operation(int n, std::vector<Reading>& found) const {
    const auto& node = graph_.nodes[at(n)];
    const auto kind = kind_of(graph_, shapes_, n);
    for (std::size_t i = 0; i < node.inputs.size(); ++i) {
        const int input = node.inputs[i];
        if (roles_[at(n)].carrier >= 0 && i == 0) continue;
        if (i == 0 && kind == Kind::first) continue;
        if (i == 0 && (kind == Kind::tower || kind == Kind::points))
            found.push_back({input, Form::words});
        else if (shapes_[at(input)].over_board)
            found.push_back({input, Form::floats});
        else if (roles_[at(input)].hidden)
            found.push_back({graph_.nodes[at(input)].inputs[0], Form::floats});
        else
            found.push_back({input, Form::vector});
    }
}

// What the step that yields node n reads. The words of a fused affine are stored under its number.
std::vector<Storage::Reading> Storage::reads(int n) const {
    std::vector<Reading> found;
    read_operation(n, found);
    if (roles_[at(n)].carrier >= 0) read_operation(roles_[at(n)].carrier, found);
    return found;
}

void Storage::find_last_reads() {
    const int count = static_cast<int>(graph_.nodes.size());
    for (int n = 0; n < count; ++n)
        if (!roles_[at(n)].hidden)
            for (const auto& reading : reads(n)) last(reading.node, reading.form) = n;
    for (const auto& output : graph_.outputs)
        last(output.node, shapes_[at(output.node)].over_board ? Form::floats : Form::vector) =
            count;
}

std::size_t Storage::size_of(int n, Form form) const {
    const int channels = shapes_[at(n)].channels;
    const auto& board = layout_.board;
    // A vector may be read from its middle to a whole number of vectors.
    if (form == Form::vector) return at(padded(channels) + lanes);
    if (form == Form::floats) return at(board.side * board.side) * at(padded(channels));
    return at(board.padded * board.padded) * at(padded(channels, 2 * lanes));
}

int Storage::take(Form form, std::size_t size) {
    auto& sizes = form == Form::floats  ? layout_.floats
                  : form == Form::words ? layout_.words
                                        : layout_.vectors;
    auto& free = free_[{form, size}];
    if (free.empty()) {
        sizes.push_back(size);
        return static_cast<int>(sizes.size()) - 1;
    }
    const int buffer = free.back();
    free.pop_back();
    return buffer;
}

// A board of floats takes the place of a residual or source that dies: steps read a point before
// they write it.
void Storage::store(int n, Form form, int step, const std::vector<Reading>& reads) {
    if (form == Form::floats)
        for (const auto& reading : reads)
            if (reading.form == form && last(reading.node, form) == step &&
                size_of(reading.node, form) == size_of(n, form)) {
                slot(n, form) = buffer(reading.node, form);
                last(reading.node, form) = -1;  // not freed
                return;
            }
    slot(n, form) = take(form, size_of(n, form));
}

void Storage::place(int n) {
    const auto inputs = reads(n);
    const auto& role = roles_[at(n)];
    if (!shapes_[at(n)].over_board) store(n, Form::vector, n, {});
    if (role.floats) store(n, Form::floats, n, inputs);
    if (role.words) store(n, Form::words, n, {});
    if (role.affine >= 0) store(role.affine, Form::words, n, {});
    for (const auto& [node, form] : inputs)
        if (last(node, form) == n) {
            free_[{form, size_of(node, form)}].push_back(buffer(node, form));
            last(node, form) = -1;
        }
}

}  // namespace nn::winograd
