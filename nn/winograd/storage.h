// Which buffer holds every result of a graph, in the order of the steps: buffers of one size are
// used again as soon as their result is dead.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "nn/winograd/roles.h"
#include "nn/winograd/workspace.h"

namespace nn::winograd {

class Storage {
   public:
    Storage(const Graph& graph, const std::vector<Shape>& shapes, const std::vector<Role>& roles,
            Layout& layout);

    // -1: not kept in this form.
    int buffer(int node, Form form) const {
        return buffers_[static_cast<std::size_t>(node)][static_cast<std::size_t>(form)];
    }

   private:
    struct Reading {
        int node;
        Form form;
    };
    std::vector<Reading> reads(int node) const;
    void read_operation(int node, std::vector<Reading>& found) const;
    void find_last_reads();
    void place(int node);
    void store(int node, Form form, int step, const std::vector<Reading>& reads);
    int take(Form form, std::size_t size);
    std::size_t size_of(int node, Form form) const;
    int& slot(int node, Form form) {
        return buffers_[static_cast<std::size_t>(node)][static_cast<std::size_t>(form)];
    }
    int& last(int node, Form form) {
        return last_[static_cast<std::size_t>(node)][static_cast<std::size_t>(form)];
    }

    const Graph& graph_;
    const std::vector<Shape>& shapes_;
    const std::vector<Role>& roles_;
    Layout& layout_;
    std::vector<std::array<int, 3>> buffers_, last_;
    std::map<std::pair<Form, std::size_t>, std::vector<int>> free_;
};

}  // namespace nn::winograd
