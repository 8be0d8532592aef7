#include "selfplay/alphago/policy_games.h"

#include <algorithm>

#include "selfplay/training/settings.h"
#include "selfplay/training/terms.h"

namespace selfplay::alphago {

namespace {

using PolicyMover = search::PolicyPlayer<go::Go>;

Playing begun(const training::ActorSettings& settings, int number, std::uint64_t seed) {
    engine::Random random(seed);
    Playing playing{training::first_position<go::Go>(settings, random), {}, number, seed};
    playing.record.game = go::Go::name;
    playing.record.start = playing.game.to_text();
    return playing;
}

// The games of one worker.
class Table {
   public:
    Table(const training::ActorSettings& settings, const Networks& networks, const Plan& plan)
        : settings_(settings), plan_(plan) {
        for (const auto& network : networks) players_.emplace_back(network);
    }

    void play(std::span<Playing> games) {
        if (games.empty()) return;
        engine::Random random(games[0].seed + 1);
        while (advance(games, random)) {
        }
        for (auto& playing : games) training::write_result(playing.game, playing.record);
    }

   private:
    bool is_over(const Playing& playing) const {
        return playing.game.outcome() != engine::Outcome::ongoing ||
               playing.game.move_count() >= training::move_limit(settings_, playing.game);
    }

    // The uniform policy, then the networks.
    static std::size_t place_of(int policy) {
        const int place = policy + 1;
        return static_cast<std::size_t>(place);
    }

    // A move in every game that goes on; false when none does.
    bool advance(std::span<Playing> games, engine::Random& random) {
        std::vector<std::vector<Playing*>> movers(players_.size() + 1);
        for (auto& playing : games)
            if (!is_over(playing)) movers[place_of(plan_.policy_of(playing))].push_back(&playing);
        for (auto* playing : movers[0]) {
            const auto moves = PolicyMover::sensible(playing->game);
            move(*playing, moves[random.below(moves.size())]);
        }
        for (std::size_t i = 0; i < players_.size(); ++i) draw(movers[i + 1], players_[i], random);
        return std::any_of(movers.begin(), movers.end(),
                           [](const auto& list) { return !list.empty(); });
    }

    void draw(const std::vector<Playing*>& games, PolicyMover& player, engine::Random& random) {
        std::vector<const go::Go*> positions;
        positions.reserve(games.size());
        for (const auto* playing : games) positions.push_back(&playing->game);
        const auto moves = player.draw(positions, random);
        for (std::size_t i = 0; i < games.size(); ++i) move(*games[i], moves[i]);
    }

    void move(Playing& playing, engine::Move played) {
        const float all = 1;
        if (plan_.teaches(playing))
            playing.record.add(played, 0, 1, {&played, 1}, {&all, 1});
        else
            playing.record.add(played, 0, 1, {}, {});
        playing.game.play(played);
    }

    const training::ActorSettings& settings_;
    const Plan& plan_;
    std::vector<PolicyMover> players_;
};

}  // namespace

std::vector<Playing> play_games(int count, int size, std::uint64_t seed, const Networks& networks,
                                const Plan& plan, nn::training::Workers& workers) {
    constexpr int together = 16;
    const auto settings = training::preset_settings("laptop", go::Go::name, size).actors;
    std::vector<Playing> games;
    games.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        games.push_back(begun(settings, i, engine::mixed(seed, static_cast<std::uint64_t>(i))));
    workers.run([&](int worker) {
        Table table(settings, networks, plan);
        for (int from = worker * together; from < count; from += workers.count() * together)
            table.play(std::span(games).subspan(
                static_cast<std::size_t>(from),
                static_cast<std::size_t>(std::min(together, count - from))));
    });
    return games;
}

float result_for(const records::Game& record, engine::Player player) {
    return engine::value_for(player, record.outcome);
}

std::shared_ptr<const search::Network> playing_network(nn::Graph graph) {
    return std::make_shared<const search::Network>(std::move(graph), nn::Precision::bf16);
}

}  // namespace selfplay::alphago
