// A network made ready for one way of computing: its weights rewritten and packed once, shared by
// all executors made from it, on any threads. A Program is immutable as seen from outside.
#pragma once

#include <memory>

#include "nn/executor.h"

namespace nn {

class Program {
   public:
    virtual ~Program() = default;
    // The executor may outlive the Program. May be called from any thread.
    virtual std::unique_ptr<Executor> make_executor() const = 0;
};

}  // namespace nn
