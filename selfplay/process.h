// A child process that is talked to in lines: how a match reaches an external engine. The child
// leads a process group of its own, and all of that group is gone when the object is. One owner,
// one thread. Whatever goes wrong with the child is a Fault.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "selfplay/fault.h"

namespace selfplay {

// Splits as a shell does, quotes and backslashes understood, nothing expanded. Fails with
// engine::Error on an open quote or an empty command.
std::vector<std::string> split_command(std::string_view command);

struct ProcessOptions {
    std::filesystem::path log;  // the child's stderr is appended here; empty: dropped
    std::stop_token stop;       // ends every wait with Fault::Kind::stopped
};

class Process {
   public:
    // Looks for the program in PATH, then where Debian keeps games. Fails with engine::Error when
    // it cannot be started.
    Process(std::string_view command, ProcessOptions options);
    // Closes the child's input, gives it a moment to end, then kills its group.
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    // Both block until `deadline` at most. A line is written with its line end, and read without
    // (nor carriage return).
    void write_line(std::string_view line, Deadline deadline);
    std::string read_line(Deadline deadline);
    // Empty when no line has come by the deadline; that is no fault.
    std::optional<std::string> try_read_line(Deadline deadline);

   private:
    void start(const std::vector<std::string>& arguments);
    void wait_for(int descriptor, short events, Deadline deadline) const;
    void read_some();
    [[noreturn]] void report_end();
    bool ended_before(Deadline deadline);
    void close_pipes();

    ProcessOptions options_;
    pid_t pid_ = -1;
    bool reaped_ = false;
    int status_ = 0;
    int to_child_ = -1, from_child_ = -1;
    std::string buffer_;        // read, not yet handed out
    std::size_t searched_ = 0;  // of the buffer: holds no line end
};

}  // namespace selfplay
