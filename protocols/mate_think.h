// A mate search beside a session's other search, on a thread of its own. One thread owns it;
// stop() may come from any other, but not from `done`.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

#include "protocols/session.h"

namespace protocols {

class MateThink {
   public:
    using Done = std::function<void(const search::MateResult&)>;

    MateThink() = default;
    MateThink(const MateThink&) = delete;
    MateThink& operator=(const MateThink&) = delete;
    ~MateThink() { stop(); }

    // Ends the one before; then returns at once. `session` must stay as it is until `done`, which
    // is called exactly once, from the thread of the search. The limits' stop is this object's.
    void start(const Session& session, search::MateLimits limits, Done done);
    // Ends the search within milliseconds and returns when `done` has.
    void stop();
    // Returns when the search is over by itself and `done` has returned.
    void wait();
    bool running() const { return running_; }

   private:
    std::atomic<bool> stop_ = false, running_ = false;
    std::mutex joining_;
    std::thread thread_;
};

}  // namespace protocols
