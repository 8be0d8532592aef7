#include "engine/base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "engine/base/error.h"

namespace engine {

namespace {

// Safe from any thread, unlike strerror.
std::string reason() { return std::generic_category().message(errno); }

class Descriptor {
   public:
    // Errors name the file `meant`, which `opened` may be a forerunner of.
    Descriptor(const std::filesystem::path& opened, int flags, const std::filesystem::path& meant)
        : path_(meant), fd_(::open(opened.c_str(), flags | O_CLOEXEC, 0666)) {
        if (fd_ < 0) fail("{}: cannot open for writing: {}", path_.string(), reason());
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }

    void write_all(std::string_view bytes) const {
        while (!bytes.empty()) {
            const auto written = ::write(fd_, bytes.data(), bytes.size());
            if (written < 0 && errno != EINTR)
                fail("{}: cannot write: {}", path_.string(), reason());
            if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }

    void sync_and_close() {
        // Devices and pipes have nothing to sync and say EINVAL.
        const bool synced = ::fsync(fd_) == 0 || errno == EINVAL || errno == EROFS;
        const bool closed = ::close(std::exchange(fd_, -1)) == 0;
        if (!synced || !closed) fail("{}: cannot write: {}", path_.string(), reason());
    }

   private:
    std::filesystem::path path_;
    int fd_;
};

}  // namespace

std::string read_file(const std::filesystem::path& path, std::size_t most) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) fail("{}: is a folder", path.string());
    std::ifstream in(path, std::ios::binary);
    if (!in) fail("{}: cannot open: {}", path.string(), reason());
    std::string bytes;
    constexpr std::size_t step = std::size_t{1} << 16;
    while (in) {
        const auto size = bytes.size();
        bytes.resize(size + step);
        in.read(bytes.data() + size, static_cast<std::streamsize>(step));
        bytes.resize(size + static_cast<std::size_t>(in.gcount()));
        if (bytes.size() > most) fail("{}: larger than {} bytes", path.string(), most);
    }
    if (in.bad()) fail("{}: cannot read: {}", path.string(), reason());
    return bytes;
}

std::optional<std::filesystem::path> user_folder(const char* variable, const char* in_home) {
    if (const char* folder = std::getenv(variable); folder && *folder)
        return std::filesystem::path(folder) / "sanban";
    if (const char* home = std::getenv("HOME"); home && *home)
        return std::filesystem::path(home) / in_home / "sanban";
    return std::nullopt;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
    // A device or pipe cannot be replaced, only written to.
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored) &&
        !std::filesystem::is_regular_file(path, ignored)) {
        Descriptor file(path, O_WRONLY, path);
        file.write_all(bytes);
        return file.sync_and_close();
    }
    const std::filesystem::path temporary = fmt::format("{}.{}.tmp", path.string(), ::getpid());
    try {
        Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC, path);
        file.write_all(bytes);
        file.sync_and_close();
        std::filesystem::rename(temporary, path);
    } catch (const std::filesystem::filesystem_error& error) {
        std::filesystem::remove(temporary, ignored);
        fail("{}: cannot write: {}", path.string(), error.code().message());
    } catch (const Error&) {
        std::filesystem::remove(temporary, ignored);
        throw;
    }
}

void append_file(const std::filesystem::path& path, std::string_view bytes) {
    Descriptor file(path, O_WRONLY | O_CREAT | O_APPEND, path);
    file.write_all(bytes);
    file.sync_and_close();
}

}  // namespace engine
