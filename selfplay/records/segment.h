// Files of self-play games: zstd frames one after another, each with a checksum and holding some
// games, each behind its length (4 bytes, little-endian). A file grows by whole frames, so that
// whatever stops the program costs the last append at most; a reader takes the sound frames before
// a torn one and says what it left.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "selfplay/records/game.h"

namespace selfplay::records {

bool is_segment(std::string_view bytes);

struct Segment {
    std::vector<Game> games;
    std::size_t sound_bytes = 0;  // from the beginning; behind them lies what could not be read
    std::string damage;           // what is wrong there, in one line; empty when nothing is
};

// One frame of these games.
std::string pack(std::span<const Game> games);
// Fails with engine::Error when the bytes do not begin as a segment does.
Segment unpack(std::string_view bytes);

// The segments of a folder, 000001.games, 000002.games … One writer; what it has written may be
// read by anyone.
class Archive {
   public:
    // Makes the folder where there is none, and cuts a torn end off the newest segment: what was
    // lost is in damage(). Fails with engine::Error when the folder cannot be used.
    explicit Archive(std::filesystem::path folder);

    // Of all games that can be read now, oldest first.
    std::vector<std::filesystem::path> segments() const;
    const std::string& damage() const { return damage_; }

    // Appends and syncs; on failure the file is as it was before.
    void append(std::span<const Game> games);
    // Removes the oldest whole segments while more than `most` bytes lie there.
    void keep(std::uint64_t most) const;

   private:
    void start_segment();
    void resume(const std::filesystem::path& newest);

    static constexpr std::uint64_t segment_bytes = std::uint64_t{16} << 20;

    std::filesystem::path folder_, newest_;
    std::uint64_t number_ = 0, size_ = 0;
    std::string damage_;
};

}  // namespace selfplay::records
