// `sanban gtp` as a program of its own, fed with what no protocol knows.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// The program behind two pipes.
class Child {
   public:
    Child() : Child({"gtp", "--size", "9", "--memory", "16", "--threads", "1", "--time", "20"}) {}
    explicit Child(std::vector<const char*> arguments) {
        arguments.insert(arguments.begin(), "sanban");
        arguments.push_back(nullptr);
        int in[2], out[2];
        if (::pipe2(in, O_CLOEXEC) != 0 || ::pipe2(out, O_CLOEXEC) != 0) std::abort();
        pid_ = ::fork();
        if (pid_ == 0) {
            ::dup2(in[0], 0);
            ::dup2(out[1], 1);
            ::execv(SANBAN_EXECUTABLE, const_cast<char* const*>(arguments.data()));
            ::_exit(127);
        }
        ::close(in[0]);
        ::close(out[1]);
        to_ = in[1];
        from_ = out[0];
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        end_input();
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            ::waitpid(pid_, nullptr, 0);
        }
        ::close(from_);
    }

    void say(std::string_view bytes) {
        while (!bytes.empty()) {
            const auto written = ::write(to_, bytes.data(), bytes.size());
            ASSERT_GT(written, 0);
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }
    void end_input() {
        if (to_ >= 0) ::close(to_);
        to_ = -1;
    }
    // One answer, to the blank line behind it.
    std::string answer() {
        std::string text;
        for (char c = 0; !text.ends_with("\n\n") && ::read(from_, &c, 1) == 1;) text += c;
        return text;
    }
    std::string rest() {
        std::string text;
        for (char c = 0; ::read(from_, &c, 1) == 1;) text += c;
        return text;
    }
    // What the program exits with; -1 when a signal ended it.
    int exit_code() {
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

   private:
    pid_t pid_ = 0;
    int to_ = -1, from_ = -1;
};

}  // namespace

TEST(GtpExecutable, AnswersQuitAndLeaves) {
    Child child;
    child.say("1 name\n2 quit\n3 name\n");
    EXPECT_EQ(child.rest(), "=1 sanban\n\n=2 \n\n");
    EXPECT_EQ(child.exit_code(), 0);
}

TEST(GtpExecutable, ALineOfAHundredMegabytesIsRefused) {
    Child child;
    const std::string megabyte(1 << 20, 'x');
    for (int i = 0; i < 100; ++i) child.say(megabyte);
    child.say("\nname\n");
    EXPECT_TRUE(child.answer().starts_with("? a line is longer than 1048576 bytes"));
    EXPECT_EQ(child.answer(), "= sanban\n\n");
}

TEST(GtpExecutable, ControlCharactersAreDropped) {
    Child child;
    child.say(
        std::string_view("na\0m\x01"
                         "e\r\n\0\0\n\tprotocol_version\r\n",
                         31));
    EXPECT_EQ(child.answer(), "= sanban\n\n");
    EXPECT_EQ(child.answer(), "= 2\n\n");
}

TEST(GtpExecutable, NoiseIsAnsweredAndSurvived) {
    Child child;
    std::thread writer([&] {
        std::uint32_t state = 12345;
        std::string noise;
        for (int i = 0; i < 1 << 18; ++i) {
            state = state * 1664525 + 1013904223;
            noise += static_cast<char>(state >> 24);
        }
        child.say(noise);
        child.say("\n99 name\nquit\n");
    });
    const auto answers = child.rest();
    writer.join();
    EXPECT_TRUE(answers.ends_with("=99 sanban\n\n= \n\n"));
    EXPECT_TRUE(answers.starts_with("?"));
    EXPECT_EQ(child.exit_code(), 0);
}

TEST(GtpExecutable, TheEndOfInputEndsIt) {
    Child child;
    child.say("name\nboardsi");
    child.end_input();
    EXPECT_EQ(child.rest(), "= sanban\n\n? unknown command\n\n");
    EXPECT_EQ(child.exit_code(), 0);
    Child analysing;
    analysing.say("lz-analyze 1\n");
    std::this_thread::sleep_for(100ms);
    analysing.end_input();
    const auto text = analysing.rest();
    EXPECT_TRUE(text.starts_with("=\n"));
    EXPECT_TRUE(text.ends_with("\n\n"));
    EXPECT_EQ(analysing.exit_code(), 0);
}

TEST(GtpExecutable, AnInterruptCutsAGenmoveShort) {
    Child child;
    child.say("name\n");
    child.answer();
    child.say("genmove b\n");
    std::this_thread::sleep_for(300ms);
    const auto start = Clock::now();
    child.say("# interrupt\n");
    const auto answer = child.answer();
    EXPECT_LT(Clock::now() - start, 200ms);
    EXPECT_TRUE(answer.starts_with("= ")) << answer;
    // The interrupt itself has no answer.
    child.say("name\n");
    EXPECT_EQ(child.answer(), "= sanban\n\n");
}

TEST(GtpExecutable, AnInterruptSentAtOnceIsNotLost) {
    Child child;
    const auto start = Clock::now();
    child.say("genmove b\n# interrupt\nname\n");
    EXPECT_TRUE(child.answer().starts_with("= "));
    EXPECT_EQ(child.answer(), "= sanban\n\n");
    child.say("kata-search_analyze_cancellable w 10\nname\n");
    EXPECT_TRUE(child.answer().ends_with("\nplay cancelled\n\n"));
    EXPECT_EQ(child.answer(), "= sanban\n\n");
    EXPECT_LT(Clock::now() - start, 10s);
}

TEST(GtpExecutable, LinesBehindAGenmoveDoNotCutIt) {
    Child child({"gtp", "--size", "9", "--memory", "16", "--threads", "1", "--time", "0.5"});
    const auto start = Clock::now();
    child.say("genmove b\nname\ngenmove w\nquit\n");
    child.rest();
    EXPECT_GE(Clock::now() - start, 1s);
    EXPECT_EQ(child.exit_code(), 0);
}

TEST(GtpExecutable, TheFirstLineDecidesTheProtocol) {
    Child gtp(std::vector<const char*>{});
    gtp.say("3 name\nquit\n");
    EXPECT_EQ(gtp.rest(), "=3 sanban\n\n= \n\n");
    EXPECT_EQ(gtp.exit_code(), 0);
    for (const auto& [hello, done] : {std::pair{"uci", "uciok"}, {"usi", "usiok"}}) {
        Child child(std::vector<const char*>{});
        child.say(std::string(hello) + "\nquit\n");
        const auto text = child.rest();
        EXPECT_TRUE(text.starts_with("id name sanban")) << text;
        EXPECT_TRUE(text.ends_with(std::string(done) + "\n")) << text;
        EXPECT_EQ(child.exit_code(), 0);
    }
}

TEST(GtpExecutable, BadInputAndWrongUsageHaveTheirStatus) {
    EXPECT_EQ(Child({"gtp", "--rules", "xyzzy"}).exit_code(), 1);
    EXPECT_EQ(Child({"gtp", "--komi", "0.3"}).exit_code(), 1);
    EXPECT_EQ(Child({"gtp", "--size", "26"}).exit_code(), 2);
    EXPECT_EQ(Child({"gtp", "--xyzzy"}).exit_code(), 2);
    EXPECT_EQ(Child({"xyzzy"}).exit_code(), 2);
    EXPECT_EQ(Child({"--version"}).exit_code(), 0);
    EXPECT_EQ(Child({"gtp", "--commands"}).exit_code(), 0);
}
