#include "nn/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <memory>

#include "engine/base/error.h"

namespace nn {

namespace {

// Weights are noise and hardly shrink, as text to a third; even fresh ones stay far within this.
std::size_t largest_result(std::size_t compressed) {
    constexpr std::size_t least = std::size_t{1} << 25, most = std::size_t{1} << 31;
    return std::min(most, std::max(least, compressed * 12));
}

struct EndInflate {
    void operator()(z_stream* stream) const { inflateEnd(stream); }
};

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::string gunzip(std::string_view bytes) {
    if (bytes.size() > std::size_t{1} << 30) engine::fail("compressed data over 1 GiB");
    z_stream stream{};
    // 31: the largest window, and a gzip header.
    if (inflateInit2(&stream, 31) != Z_OK) engine::fail("zlib does not start");
    const std::unique_ptr<z_stream, EndInflate> owner(&stream);
    // zlib's interface is older than const.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());

    const auto limit = largest_result(bytes.size());
    std::string result;
    int status = Z_OK;
    while (status != Z_STREAM_END) {
        const auto size = result.size();
        constexpr std::size_t step = std::size_t{1} << 20;
        result.resize(size + step);
        stream.next_out = reinterpret_cast<Bytef*>(result.data() + size);
        stream.avail_out = static_cast<uInt>(step);
        status = inflate(&stream, Z_NO_FLUSH);
        result.resize(size + step - stream.avail_out);
        if (status != Z_OK && status != Z_STREAM_END)
            engine::fail("damaged or cut gzip data after {} bytes", result.size());
        if (result.size() > limit)
            engine::fail("expands to more than {} bytes, which no weight file of {} bytes does",
                         limit, bytes.size());
    }
    return result;
}

}  // namespace nn
