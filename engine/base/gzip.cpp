#include "engine/base/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/files.h"

namespace engine {

namespace {

class Inflater {
   public:
    explicit Inflater(std::string_view bytes) : rest_(bytes) {
        // 16 + 15: a gzip header, and the largest window.
        if (::inflateInit2(&stream_, 16 + 15) != Z_OK) fail("gzip: no memory");
    }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() { ::inflateEnd(&stream_); }

    // Appends the next piece; false at the end of the last member.
    bool step(std::string& result) {
        feed();
        stream_.next_out = buffer_.data();
        stream_.avail_out = static_cast<uInt>(buffer_.size());
        const int status = ::inflate(&stream_, Z_NO_FLUSH);
        if (status == Z_BUF_ERROR) fail("gzip: cut short");
        if (status != Z_OK && status != Z_STREAM_END) fail("gzip: damaged");
        result.append(reinterpret_cast<const char*>(buffer_.data()),
                      buffer_.size() - stream_.avail_out);
        return status == Z_OK || next_member();
    }

   private:
    void feed() {
        if (stream_.avail_in != 0) return;
        const auto some = rest_.substr(0, std::numeric_limits<uInt>::max());
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(some.data()));
        stream_.avail_in = static_cast<uInt>(some.size());
        rest_.remove_prefix(some.size());
    }

    // What follows a member and is no gzip is padding, as gzip(1) sees it.
    bool next_member() {
        feed();
        const std::string_view rest(reinterpret_cast<const char*>(stream_.next_in),
                                    stream_.avail_in);
        return is_gzip(rest) && ::inflateReset(&stream_) == Z_OK;
    }

    std::string_view rest_;
    z_stream stream_{};
    std::array<Bytef, std::size_t{1} << 16> buffer_;
};

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.substr(0, 2) == "\x1f\x8b"; }

std::string gunzip(std::string_view bytes, std::size_t most) {
    std::string result;
    Inflater inflater(bytes);
    while (inflater.step(result))
        if (result.size() > most) break;
    if (result.size() > most) fail("gzip: unpacks to more than {} bytes", most);
    return result;
}

std::string read_plain_or_gzip(const std::filesystem::path& path, std::size_t most) {
    auto bytes = read_file(path, most);
    if (!is_gzip(bytes)) return bytes;
    try {
        return gunzip(bytes, most);
    } catch (const Error& error) {
        fail("{}: {}", path.string(), error.what());
    }
}

}  // namespace engine
