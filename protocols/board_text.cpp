#include "protocols/board_text.h"

#include <fmt/format.h>

#include <array>
#include <sstream>
#include <string_view>
#include <vector>

#include "engine/chess/pgn.h"
#include "engine/shogi/csa.h"
#include "engine/shogi/kif.h"
#include "engine/shogi/sfen.h"

namespace protocols {

namespace {

using engine::Outcome;
using engine::Player;

// A rank of a FEN or SFEN, two columns a square.
std::string spread(std::string_view rank) {
    std::string text;
    bool promoted = false;
    for (const char c : rank) {
        if (c >= '1' && c <= '9')
            for (int i = 0; i < c - '0'; ++i) text += " .";
        else if (c != '+')
            text.append(1, promoted ? '+' : ' ').append(1, c);
        promoted = c == '+';
    }
    return text;
}

std::vector<std::string> ranks_of(const std::string& position) {
    std::istringstream ranks(position.substr(0, position.find(' ')));
    std::vector<std::string> list;
    for (std::string rank; std::getline(ranks, rank, '/');) list.push_back(spread(rank));
    return list;
}

std::string hand_of(const shogi::Position& position, Player player) {
    std::string text;
    for (auto kind = shogi::hand_kinds.rbegin(); kind != shogi::hand_kinds.rend(); ++kind)
        if (const int count = position.hand(player, *kind))
            text += fmt::format(" {}{}", shogi::letters({player, *kind}),
                                count > 1 ? std::to_string(count) : "");
    return text.empty() ? " nothing" : text;
}

// The moves between the states, of which each must follow from the one before.
template <engine::Game G>
std::vector<engine::Move> moves_between(std::span<const G> states) {
    std::vector<engine::Move> moves;
    for (std::size_t i = 1; i < states.size(); ++i)
        for (const auto move : states[i - 1].legal_moves()) {
            G next = states[i - 1];
            next.play(move);
            if (next.key() != states[i].key()) continue;
            moves.push_back(move);
            break;
        }
    return moves;
}

shogi::Ending ending_of(const shogi::Shogi& game) {
    const auto outcome = game.outcome();
    if (outcome == Outcome::ongoing) return shogi::Ending::interrupted;
    if (outcome == Outcome::draw) return shogi::Ending::repetition;
    if (game.legal_moves().empty()) return shogi::Ending::mate;
    if (outcome != engine::win_for(game.to_play())) return shogi::Ending::foul;
    return game.can_declare_win() ? shogi::Ending::declaration : shogi::Ending::foul_of_opponent;
}

}  // namespace

std::string diagram(const chess::Chess& game) {
    const auto position = game.to_text();
    std::string text;
    char label = '8';
    for (const auto& rank : ranks_of(position)) text += fmt::format("{} {}\n", label--, rank);
    return text + "   a b c d e f g h\n" + position;
}

std::string diagram(const shogi::Shogi& game) {
    const auto position = game.to_text();
    auto text = fmt::format("White holds{}\n  9 8 7 6 5 4 3 2 1\n",
                            hand_of(game.position(), Player::second));
    char label = 'a';
    for (const auto& rank : ranks_of(position)) text += fmt::format("{}  {}\n", rank, label++);
    return fmt::format("{}Black holds{}\n{}", text, hand_of(game.position(), Player::first),
                       position);
}

std::string to_pgn(std::span<const chess::Chess> states, bool resigned) {
    constexpr std::array<std::string_view, 4> results{"*", "1/2-1/2", "1-0", "0-1"};
    const auto& last = states.back();
    const auto outcome = resigned ? engine::win_for(~last.to_play()) : last.outcome();
    return chess::pgn::to_text(chess::pgn::record_of(states.front(), moves_between(states),
                                                     results[static_cast<std::size_t>(outcome)]));
}

std::string to_shogi_record(std::span<const shogi::Shogi> states, bool resigned, bool kif) {
    const auto ending = resigned ? shogi::Ending::resignation : ending_of(states.back());
    const auto record = shogi::record_of(states.front(), moves_between(states), ending);
    return kif ? shogi::kif::to_text(record) : shogi::csa::to_text(record);
}

}  // namespace protocols
