#include "nn/onednn/executor.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <mutex>
#include <thread>

#include "nn/onednn/stage.h"
#include "nn/passes.h"

namespace nn::onednn {

// The layouts and packed weights of every board that was asked for so far.
class Boards {
   public:
    struct Entry {
        std::shared_ptr<const Layout> layout;
        PackedWeights packed;
    };

    Boards(Graph graph, Precision precision, Calibration calibration)
        : graph_(std::move(graph)), precision_(precision), calibration_(std::move(calibration)) {}

    Entry& entry(int board) {
        const std::lock_guard lock(mutex_);
        auto& entry = entries_[board];
        if (!entry) {
            auto made = std::make_unique<Entry>();
            made->layout =
                std::make_shared<const Layout>(lay_out(graph_, precision_, calibration_, board));
            entry = std::move(made);
        }
        return *entry;
    }

   private:
    const Graph graph_;
    const Precision precision_;
    const Calibration calibration_;
    std::mutex mutex_;
    std::map<int, std::unique_ptr<Entry>> entries_;
};

namespace {

// Larger batches run depth first in parts of this many positions, which fit into the cache.
int part_size(int points) { return points > 200 ? 8 : 16; }

class OnednnExecutor : public Executor {
   public:
    explicit OnednnExecutor(std::shared_ptr<Boards> boards) : boards_(std::move(boards)) {}

    void run(const Batch& batch) override {
        use_callers_thread();
        if (const auto thread = std::this_thread::get_id(); thread != thread_) {
            // The library wants a layer to run on the thread that made it.
            stages_.clear();
            thread_ = thread;
        }
        const int part = part_size(batch.board * batch.board);
        for (int first = 0; first < batch.size; first += part)
            run_part(batch, first, std::min(part, batch.size - first));
    }

   private:
    void run_part(const Batch& batch, int first, int count) {
        auto& [layout, stage] = stage_of(batch.board, count);
        const auto offset = [&, &layout = layout](int node) {
            return layout->size(node) * static_cast<std::size_t>(first);
        };
        ends_.inputs.clear();
        ends_.outputs.clear();
        std::size_t next = 0;
        for (std::size_t n = 0; n < layout->graph.nodes.size(); ++n)
            if (layout->graph.nodes[n].operation == Operation::input)
                ends_.inputs.push_back(batch.inputs[next++].data() + offset(static_cast<int>(n)));
        for (std::size_t o = 0; o < layout->graph.outputs.size(); ++o) {
            const bool wanted = o < batch.outputs.size() && !batch.outputs[o].empty();
            ends_.outputs.push_back(
                wanted ? batch.outputs[o].data() + offset(layout->graph.outputs[o].node) : nullptr);
        }
        stage->run(ends_);
    }

    struct Ready {
        std::shared_ptr<const Layout> layout;
        std::unique_ptr<Stage> stage;
    };

    Ready& stage_of(int board, int count) {
        auto& ready = stages_[{board, count}];
        if (!ready.stage) {
            auto& entry = boards_->entry(board);
            ready = {entry.layout, std::make_unique<Stage>(entry.layout, entry.packed, count)};
        }
        return ready;
    }

    std::shared_ptr<Boards> boards_;
    std::thread::id thread_;
    std::map<std::pair<int, int>, Ready> stages_;
    Ends ends_;
};

}  // namespace

bool serves(Precision precision) {
    switch (precision) {
        case Precision::fp32:
            return true;
        case Precision::bf16:
            return has_bf16();
        case Precision::int8:
            return has_int8() && has_bf16();
        case Precision::int16:
            return false;
    }
    return false;
}

Program::Program(const Graph& graph, Precision precision, Calibration calibration)
    : boards_(std::make_shared<Boards>(optimise(graph), precision, std::move(calibration))) {
    assert(serves(precision));
}

std::unique_ptr<Executor> Program::make_executor() const {
    return std::make_unique<OnednnExecutor>(boards_);
}

std::vector<std::string> Program::implementations(int board, int positions) const {
    use_callers_thread();
    auto& entry = boards_->entry(board);
    return Stage(entry.layout, entry.packed, positions).implementations();
}

}  // namespace nn::onednn
