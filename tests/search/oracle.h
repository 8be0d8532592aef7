// What other programs say of positions, where the shared data is at hand.
#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/chess/chess.h"
#include "engine/go/go.h"
#include "tests/nn/shared.h"

namespace oracle {

using Json = nlohmann::json;

inline std::filesystem::path network(const char* name) { return nn::shared_data() / "nets" / name; }

inline std::vector<Json> lines_of(const char* name) {
    std::vector<Json> lines;
    std::ifstream in(nn::shared_data() / "oracle" / name);
    for (std::string line; std::getline(in, line);) lines.push_back(Json::parse(line));
    return lines;
}

// All positions of a line, from the start to the one that the answer is about.
inline std::vector<go::Go> go_positions(const Json& line) {
    std::vector<go::Go> games{go::Go(line["size"].get<int>(),
                                     go::Komi::from_points(line["komi"].get<double>()),
                                     go::rules_from_text(line["rules"].get<std::string>()))};
    for (const auto& turn : line["moves"]) {
        games.back().set_to_play(turn[0] == "b" ? engine::Player::first : engine::Player::second);
        games.push_back(games.back());
        games.back().play(*games.back().move_from_text(turn[1].get<std::string>()));
    }
    return games;
}

inline std::vector<chess::Chess> chess_positions(const Json& line) {
    std::vector<chess::Chess> games{line.contains("fen")
                                        ? chess::Chess::from_text(line["fen"].get<std::string>())
                                        : chess::Chess()};
    for (const auto& text : line["moves"]) {
        games.push_back(games.back());
        games.back().play(*games.back().move_from_text(text.get<std::string>()));
    }
    return games;
}

}  // namespace oracle
