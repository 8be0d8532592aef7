#include "selfplay/training/self_play.h"

#include "engine/base/error.h"
#include "engine/base/files.h"

namespace selfplay::training {

void count(const records::Game& game, SelfPlayProgress& progress) {
    ++progress.games;
    progress.positions += game.turns.size();
    for (const auto& turn : game.turns) progress.taught += turn.share_count > 0;
    progress.resigned += game.ending == records::Ending::resigned;
}

std::uint64_t seed_for(const records::Archive& archive, std::string_view game, std::uint64_t seed) {
    const auto segments = archive.segments();
    if (segments.empty()) return seed;
    std::uint64_t bytes = 0;
    for (const auto& path : segments) bytes += std::filesystem::file_size(path);
    const auto there = records::unpack(engine::read_file(segments.front())).games;
    if (!there.empty() && there.front().game != game)
        engine::fail("{}: holds games of {}, not {}: choose another folder",
                     segments.front().parent_path().string(), there.front().game, game);
    return engine::mixed(seed, bytes);
}

}  // namespace selfplay::training
