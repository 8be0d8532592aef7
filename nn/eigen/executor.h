// The reference executor: fp32, every operation, any processor. Other executors are tested against
// it, and it runs where no faster one does. See nn/executor.h for what it promises.
#pragma once

#include "nn/program.h"

namespace nn::eigen {

// `graph` must be valid; it is optimised here. The weights are shared by all executors made by one
// Program.
class Program : public nn::Program {
   public:
    explicit Program(Graph graph);
    std::unique_ptr<Executor> make_executor() const override;

   private:
    std::shared_ptr<const Graph> graph_;
};

}  // namespace nn::eigen
