#include "selfplay/csa_text.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string_view>

#include "engine/base/error.h"
#include "engine/shogi/csa.h"
#include "engine/shogi/usi.h"

namespace selfplay {

namespace {

using shogi::Ending;

Ending ending_of(std::string_view reason) {
    struct Reason {
        std::string_view name;
        Ending ending;
    };
    constexpr std::array reasons{
        Reason{"resignation", Ending::resignation}, Reason{"checkmate", Ending::mate},
        Reason{"no legal move", Ending::mate},      Reason{"declaration", Ending::declaration},
        Reason{"repetition", Ending::repetition},   Reason{"time", Ending::time_up},
        Reason{"move limit", Ending::move_limit},   Reason{"illegal move", Ending::foul},
        Reason{"perpetual check", Ending::foul}};
    for (const auto& [name, ending] : reasons)
        if (name == reason) return ending;
    return Ending::interrupted;
}

void append_moves(shogi::Record& text, const GameRecord& record) {
    shogi::RecordWriter writer(text);
    std::size_t timed = 0;
    for (std::size_t i = 0; i < record.moves.size(); ++i) {
        const auto move = shogi::parse_usi_move(record.moves[i]);
        if (!move) engine::fail("game {}: not a move: {}", record.index + 1, record.moves[i]);
        writer.play(*move, record.moves[i]);
        if (static_cast<int>(i) >= record.opening_moves && timed < record.milliseconds.size())
            writer.node().seconds = record.milliseconds[timed++] / 1000;
    }
    writer.node().ending = ending_of(record.reason);
    writer.node().comment =
        fmt::format("{}{}{}", record.reason, record.detail.empty() ? "" : ": ", record.detail);
}

}  // namespace

std::string to_csa(const GameRecord& record) {
    shogi::Record text;
    text.black = record.name_of(engine::Player::first);
    text.white = record.name_of(engine::Player::second);
    text.facts = {{"EVENT", fmt::format("{} game {}", record.event, record.index + 1)}};
    if (!record.start.empty()) text.start = shogi::Shogi::from_text(record.start);
    append_moves(text, record);
    return (record.index > 0 ? "/\n" : "") + shogi::csa::to_text(text);
}

}  // namespace selfplay
