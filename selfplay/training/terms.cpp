#include "selfplay/training/terms.h"

#include <algorithm>
#include <cmath>

#include "engine/go/score.h"
#include "selfplay/training/chance.h"
#include "selfplay/training/scatter.h"

namespace selfplay::training {

namespace {

constexpr int usual_move_limit = 512;  // AlphaZero's, of chess and shogi

go::Rules self_play_rules() {
    go::Rules rules;
    rules.ko = go::Ko::positional;
    rules.friendly_pass = false;
    return rules;
}

int limit_or(const ActorSettings& settings, int otherwise) {
    return settings.move_limit > 0 ? settings.move_limit : otherwise;
}

int draw_size(const ActorSettings& settings, engine::Random& random) {
    const int smaller = settings.least_size > 0 ? settings.size - settings.least_size : 0;
    if (smaller == 0 || !happens(random, settings.small_share)) return settings.size;
    return settings.least_size + random.below(smaller);
}

template <class G>
void write_outcome(const G& game, records::Game& record) {
    const auto outcome = game.outcome();
    record.outcome = outcome == engine::Outcome::ongoing ? engine::Outcome::draw : outcome;
}

}  // namespace

template <>
go::Go first_position<go::Go>(const ActorSettings& settings, engine::Random& random) {
    const int size = draw_size(settings, random);
    const double shift = static_cast<double>(settings.komi_deviation) * search::normal(random);
    const int halves =
        static_cast<int>(std::lround(settings.komi * 2)) + 2 * static_cast<int>(std::lround(shift));
    return go::Go(size, go::Komi::from_halves(halves), self_play_rules());
}
template <>
chess::Chess first_position<chess::Chess>(const ActorSettings& settings, engine::Random& random) {
    return happens(random, settings.scattered_share) ? scattered_chess(random) : chess::Chess();
}
template <>
shogi::Shogi first_position<shogi::Shogi>(const ActorSettings&, engine::Random&) {
    return {};
}

int move_limit(const ActorSettings& settings, const go::Go& game) {
    return limit_or(settings, 2 * game.size() * game.size());
}
int move_limit(const ActorSettings& settings, const chess::Chess&) {
    return limit_or(settings, usual_move_limit);
}
int move_limit(const ActorSettings& settings, const shogi::Shogi&) {
    return limit_or(settings, usual_move_limit);
}

int typical_moves(const go::Go& game) { return game.size() * game.size() + 1; }
int typical_moves(const chess::Chess&) { return 40; }
int typical_moves(const shogi::Shogi&) { return 120; }

int board_of(const go::Go& game) { return game.size(); }
int board_of(const chess::Chess&) { return 0; }
int board_of(const shogi::Shogi&) { return 0; }

void write_result(const go::Go& game, records::Game& record) {
    const auto score = go::score(game);
    record.outcome = game.no_result() ? engine::Outcome::draw : score.outcome();
    record.lead = static_cast<float>(score.lead_halves) / 2;
    record.owners.clear();
    for (const auto& owner : score.owners)
        record.owners.push_back(static_cast<std::int8_t>(!owner                            ? 0
                                                         : *owner == engine::Player::first ? 1
                                                                                           : -1));
}
void write_result(const chess::Chess& game, records::Game& record) { write_outcome(game, record); }
void write_result(const shogi::Shogi& game, records::Game& record) { write_outcome(game, record); }

}  // namespace selfplay::training
