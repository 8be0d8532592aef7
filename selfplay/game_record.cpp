#include "selfplay/game_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"

namespace selfplay {

namespace {

using engine::Outcome;

constexpr std::array<std::string_view, 4> outcome_names{"ongoing", "draw", "first", "second"};

Outcome outcome_from(const std::string& text) {
    const auto found = std::find(outcome_names.begin(), outcome_names.end(), text);
    if (found == outcome_names.end()) engine::fail("not an outcome: {}", text);
    return static_cast<Outcome>(found - outcome_names.begin());
}

}  // namespace

int GameRecord::winner() const {
    if (outcome == Outcome::first_wins) return first;
    return outcome == Outcome::second_wins ? 1 - first : -1;
}

bool GameRecord::by_fault() const {
    constexpr std::array<std::string_view, 5> faults{"crash", "hang", "illegal move",
                                                     "protocol error", "time"};
    return std::find(faults.begin(), faults.end(), reason) != faults.end();
}

const std::string& GameRecord::name_of(engine::Player player) const {
    return names[static_cast<std::size_t>(player == engine::Player::first ? first : 1 - first)];
}

std::string to_json(const GameRecord& record) {
    nlohmann::ordered_json json{
        {"game", record.index},
        {"first", record.first},
        {"names", record.names},
        {"outcome", outcome_names[static_cast<std::size_t>(record.outcome)]},
        {"reason", record.reason},
        {"score", record.score},
        {"detail", record.detail},
        {"start", record.start},
        {"opening_moves", record.opening_moves},
        {"moves", record.moves},
        {"milliseconds", record.milliseconds},
        {"dead", record.dead},
    };
    // Whatever an engine said, the line is valid JSON.
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

GameRecord record_from_json(std::string_view line) {
    try {
        const auto json = nlohmann::json::parse(line);
        GameRecord record;
        json.at("game").get_to(record.index);
        json.at("first").get_to(record.first);
        json.at("names").get_to(record.names);
        record.outcome = outcome_from(json.at("outcome").get<std::string>());
        json.at("reason").get_to(record.reason);
        json.at("score").get_to(record.score);
        json.at("detail").get_to(record.detail);
        json.at("start").get_to(record.start);
        json.at("opening_moves").get_to(record.opening_moves);
        json.at("moves").get_to(record.moves);
        json.at("milliseconds").get_to(record.milliseconds);
        json.at("dead").get_to(record.dead);
        if (record.index < 0 || record.first < 0 || record.first > 1)
            engine::fail("game number or side out of range");
        return record;
    } catch (const nlohmann::json::exception& error) {
        engine::fail("not a game record: {}", error.what());
    }
}

}  // namespace selfplay
