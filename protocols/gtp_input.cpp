#include "protocols/gtp_input.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace protocols {

namespace {

// Lines read ahead and not yet answered; more wait in the pipe.
constexpr std::size_t most_ahead = 4096;

}  // namespace

InputAhead::InputAhead(std::istream& in, std::function<void(const Line&)> arrived)
    : thread_(
          [&in, shared = shared_, arrived = std::move(arrived)] { read(in, shared, arrived); }) {}

InputAhead::~InputAhead() {
    bool ended = false;
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->abandoned = true;
        ended = shared_->ended;
        shared_->changed.notify_all();
    }
    if (ended)
        thread_.join();
    else
        thread_.detach();
}

void InputAhead::read(std::istream& in, const std::shared_ptr<Shared>& shared,
                      const std::function<void(const Line&)>& arrived) {
    for (Line line; read_line(in, line);) {
        std::unique_lock lock(shared->mutex);
        shared->changed.wait(
            lock, [&] { return shared->abandoned || shared->lines.size() < most_ahead; });
        if (shared->abandoned) break;
        arrived(line);
        shared->lines.push_back(line);
        shared->changed.notify_all();
    }
    const std::lock_guard lock(shared->mutex);
    shared->ended = true;
    shared->changed.notify_all();
}

bool InputAhead::pop(Line& line) {
    std::unique_lock lock(shared_->mutex);
    shared_->changed.wait(lock, [&] { return shared_->ended || !shared_->lines.empty(); });
    if (shared_->lines.empty()) return false;
    line = std::move(shared_->lines.front());
    shared_->lines.pop_front();
    shared_->changed.notify_all();
    return true;
}

bool InputAhead::waiting(const std::function<bool(std::string_view)>& wanted) const {
    const std::lock_guard lock(shared_->mutex);
    return std::any_of(shared_->lines.begin(), shared_->lines.end(),
                       [&](const Line& line) { return wanted(line.text); });
}

}  // namespace protocols
