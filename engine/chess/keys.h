// The random numbers that chess::Position's Zobrist key is made of; nobody else needs them.
#pragma once

#include <array>
#include <cstdint>

#include "engine/chess/bitboard.h"

namespace chess::keys {

struct Keys {
    std::array<std::array<std::array<std::uint64_t, 64>, 6>, 2> pieces{};  // player, piece, square
    std::array<std::uint64_t, 64> castling{};                              // square of the rook
    std::array<std::uint64_t, 8> en_passant{};                             // file
    std::uint64_t second_to_play = 0;
};

constexpr Keys make_keys() {
    std::uint64_t state = 0x3c6ef372fe94f82b;
    const auto next = [&state] {  // split-mix
        auto z = state += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    };
    Keys keys;
    for (auto& player : keys.pieces)
        for (auto& piece : player)
            for (auto& key : piece) key = next();
    for (auto& key : keys.castling) key = next();
    for (auto& key : keys.en_passant) key = next();
    keys.second_to_play = next();
    return keys;
}

inline constexpr Keys table = make_keys();

}  // namespace chess::keys
