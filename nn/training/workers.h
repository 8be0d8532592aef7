// A fixed crew of threads for work that comes in rounds. Each worker is the same thread all its
// life, as some libraries want of whoever runs what it made.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace nn::training {

class Workers {
   public:
    explicit Workers(int count);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    int count() const { return static_cast<int>(threads_.size()); }

    // Calls work(0) … work(count - 1), each on its own thread, and blocks until all are done. What
    // one throws comes out here.
    void run(const std::function<void(int)>& work);

   private:
    void serve(int index);

    std::mutex mutex_;
    std::condition_variable changed_;
    const std::function<void(int)>* work_ = nullptr;
    long round_ = 0;
    int busy_ = 0;
    bool over_ = false;
    std::exception_ptr error_;
    std::vector<std::thread> threads_;
};

}  // namespace nn::training
