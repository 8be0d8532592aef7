#include "selfplay/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "engine/base/error.h"

namespace selfplay {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t longest_line = std::size_t{1} << 20;

std::string reason(int error) { return std::generic_category().message(error); }

// A word of a command line, being read.
class Splitter {
   public:
    std::vector<std::string> split(std::string_view command) {
        for (const char c : command) take(c);
        if (quote_ != 0 || escaped_) engine::fail("command with an open quote: {}", command);
        end_word();
        if (words_.empty()) engine::fail("empty command");
        return std::move(words_);
    }

   private:
    void take(char c) {
        const bool plain = std::exchange(escaped_, false);
        const bool quotes = c == '\'' || c == '"';
        const bool blank = c == ' ' || c == '\t' || c == '\n';
        if (!plain && c == '\\' && quote_ != '\'')
            escaped_ = true;
        else if (!plain && quote_ != 0 && c == quote_)
            quote_ = 0;
        else if (!plain && quote_ == 0 && quotes)
            quote_ = c, in_word_ = true;
        else if (!plain && quote_ == 0 && blank)
            end_word();
        else
            add(c);
    }
    void add(char c) {
        word_ += c;
        in_word_ = true;
    }
    void end_word() {
        if (std::exchange(in_word_, false)) words_.push_back(std::exchange(word_, {}));
    }

    std::vector<std::string> words_;
    std::string word_;
    bool in_word_ = false, escaped_ = false;
    char quote_ = 0;
};

std::string locate(const std::string& program) {
    if (program.find('/') != std::string::npos) return program;
    const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): never set by us
    std::string folders = path == nullptr ? "/usr/bin:/bin" : path;
    folders += ":/usr/games:/usr/local/games";
    for (std::size_t begin = 0; begin <= folders.size();) {
        const auto end = std::min(folders.find(':', begin), folders.size());
        const auto candidate = std::filesystem::path(folders.substr(begin, end - begin)) / program;
        if (::access(candidate.c_str(), X_OK) == 0) return candidate.string();
        begin = end + 1;
    }
    engine::fail("{}: program not found", program);
}

// Both ends of a pipe, closed unless released.
class Pipe {
   public:
    Pipe() {
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0) engine::fail("no pipe: {}", reason(errno));
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        for (const int end : ends_)
            if (end >= 0) ::close(end);
    }
    int reading() const { return ends_[0]; }
    int writing() const { return ends_[1]; }
    int release_reading() { return std::exchange(ends_[0], -1); }
    int release_writing() { return std::exchange(ends_[1], -1); }

   private:
    std::array<int, 2> ends_{-1, -1};
};

// posix_spawn's attributes: a new process group and the signals as a fresh program expects them.
class Attributes {
   public:
    Attributes() {
        ::posix_spawnattr_init(&value_);
        sigset_t none, reset;
        ::sigemptyset(&none);
        ::sigemptyset(&reset);
        for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&reset, signal);
        ::posix_spawnattr_setsigmask(&value_, &none);
        ::posix_spawnattr_setsigdefault(&value_, &reset);
        ::posix_spawnattr_setpgroup(&value_, 0);
        constexpr int flags =
            POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF;
        ::posix_spawnattr_setflags(&value_, static_cast<short>(flags));
    }
    Attributes(const Attributes&) = delete;
    Attributes& operator=(const Attributes&) = delete;
    ~Attributes() { ::posix_spawnattr_destroy(&value_); }
    const posix_spawnattr_t* pointer() const { return &value_; }

   private:
    posix_spawnattr_t value_{};
};

class FileActions {
   public:
    FileActions(int input, int output, const std::filesystem::path& log) {
        ::posix_spawn_file_actions_init(&value_);
        ::posix_spawn_file_actions_adddup2(&value_, input, STDIN_FILENO);
        ::posix_spawn_file_actions_adddup2(&value_, output, STDOUT_FILENO);
        ::posix_spawn_file_actions_addopen(&value_, STDERR_FILENO,
                                           log.empty() ? "/dev/null" : log.c_str(),
                                           O_WRONLY | O_CREAT | O_APPEND, 0666);
    }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    ~FileActions() { ::posix_spawn_file_actions_destroy(&value_); }
    const posix_spawn_file_actions_t* pointer() const { return &value_; }

   private:
    posix_spawn_file_actions_t value_{};
};

}  // namespace

std::vector<std::string> split_command(std::string_view command) {
    return Splitter().split(command);
}

Process::Process(std::string_view command, ProcessOptions options) : options_(std::move(options)) {
    // A child that has gone must be met as an error of write(), not as a signal.
    [[maybe_unused]] static const auto ignored = std::signal(SIGPIPE, SIG_IGN);
    auto arguments = split_command(command);
    arguments[0] = locate(arguments[0]);
    start(arguments);
}

void Process::start(const std::vector<std::string>& arguments) {
    Pipe input, output;
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    // posix_spawn takes char* but leaves the strings alone.
    for (const auto& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    const FileActions actions(input.reading(), output.writing(), options_.log);
    const Attributes attributes;
    const int error = ::posix_spawn(&pid_, pointers[0], actions.pointer(), attributes.pointer(),
                                    pointers.data(), environ);
    if (error != 0) engine::fail("{}: cannot start: {}", arguments[0], reason(error));
    to_child_ = input.release_writing();
    from_child_ = output.release_reading();
    ::fcntl(to_child_, F_SETFL, O_NONBLOCK);
}

Process::~Process() {
    close_pipes();
    ended_before(Clock::now() + 500ms);
    ::kill(-pid_, SIGKILL);
    if (!reaped_) ::waitpid(pid_, &status_, 0);
}

void Process::close_pipes() {
    for (int* end : {&to_child_, &from_child_})
        if (*end >= 0) ::close(std::exchange(*end, -1));
}

bool Process::ended_before(Deadline deadline) {
    while (!reaped_) {
        reaped_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
        if (reaped_ || Clock::now() >= deadline) break;
        std::this_thread::sleep_for(5ms);
    }
    return reaped_;
}

void Process::report_end() {
    if (!ended_before(Clock::now() + 500ms)) throw Fault(Fault::Kind::crash, "closed its output");
    if (WIFSIGNALED(status_))
        throw Fault(Fault::Kind::crash, fmt::format("killed by signal {} ({})", WTERMSIG(status_),
                                                    ::sigdescr_np(WTERMSIG(status_))));
    throw Fault(Fault::Kind::crash, fmt::format("exited with status {}", WEXITSTATUS(status_)));
}

void Process::wait_for(int descriptor, short events, Deadline deadline) const {
    for (;;) {
        if (options_.stop.stop_requested()) throw Fault(Fault::Kind::stopped, "match stopped");
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
        // Short waits, so that a stop is noticed.
        const auto wait = std::clamp(left, 0ms, std::chrono::milliseconds(50));
        pollfd query{descriptor, events, 0};
        if (::poll(&query, 1, static_cast<int>(wait.count())) > 0) return;
        if (left <= 0ms) throw Fault(Fault::Kind::hang, "no answer");
    }
}

void Process::write_line(std::string_view line, Deadline deadline) {
    const std::string text = std::string(line) + '\n';
    for (std::size_t done = 0; done < text.size();) {
        const auto written = ::write(to_child_, text.data() + done, text.size() - done);
        if (written > 0)
            done += static_cast<std::size_t>(written);
        else if (errno == EAGAIN)
            wait_for(to_child_, POLLOUT, deadline);
        else if (errno != EINTR)
            report_end();
    }
}

void Process::read_some() {
    std::array<char, 4096> bytes;
    const auto count = ::read(from_child_, bytes.data(), bytes.size());
    if (count > 0)
        buffer_.append(bytes.data(), static_cast<std::size_t>(count));
    else if (count == 0 || errno != EINTR)
        report_end();
    if (buffer_.size() > longest_line) throw Fault(Fault::Kind::protocol, "endless line");
}

std::string Process::read_line(Deadline deadline) {
    for (;;) {
        const auto end = buffer_.find('\n', searched_);
        if (end != std::string::npos) {
            std::string line = buffer_.substr(0, end);
            buffer_.erase(0, end + 1);
            searched_ = 0;
            if (!line.empty() && line.back() == '\r') line.pop_back();
            return line;
        }
        searched_ = buffer_.size();
        wait_for(from_child_, POLLIN, deadline);
        read_some();
    }
}

std::optional<std::string> Process::try_read_line(Deadline deadline) try {
    return read_line(deadline);
} catch (const Fault& fault) {
    if (fault.kind != Fault::Kind::hang) throw;
    return std::nullopt;
}

}  // namespace selfplay
