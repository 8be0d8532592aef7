#include "protocols/mate_think.h"

#include <utility>

namespace protocols {

void MateThink::start(const Session& session, search::MateLimits limits, Done done) {
    stop();
    stop_ = false;
    running_ = true;
    limits.stop = &stop_;
    thread_ = std::thread([this, &session, limits, done = std::move(done)] {
        done(session.find_mate(limits));
        running_ = false;
    });
}

void MateThink::stop() {
    stop_ = true;
    wait();
}

void MateThink::wait() {
    const std::lock_guard lock(joining_);
    if (thread_.joinable()) thread_.join();
}

}  // namespace protocols
