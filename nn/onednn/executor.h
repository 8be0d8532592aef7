// Networks on oneDNN: fp32, bf16 and int8, every operation, any board that the network serves.
// First layers and heads of an int8 network are bf16. Executors make what they need for a board
// and batch size at its first use, and again when they change threads. See nn/executor.h.
#pragma once

#include "nn/calibration.h"
#include "nn/program.h"

namespace nn::onednn {

// Whether the processor has instructions for it (int16: never here).
bool serves(Precision precision);

class Boards;

class Program : public nn::Program {
   public:
    // `graph` must be valid. int8 needs a calibration of it.
    Program(const Graph& graph, Precision precision, Calibration calibration = {});
    std::unique_ptr<Executor> make_executor() const override;
    // What the library chose for each layer.
    std::vector<std::string> implementations(int board, int positions) const;

   private:
    std::shared_ptr<Boards> boards_;
};

}  // namespace nn::onednn
