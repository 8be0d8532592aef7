// What GoGui shows of the last search (gogui-analyze_commands).
#include <fmt/format.h>

#include "protocols/gtp.h"

namespace protocols {

std::string Gtp::gogui_commands(Words&) {
    return "gfx/Ownership/sanban-ownership\n"
           "gfx/Visit counts/sanban-visits\n"
           "gfx/Principal variation/sanban-variation\n"
           "string/Top moves/top_moves\n"
           "string/Estimated score/estimate_score\n"
           "string/Memory/lz-memory_report";
}

std::string Gtp::gogui_ownership(Words&) {
    if (last_picture_.owners.empty()) engine::fail("nothing has been searched yet");
    const float sign = last_player_ == engine::Player::first ? 1.0f : -1.0f;
    const auto& owners = last_picture_.owners;
    const auto size = static_cast<std::size_t>(now().size());
    std::string text = "INFLUENCE";
    for (std::size_t i = 0; i < owners.size(); ++i)
        text += fmt::format(" {} {:.2f}",
                            go::vertex({static_cast<int>(i % size), static_cast<int>(i / size)}),
                            sign * owners[i]);
    return text;
}

std::string Gtp::gogui_visits(Words&) {
    std::string text;
    for (const auto& move : last_picture_.moves)
        if (move.visits > 0 && move.move != go::Go::pass)
            text += fmt::format(" {} {}", now().move_to_text(move.move), move.visits);
    if (text.empty()) engine::fail("nothing has been searched yet");
    return fmt::format("LABEL{}", text);
}

std::string Gtp::gogui_variation(Words&) {
    if (last_picture_.moves.empty()) engine::fail("nothing has been searched yet");
    std::string text = "VAR";
    auto player = last_player_;
    for (const auto move : last_picture_.moves.front().variation) {
        text += fmt::format(" {} {}", player == engine::Player::first ? 'b' : 'w',
                            now().move_to_text(move));
        player = ~player;
    }
    return text;
}

}  // namespace protocols
