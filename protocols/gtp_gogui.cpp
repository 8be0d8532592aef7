// What GoGui shows of the last search (gogui-analyze_commands).
#include <fmt/format.h>

#include "protocols/gtp.h"

namespace protocols {

std::string Gtp::gogui_commands(Words&) {
    return "gfx/Ownership/sanban-ownership\n"
           "gfx/Visit counts/sanban-visits\n"
           "gfx/Principal variation/sanban-variation\n"
           "string/Moves of the last search/debug_moves\n"
           "string/Last search/gomill-explain_last_move\n"
           "string/Estimated score/estimate_score\n"
           "plist/Dead stones/final_status_list dead\n"
           "string/Memory/lz-memory_report";
}

std::string Gtp::gogui_title(Words&) {
    return fmt::format("{} {}", settings_.name, SANBAN_VERSION);
}

// +1 Black.
std::vector<float> Gtp::black_owners() const {
    auto owners = last_search().owners;
    if (owners.empty()) engine::fail("the last search saw no game to its end");
    if (last_root_->to_play() == engine::Player::second)
        for (float& owner : owners) owner = -owner;
    return owners;
}

std::string Gtp::gogui_ownership(Words&) {
    const auto owners = black_owners();
    const auto size = static_cast<std::size_t>(last_root_->size());
    std::string text = "INFLUENCE";
    for (std::size_t i = 0; i < owners.size(); ++i)
        text += fmt::format(" {} {:.2f}",
                            go::vertex({static_cast<int>(i % size), static_cast<int>(i / size)}),
                            owners[i]);
    return text;
}

std::string Gtp::gogui_visits(Words&) {
    std::string text = "LABEL";
    for (const auto& move : last_search().moves)
        if (move.visits > 0 && move.move != go::Go::pass)
            text += fmt::format(" {} {}", last_root_->move_to_text(move.move), move.visits);
    return text;
}

std::string Gtp::gogui_variation(Words&) {
    std::string text = "VAR";
    auto player = last_root_ ? last_root_->to_play() : engine::Player::first;
    for (const auto move : last_search().moves.front().variation) {
        text += fmt::format(" {} {}", player == engine::Player::first ? 'b' : 'w',
                            last_root_->move_to_text(move));
        player = ~player;
    }
    return text;
}

}  // namespace protocols
