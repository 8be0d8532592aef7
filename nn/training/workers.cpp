#include "nn/training/workers.h"

#include <utility>

namespace nn::training {

Workers::Workers(int count) {
    for (int i = 0; i < count; ++i) threads_.emplace_back([this, i] { serve(i); });
}

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    changed_.notify_all();
    for (auto& thread : threads_) thread.join();
}

void Workers::run(const std::function<void(int)>& work) {
    std::unique_lock lock(mutex_);
    work_ = &work;
    busy_ = count();
    ++round_;
    changed_.notify_all();
    changed_.wait(lock, [&] { return busy_ == 0; });
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void Workers::serve(int index) {
    std::unique_lock lock(mutex_);
    for (long done = 0;;) {
        changed_.wait(lock, [&] { return over_ || round_ != done; });
        if (over_) return;
        done = round_;
        const auto& work = *work_;
        lock.unlock();
        std::exception_ptr error;
        try {
            work(index);
        } catch (...) {
            error = std::current_exception();
        }
        lock.lock();
        if (error) error_ = error;
        if (--busy_ == 0) changed_.notify_all();
    }
}

}  // namespace nn::training
