// The words of CSA, shared by its reader and its writer.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "engine/shogi/record.h"

namespace shogi::csa {

inline constexpr std::array<std::string_view, kind_count> kind_names{
    "", "FU", "KY", "KE", "GI", "KI", "KA", "HI", "OU", "TO", "NY", "NK", "NG", "", "UM", "RY"};

struct NamedEnding {
    std::string_view name;
    Ending ending;
};
// The first name of an ending is the one written.
inline constexpr std::array endings{NamedEnding{"TORYO", Ending::resignation},
                                    NamedEnding{"TSUMI", Ending::mate},
                                    NamedEnding{"SENNICHITE", Ending::repetition},
                                    NamedEnding{"JISHOGI", Ending::impasse},
                                    NamedEnding{"KACHI", Ending::declaration},
                                    NamedEnding{"HIKIWAKE", Ending::draw},
                                    NamedEnding{"MAX_MOVES", Ending::move_limit},
                                    NamedEnding{"TIME_UP", Ending::time_up},
                                    NamedEnding{"ILLEGAL_MOVE", Ending::foul},
                                    NamedEnding{"CHUDAN", Ending::interrupted},
                                    NamedEnding{"MATTA", Ending::taken_back},
                                    NamedEnding{"FUZUMI", Ending::no_mate},
                                    NamedEnding{"ERROR", Ending::error}};

inline Kind kind_named(std::string_view name) {
    const auto* const found = std::find(kind_names.begin() + 1, kind_names.end(), name);
    return found == kind_names.end() || name.empty()
               ? Kind::none
               : static_cast<Kind>(found - kind_names.begin());
}

constexpr char sign(Player player) { return player == Player::first ? '+' : '-'; }

constexpr std::optional<Player> player_of(char sign) {
    if (sign == '+') return Player::first;
    if (sign == '-') return Player::second;
    return std::nullopt;
}

// Two digits, file and rank.
constexpr std::optional<int> square_of(std::string_view digits) {
    const int file = digits[0] - '1', rank = digits[1] - '1';
    if (!on_board(file, rank)) return std::nullopt;
    return square_at(file, rank);
}

}  // namespace shogi::csa
