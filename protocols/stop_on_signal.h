// A stop that SIGINT and SIGTERM request, for work that ends cleanly between two of its steps.
#pragma once

#include <csignal>
#include <ctime>
#include <stop_token>
#include <thread>

namespace protocols {

// Listens from construction to destruction, on a thread of its own. Threads started meanwhile
// inherit the blocked signals.
class StopOnSignal {
   public:
    StopOnSignal() {
        ::sigemptyset(&signals_);
        ::sigaddset(&signals_, SIGINT);
        ::sigaddset(&signals_, SIGTERM);
        ::pthread_sigmask(SIG_BLOCK, &signals_, &before_);
        thread_ = std::jthread([this](const std::stop_token& over) { watch(over); });
    }
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;
    ~StopOnSignal() {
        thread_ = {};
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    std::stop_token token() const { return stop_.get_token(); }

   private:
    void watch(const std::stop_token& over) {
        constexpr timespec step{0, 50'000'000};
        while (!over.stop_requested())
            if (::sigtimedwait(&signals_, nullptr, &step) > 0) stop_.request_stop();
    }

    sigset_t signals_{}, before_{};
    std::stop_source stop_;
    std::jthread thread_;
};

}  // namespace protocols
