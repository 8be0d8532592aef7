#include "selfplay/records/segment.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/files.h"

namespace selfplay::records {

namespace {

constexpr std::size_t length_bytes = 4;
// No honest frame is larger; a hostile one may claim to be.
constexpr std::uint64_t most_frame = std::uint64_t{1} << 30;

void append_length(std::string& bytes, std::size_t length) {
    for (std::size_t i = 0; i < length_bytes; ++i)
        bytes.push_back(static_cast<char>(length >> 8 * i & 0xff));
}

std::size_t length_at(std::string_view bytes) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < length_bytes; ++i)
        length |= std::size_t{static_cast<unsigned char>(bytes[i])} << 8 * i;
    return length;
}

void read_games(std::string_view bytes, std::vector<Game>& games) {
    while (!bytes.empty()) {
        if (bytes.size() < length_bytes || bytes.size() - length_bytes < length_at(bytes))
            engine::fail("a frame that ends within a game");
        games.push_back(from_bytes(bytes.substr(length_bytes, length_at(bytes))));
        bytes.remove_prefix(length_bytes + length_at(bytes));
    }
}

std::string decompress(std::string_view frame) {
    const auto size = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size > most_frame)
        engine::fail("a frame that does not say its size");
    std::string bytes(size, '\0');
    const auto got = ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size());
    if (ZSTD_isError(got)) engine::fail("{}", ZSTD_getErrorName(got));
    return bytes;
}

// Size of the first frame; fails on one that is cut short.
std::size_t frame_size(std::string_view bytes) {
    const auto size = ZSTD_findFrameCompressedSize(bytes.data(), bytes.size());
    if (ZSTD_isError(size)) engine::fail("{}", ZSTD_getErrorName(size));
    return size;
}

// Of "000017.games": 17.
std::optional<std::uint64_t> number_of(const std::filesystem::path& path) {
    const auto stem = path.stem().string();
    std::uint64_t number = 0;
    const auto* const last = stem.data() + stem.size();
    const auto [end, status] = std::from_chars(stem.data(), last, number);
    if (status != std::errc{} || end != last) return {};
    return number;
}

}  // namespace

bool is_segment(std::string_view bytes) {
    constexpr std::string_view magic = "\x28\xb5\x2f\xfd";
    return bytes.substr(0, magic.size()) == magic;
}

std::string pack(std::span<const Game> games) {
    std::string plain;
    for (const auto& game : games) {
        const auto bytes = to_bytes(game);
        append_length(plain, bytes.size());
        plain += bytes;
    }
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                       ZSTD_freeCCtx);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
    std::string frame(ZSTD_compressBound(plain.size()), '\0');
    const auto size =
        ZSTD_compress2(context.get(), frame.data(), frame.size(), plain.data(), plain.size());
    if (ZSTD_isError(size)) engine::fail("zstd: {}", ZSTD_getErrorName(size));
    frame.resize(size);
    return frame;
}

Segment unpack(std::string_view bytes) {
    if (!bytes.empty() && !is_segment(bytes))
        engine::fail("not a file of self-play games: expected a zstd frame");
    Segment segment;
    while (segment.sound_bytes < bytes.size()) {
        const auto rest = bytes.substr(segment.sound_bytes);
        std::vector<Game> games;
        try {
            const auto size = frame_size(rest);
            read_games(decompress(rest.substr(0, size)), games);
            segment.sound_bytes += size;
        } catch (const engine::Error& error) {
            segment.damage = fmt::format("{} bytes after {} sound ones: {}", rest.size(),
                                         segment.sound_bytes, error.what());
            return segment;
        }
        std::move(games.begin(), games.end(), std::back_inserter(segment.games));
    }
    return segment;
}

Archive::Archive(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) engine::fail("{}: cannot make the folder: {}", folder_.string(), error.message());
    if (const auto there = segments(); there.empty())
        start_segment();
    else
        resume(there.back());
}

void Archive::resume(const std::filesystem::path& newest) {
    newest_ = newest;
    number_ = *number_of(newest);
    const auto segment = unpack(engine::read_file(newest));
    size_ = segment.sound_bytes;
    if (segment.damage.empty()) return;
    damage_ = fmt::format("{}: {}; cut off", newest.string(), segment.damage);
    std::error_code error;
    std::filesystem::resize_file(newest, size_, error);
    if (error) engine::fail("{}: cannot cut: {}", newest.string(), error.message());
}

std::vector<std::filesystem::path> Archive::segments() const {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
        if (entry.path().extension() == ".games" && number_of(entry.path()))
            paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

void Archive::start_segment() {
    newest_ = folder_ / fmt::format("{:06}.games", ++number_);
    size_ = 0;
}

void Archive::append(std::span<const Game> games) {
    if (games.empty()) return;
    if (size_ >= segment_bytes) start_segment();
    const auto frame = pack(games);
    try {
        engine::append_file(newest_, frame);
    } catch (const engine::Error&) {
        // Half a frame would hide every later one from the reader.
        std::error_code ignored;
        std::filesystem::resize_file(newest_, size_, ignored);
        throw;
    }
    size_ += frame.size();
}

void Archive::keep(std::uint64_t most) const {
    const auto paths = segments();
    std::uint64_t total = 0;
    for (const auto& path : paths) total += std::filesystem::file_size(path);
    for (std::size_t i = 0; total > most && i + 1 < paths.size(); ++i) {
        total -= std::filesystem::file_size(paths[i]);
        std::filesystem::remove(paths[i]);
    }
}

}  // namespace selfplay::records
