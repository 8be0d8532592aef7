// What the stages of AlphaGo's training share: where they learn from and write to, how long they
// may take, and the line of JSON that tells how far one has come. Values.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/go/go.h"

namespace selfplay::alphago {

struct StageInput {
    std::vector<std::filesystem::path> records;
    std::filesystem::path folder;
    std::optional<double> minutes;  // of this call
    int threads = 1;
    // Told every line of JSON that is added to the journal.
    std::function<void(const std::string&)> report;
    std::function<void(const std::string&)> say;
};

// Adds the line to the journal of that name in the folder, and tells it.
void tell(const StageInput& input, const std::filesystem::path& journal, const std::string& line);

// The time of one call.
class Watch {
   public:
    Watch(const StageInput& input, const std::stop_token& stop)
        : minutes_(input.minutes), stop_(stop) {}

    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    bool over() const {
        return stop_.stop_requested() || (minutes_ && seconds() >= 60 * *minutes_);
    }

   private:
    std::optional<double> minutes_;
    const std::stop_token& stop_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace selfplay::alphago
