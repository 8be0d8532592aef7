#include "selfplay/csa_text.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string_view>

#include "engine/base/error.h"
#include "engine/shogi/shogi.h"
#include "engine/shogi/usi.h"

namespace selfplay {

namespace {

using shogi::Kind;

// By Kind.
constexpr std::array<std::string_view, shogi::kind_count> names{
    "", "FU", "KY", "KE", "GI", "KI", "KA", "HI", "OU", "TO", "NY", "NK", "NG", "", "UM", "RY"};

char sign(engine::Player player) { return player == engine::Player::first ? '+' : '-'; }

// "77": CSA counts ranks by digits, USI by letters.
std::string square_text(int square) {
    auto text = shogi::to_usi(square);
    text[1] = static_cast<char>(text[1] - 'a' + '1');
    return text;
}

std::string move_text(const shogi::Position& before, engine::Move move) {
    auto after = before;
    after.play(move);
    const int to = shogi::to_square(move);
    const auto from = shogi::is_drop(move) ? "00" : square_text(shogi::from_square(move));
    return fmt::format("{}{}{}{}", sign(before.to_play()), from, square_text(to),
                       names[shogi::index(after.at(to).kind())]);
}

std::string pieces_text(const shogi::Position& position) {
    std::string text;
    for (int square = 0; square < shogi::square_count; ++square)
        if (const auto piece = position.at(square); !piece.empty())
            text += fmt::format("P{}{}{}\n", sign(piece.player()), square_text(square),
                                names[shogi::index(piece.kind())]);
    for (const auto player : {engine::Player::first, engine::Player::second})
        for (const auto kind : shogi::hand_kinds)
            for (int i = 0; i < position.hand(player, kind); ++i)
                text += fmt::format("P{}00{}\n", sign(player), names[shogi::index(kind)]);
    return text;
}

std::string ending_text(const GameRecord& record) {
    constexpr std::array<std::array<std::string_view, 2>, 9> words{{
        {"resignation", "%TORYO"},
        {"checkmate", "%TSUMI"},
        {"declaration", "%KACHI"},
        {"repetition", "%SENNICHITE"},
        {"time", "%TIME_UP"},
        {"move limit", "%MAX_MOVES"},
        {"illegal move", "%ILLEGAL_MOVE"},
        {"perpetual check", "%ILLEGAL_MOVE"},
        {"adjudication", "%CHUDAN"},
    }};
    for (const auto& [reason, word] : words)
        if (reason == record.reason) return std::string(word);
    return "%CHUDAN";
}

}  // namespace

std::string to_csa(const GameRecord& record) {
    const auto start =
        record.start.empty() ? shogi::Shogi() : shogi::Shogi::from_text(record.start);
    auto position = start.position();
    auto text = fmt::format("V2.2\nN+{}\nN-{}\n$EVENT:sanban match game {}\n",
                            record.name_of(engine::Player::first),
                            record.name_of(engine::Player::second), record.index + 1);
    text += position == shogi::Position::start() ? "PI\n" : pieces_text(position);
    text += fmt::format("{}\n", sign(position.to_play()));
    std::size_t timed = 0;
    for (std::size_t i = 0; i < record.moves.size(); ++i) {
        const auto move = shogi::parse_usi_move(record.moves[i]);
        if (!move) engine::fail("game {}: not a move: {}", record.index + 1, record.moves[i]);
        text += move_text(position, *move) + '\n';
        position.play(*move);
        if (static_cast<int>(i) >= record.opening_moves && timed < record.milliseconds.size())
            text += fmt::format("T{}\n", record.milliseconds[timed++] / 1000);
    }
    text += ending_text(record) + '\n';
    text +=
        fmt::format("'{}{}{}\n", record.reason, record.detail.empty() ? "" : ": ", record.detail);
    return (record.index > 0 ? "/\n" : "") + text;
}

}  // namespace selfplay
