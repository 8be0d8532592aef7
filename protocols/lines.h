// Lines of a text protocol, in and out. Input may be anything: lines are bounded, and what no
// protocol knows (NUL and other control characters) is dropped. Output is whole lines, flushed,
// from any thread.
#pragma once

#include <istream>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>

namespace protocols {

inline constexpr std::size_t longest_line = std::size_t{1} << 20;

struct Line {
    std::string text;  // tabs are blanks; no control characters
    bool too_long = false;
};

// False at the end of input. Of a line longer than `most` bytes the rest is skipped.
bool read_line(std::istream& in, Line& line, std::size_t most = longest_line);

// From now on SIGTERM and SIGINT end the process at once with status 0. What was answered has been
// written, whole lines at a time; a protocol has nothing else to save.
void end_on_signals();

class Output {
   public:
    explicit Output(std::ostream& out) : out_(out) {}

    // Writes `text` and a newline at once.
    void line(std::string_view text) {
        const std::lock_guard lock(mutex_);
        out_ << text << '\n' << std::flush;
    }

   private:
    std::mutex mutex_;
    std::ostream& out_;
};

}  // namespace protocols
