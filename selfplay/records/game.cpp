#include "selfplay/records/game.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "selfplay/records/game.pb.h"

namespace selfplay::records {

namespace {

constexpr float value_unit = 1000, share_unit = 65535;

int number_of(engine::Outcome outcome) {
    if (outcome == engine::Outcome::first_wins) return 1;
    return outcome == engine::Outcome::second_wins ? -1 : 0;
}

engine::Outcome outcome_from(int number) {
    if (number == 0) return engine::Outcome::draw;
    return number > 0 ? engine::Outcome::first_wins : engine::Outcome::second_wins;
}

void add_turns(const Game& game, sanban::records::Game& message) {
    for (const auto& turn : game.turns) {
        message.add_moves(turn.move.code);
        message.add_values(static_cast<int>(std::lround(turn.value * value_unit)));
        message.add_draws(static_cast<std::uint32_t>(std::lround(turn.draws * value_unit)));
        message.add_simulations(turn.simulations);
        message.add_share_counts(turn.share_count);
    }
    for (const auto& [move, share] : game.shares) {
        message.add_share_moves(move.code);
        message.add_shares(share);
    }
}

// Every list that says one thing a turn must have one entry a turn.
void check_lists(const sanban::records::Game& message) {
    const auto turns = message.moves_size();
    if (message.values_size() != turns || message.simulations_size() != turns ||
        message.share_counts_size() != turns)
        engine::fail("a record of {} moves with {} values, {} simulations and {} policies", turns,
                     message.values_size(), message.simulations_size(),
                     message.share_counts_size());
    if (message.draws_size() != 0 && message.draws_size() != turns)
        engine::fail("a record of {} moves with {} chances of a draw", turns, message.draws_size());
    std::uint64_t wanted = 0;
    for (const auto count : message.share_counts()) wanted += count;
    const auto there = static_cast<std::uint64_t>(message.share_moves_size());
    if (wanted != there || message.shares_size() != message.share_moves_size())
        engine::fail("a record whose policies want {} shares and has {}", wanted, there);
}

std::uint16_t narrow(std::uint32_t number, std::string_view what) {
    if (number > 0xffff) engine::fail("a record with a {} of {}", what, number);
    return static_cast<std::uint16_t>(number);
}

void read_turns(const sanban::records::Game& message, Game& game) {
    std::uint32_t next = 0;
    for (int i = 0; i < message.moves_size(); ++i) {
        Turn turn;
        turn.move.code = narrow(message.moves(i), "move");
        turn.value = std::clamp(static_cast<float>(message.values(i)) / value_unit, -1.0f, 1.0f);
        if (message.draws_size() > 0)
            turn.draws = std::min(static_cast<float>(message.draws(i)) / value_unit, 1.0f);
        turn.simulations = message.simulations(i);
        turn.first_share = next;
        turn.share_count = message.share_counts(i);
        next += turn.share_count;
        game.turns.push_back(turn);
    }
    for (int i = 0; i < message.shares_size(); ++i)
        game.shares.push_back(
            {{narrow(message.share_moves(i), "move")}, narrow(message.shares(i), "share")});
}

}  // namespace

std::string_view name_of(Ending ending) {
    constexpr std::string_view names[] = {"rules", "resignation", "move limit", "agreement"};
    return names[static_cast<std::size_t>(ending)];
}

void Game::add(engine::Move move, float value, std::uint32_t simulations,
               std::span<const engine::Move> moves, std::span<const float> policy) {
    Turn turn;
    turn.move = move;
    turn.value = value;
    turn.simulations = simulations;
    turn.first_share = static_cast<std::uint32_t>(shares.size());
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const auto share = std::lround(std::clamp(policy[i], 0.0f, 1.0f) * share_unit);
        if (share > 0) shares.push_back({moves[i], static_cast<std::uint16_t>(share)});
    }
    turn.share_count = static_cast<std::uint32_t>(shares.size()) - turn.first_share;
    turns.push_back(turn);
}

std::string to_bytes(const Game& game) {
    sanban::records::Game message;
    message.set_game(game.game);
    message.set_start(game.start);
    message.set_steps(game.steps);
    message.set_by_rollouts(game.by_rollouts);
    message.set_ending(static_cast<sanban::records::Ending>(game.ending));
    message.set_outcome(number_of(game.outcome));
    message.set_lead_halves(static_cast<int>(std::lround(game.lead * 2)));
    for (const auto owner : game.owners)
        message.mutable_owners()->push_back(static_cast<char>(owner < 0 ? 2 : owner));
    add_turns(game, message);
    return message.SerializeAsString();
}

Game from_bytes(std::string_view bytes) {
    sanban::records::Game message;
    if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
        engine::fail("not the record of a game");
    check_lists(message);
    Game game;
    game.game = message.game();
    game.start = message.start();
    game.steps = message.steps();
    game.by_rollouts = message.by_rollouts();
    if (!sanban::records::Ending_IsValid(message.ending()))
        engine::fail("a record with an ending of kind {}", static_cast<int>(message.ending()));
    game.ending = static_cast<Ending>(message.ending());
    game.outcome = outcome_from(message.outcome());
    game.lead = static_cast<float>(message.lead_halves()) / 2;
    for (const char owner : message.owners())
        game.owners.push_back(static_cast<std::int8_t>(owner == 2 ? -1 : owner == 1 ? 1 : 0));
    read_turns(message, game);
    return game;
}

std::string describe(const Game& game) {
    const std::string_view winner = game.outcome == engine::Outcome::draw         ? "nobody"
                                    : game.outcome == engine::Outcome::first_wins ? "first player"
                                                                                  : "second player";
    const auto taught = std::count_if(game.turns.begin(), game.turns.end(),
                                      [](const Turn& turn) { return turn.share_count > 0; });
    const auto network = game.by_rollouts ? std::string("none, by rollouts")
                                          : fmt::format("{} training steps", game.steps);
    return fmt::format(
        "game         {}\nstart        {}\nturns        {}, {} with a policy target\n"
        "won by       {} ({}), lead {:+.1f}\nnetwork      {}\n",
        game.game, game.start, game.turns.size(), taught, winner, name_of(game.ending), game.lead,
        network);
}

}  // namespace selfplay::records
