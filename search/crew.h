// Threads that are kept alive between thinks and wait, without spinning, for the next.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace search {

class Crew {
   public:
    explicit Crew(int threads);
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;
    // Waits for the work under way.
    ~Crew();

    // Runs work(0) … work(threads - 1), each on its own thread, and returns at once. `work` throws
    // nothing. Waits first for what was started before.
    void start(std::function<void(int)> work);
    bool idle() const;
    // Blocks until idle.
    void wait() const;

   private:
    void serve(int index);

    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    std::function<void(int)> work_;
    std::uint64_t round_ = 0;
    std::size_t busy_ = 0;
    bool closing_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace search
