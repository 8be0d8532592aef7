#include "search/crew.h"

#include <utility>

namespace search {

Crew::Crew(int threads) {
    threads_.reserve(static_cast<std::size_t>(threads));
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this, i] { serve(i); });
}

Crew::~Crew() {
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return busy_ == 0; });
        closing_ = true;
    }
    changed_.notify_all();
    for (auto& thread : threads_) thread.join();
}

void Crew::start(std::function<void(int)> work) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return busy_ == 0; });
    work_ = std::move(work);
    busy_ = threads_.size();
    ++round_;
    changed_.notify_all();
}

bool Crew::idle() const {
    const std::lock_guard lock(mutex_);
    return busy_ == 0;
}

void Crew::wait() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return busy_ == 0; });
}

void Crew::serve(int index) {
    std::uint64_t served = 0;
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return closing_ || round_ != served; });
        if (closing_) return;
        served = round_;
        lock.unlock();
        work_(index);
        lock.lock();
        if (--busy_ == 0) changed_.notify_all();
    }
}

}  // namespace search
