#include "engine/go/sgf_collection.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/go/sgf.h"

namespace go::sgf {

namespace {

// What a message says after the place and the value it speaks of.
std::string reason_of(std::string_view message) {
    const auto colon = message.rfind(": ");
    auto reason = colon == message.npos ? message : message.substr(colon + 2);
    const auto bracket = reason.find("] ");
    if (bracket != reason.npos) reason.remove_prefix(bracket + 2);
    return std::string(reason);
}

// False at the end of the collection. Fails with the reason when the game is refused.
bool replay_next(GameReader& reader, CollectionReport& report) {
    ++report.games;
    const auto tree = reader.next();
    if (!tree) {
        --report.games;
        return false;
    }
    const auto record = main_line(*tree);
    ++report.replayed;
    report.moves += record.moves_before + static_cast<std::int64_t>(record.turns.size());
    report.noted += !record.notes.empty();
    return true;
}

}  // namespace

CollectionReport check_collection(const std::filesystem::path& path,
                                  const std::function<void(const Refusal&)>& on_refusal,
                                  std::int64_t most_games) {
    const auto text = read_file(path);
    GameReader reader(text);
    CollectionReport report;
    bool more = true;
    while (more && report.games < most_games) {
        try {
            more = replay_next(reader, report);
        } catch (const engine::Error& error) {
            ++report.reasons[reason_of(error.what())];
            if (on_refusal)
                on_refusal({report.games, reader.line(),
                            fmt::format("{}, game {} (line {}): {}", path.string(), report.games,
                                        reader.line(), error.what())});
        }
    }
    if (report.games == 0)
        engine::fail("{}: no game tree, which would begin with (;", path.string());
    return report;
}

}  // namespace go::sgf
