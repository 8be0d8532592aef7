// Lines of standard input, read ahead on a thread of their own, so that a line that arrives while
// the engine thinks can cut it short.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <istream>
#include <mutex>
#include <thread>

#include "protocols/lines.h"

namespace protocols {

class InputAhead {
   public:
    // `arrived` is called for every line on the reading thread, before pop() returns it.
    InputAhead(std::istream& in, std::function<void(const Line&)> arrived);
    InputAhead(const InputAhead&) = delete;
    InputAhead& operator=(const InputAhead&) = delete;
    // Leaves the thread to the end of the input when that has not come yet.
    ~InputAhead();

    // Waits for the next line; false at the end of input.
    bool pop(Line& line);
    // Whether a line that `wanted` is true of has come and not been popped.
    bool waiting(const std::function<bool(std::string_view)>& wanted) const;

   private:
    // Outlives this object in the reading thread, which may be blocked in a read for ever.
    struct Shared {
        std::mutex mutex;
        std::condition_variable changed;
        std::deque<Line> lines;
        bool ended = false, abandoned = false;
    };
    static void read(std::istream& in, const std::shared_ptr<Shared>& shared,
                     const std::function<void(const Line&)>& arrived);

    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
    std::thread thread_;
};

}  // namespace protocols
