// A place where workers meet: once called, each comes as soon as it has nothing under way, and
// the last to come does what the meeting is for while the others wait.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>

#include "search/relaxed.h"

namespace search {

class Meeting {
   public:
    // Members only may call() and attend(); who leaves is not waited for.
    void join() {
        const std::lock_guard lock(mutex_);
        ++members_;
    }
    void leave() {
        const std::lock_guard lock(mutex_);
        --members_;
        changed_.notify_all();
    }

    void call() { called_.store(true, relaxed); }
    bool called() const { return called_.load(relaxed); }

    // Returns when the purpose has been served, by this thread or another.
    template <class Purpose>
    void attend(Purpose purpose) {
        std::unique_lock lock(mutex_);
        if (!called()) return;
        const auto round = round_;
        ++present_;
        changed_.notify_all();
        changed_.wait(lock, [&] { return round_ != round || present_ == members_; });
        if (round_ != round) return;
        purpose();
        called_ = false;
        present_ = 0;
        ++round_;
        changed_.notify_all();
    }

   private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::atomic<bool> called_ = false;
    int members_ = 0, present_ = 0;
    unsigned round_ = 0;
};

}  // namespace search
