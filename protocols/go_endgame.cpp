#include "protocols/go_endgame.h"

#include <algorithm>
#include <utility>

namespace protocols {

namespace {

using engine::Player;
using go::Go;
using go::Point;

// A chain lives when most games played out leave it to its owner. The games are played by a policy
// so weak that a chain alive beyond doubt may have no more than this.
constexpr float doubtful = 0.2f;
// A pass keeps a win, or gives up nothing, where the search says so too.
constexpr double still_wins = 0.6, cannot_win = 0.3;
// Shared liberties of a seki are few.
constexpr std::size_t most_seki_liberties = 4;

std::size_t order(const Go& game, Point point) {
    const int order = point.y * game.size() + point.x;
    return static_cast<std::size_t>(order);
}

std::vector<Point> all_points(const Go& game) {
    std::vector<Point> points;
    for (int y = 0; y < game.size(); ++y)
        for (int x = 0; x < game.size(); ++x) points.push_back({x, y});
    return points;
}

std::vector<Point> beside(const Go& game, Point point) {
    std::vector<Point> found;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const Point next{point.x + dx, point.y + dy};
        if (next.x >= 0 && next.y >= 0 && next.x < game.size() && next.y < game.size())
            found.push_back(next);
    }
    return found;
}

std::vector<bool> none_seen(const Go& game) {
    const auto size = static_cast<std::size_t>(game.size());
    return std::vector<bool>(size * size);
}

// `start` and all points connected with it through points that `joins`.
template <class Joins>
std::vector<Point> region(const Go& game, Point start, std::vector<bool>& seen, Joins joins) {
    std::vector<Point> points{start};
    seen[order(game, start)] = true;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (const Point next : beside(game, points[i])) {
            if (seen[order(game, next)] || !joins(next)) continue;
            seen[order(game, next)] = true;
            points.push_back(next);
        }
    return points;
}

template <class Joins>
std::vector<Point> region(const Go& game, Point start, Joins joins) {
    auto seen = none_seen(game);
    return region(game, start, seen, joins);
}

// Calls visit(chain) for each chain on the board.
template <class Visit>
void for_each_chain(const Go& game, Visit visit) {
    auto seen = none_seen(game);
    for (const Point point : all_points(game)) {
        const auto stone = game.at(point);
        if (!stone || seen[order(game, point)]) continue;
        visit(region(game, point, seen, [&](Point next) { return game.at(next) == stone; }));
    }
}

bool any_beside(const Go& game, const std::vector<Point>& points, const auto& holds) {
    return std::any_of(points.begin(), points.end(), [&](Point point) {
        const auto around = beside(game, point);
        return std::any_of(around.begin(), around.end(), holds);
    });
}

int liberties(const Go& game, Point stone) {
    return game.board().liberties(game.board().index(stone.x, stone.y));
}

// A stone that would not be taken at once, or takes something itself.
bool is_safe(const Go& game, Point point) {
    const go::Move move = game.move_at(point);
    if (!game.legal(move) || game.fills_own_eye(move)) return false;
    Go after = game;
    after.play(move);
    const bool takes = after.captured_by(game.to_play()) > game.captured_by(game.to_play());
    return takes || (after.at(point) && liberties(after, point) >= 2);
}

std::vector<go::Move> safe_moves(const Go& game, const std::vector<Point>& points) {
    std::vector<go::Move> moves;
    for (const Point point : points)
        if (!game.at(point) && is_safe(game, point)) moves.push_back(game.move_at(point));
    return moves;
}

// Liberties of the opponent's doomed stones.
std::vector<go::Move> capturing_moves(const Go& game, const Reading& reading) {
    std::vector<Point> points;
    for (const Point stone : reading.doomed()) {
        if (game.at(stone) == game.to_play()) continue;
        for (const Point point : beside(game, stone))
            if (std::find(points.begin(), points.end(), point) == points.end())
                points.push_back(point);
    }
    return safe_moves(game, points);
}

// Neutral points that can be filled without putting own stones at risk.
std::vector<go::Move> filling_moves(const Go& game, const Reading& reading) {
    std::vector<Point> points;
    for (const Point point : reading.neutral()) {
        const auto around = beside(game, point);
        const bool in_seki = std::any_of(around.begin(), around.end(), [&](Point next) {
            return game.at(next) && reading.status(next) == go::Status::seki;
        });
        if (!in_seki) points.push_back(point);
    }
    return safe_moves(game, points);
}

// How surely points are `owner`'s, over games with either side to move first.
struct Ownership {
    float least, most;
    float mean() const { return (least + most) / 2; }
    // Neither side's, whoever moves.
    bool open() const { return least > -doubtful && most < doubtful; }
    bool beyond_doubt() const {
        return least * most > 0 && (mean() > doubtful || mean() < -doubtful);
    }
};

Ownership ownership(const Go& game, const std::vector<Point>& points, Player owner,
                    const Looks& looks) {
    const float sign = owner == Player::first ? 1.0f : -1.0f;
    const auto mean = [&](const Look& look) {
        float sum = 0;
        for (const Point point : points) sum += sign * look.owners[order(game, point)];
        return sum / static_cast<float>(points.size());
    };
    const float first = mean(looks[0]), second = mean(looks[1]);
    return {std::min(first, second), std::max(first, second)};
}

struct Chain {
    std::vector<Point> stones;
    Ownership fate;
};

// The games played out do not see a seki: there either side may fall. Chains that are nobody's,
// whoever moves, and touch such chains of the other colour, lock each other in.
std::vector<bool> locked_chains(const Go& game, const std::vector<Chain>& chains) {
    auto open = none_seen(game);
    for (const auto& [stones, fate] : chains)
        for (const Point point : stones) open[order(game, point)] = fate.open();
    const auto is_open = [&](Point point) { return game.at(point) && open[order(game, point)]; };
    const auto is_liberty = [&](Point point) {
        return !game.at(point) && any_beside(game, {point}, is_open);
    };
    std::vector<bool> locked;
    for (const auto& [stones, fate] : chains) {
        const auto colour = game.at(stones.front());
        const auto is_other = [&](Point point) {
            return is_open(point) && game.at(point) != colour;
        };
        const auto cluster = region(
            game, stones.front(), [&](Point point) { return is_open(point) || is_liberty(point); });
        locked.push_back(fate.open() && std::any_of(cluster.begin(), cluster.end(), is_other));
    }
    return locked;
}

double share(Player player, float black_value) {
    return ((player == Player::first ? black_value : -black_value) + 1.0) / 2;
}

}  // namespace

bool is_emptier(const Go& game, double share) {
    const auto points = all_points(game);
    const auto empty =
        std::count_if(points.begin(), points.end(), [&](Point point) { return !game.at(point); });
    return static_cast<double>(empty) > share * static_cast<double>(points.size());
}

bool too_early_to_pass(const Go& game) { return game.size() >= 5 && is_emptier(game, 2.0 / 3); }

int lead_of(Player player, const go::Score& score) {
    return player == Player::first ? score.lead_halves : -score.lead_halves;
}

bool agrees_on_dead_stones(const go::Rules& rules) {
    return rules.friendly_pass || rules.scoring == go::Scoring::territory;
}

Reading::Reading(const Go& game, const Looks& looks)
    : game_(game), values_{looks[0].value, looks[1].value} {
    judge_chains(looks);
    if (agrees_on_dead_stones(game.rules())) dead_ = doomed_;
    score_ = go::score(game, dead_);
    played_out_ = go::score(game, doomed_);
    for (const Point point : all_points(game))
        if (!played_out_.owners[order(game, point)]) neutral_.push_back(point);
    settled_ = settled_ && borders_closed() && territory_agreed(looks);
}

void Reading::judge_chains(const Looks& looks) {
    std::vector<Chain> chains;
    for_each_chain(game_, [&](const std::vector<Point>& stones) {
        chains.push_back({stones, ownership(game_, stones, *game_.at(stones.front()), looks)});
    });
    const auto locked = locked_chains(game_, chains);
    for (std::size_t i = 0; i < chains.size(); ++i) {
        const auto& [stones, fate] = chains[i];
        if (locked[i]) continue;
        if (fate.mean() < 0) doomed_.insert(doomed_.end(), stones.begin(), stones.end());
        if (!fate.beyond_doubt()) settled_ = false;
    }
}

// Whether the games played out give each territory to whom the score does.
bool Reading::territory_agreed(const Looks& looks) const {
    const auto points = all_points(game_);
    return std::all_of(points.begin(), points.end(), [&](Point point) {
        const auto owner = played_out_.owners[order(game_, point)];
        if (!owner || game_.at(point)) return true;
        const auto fate = ownership(game_, {point}, *owner, looks);
        return fate.mean() > 0 && fate.beyond_doubt();
    });
}

double Reading::winrate_moving(Player player) const {
    return share(player, values_[player == Player::first ? 0 : 1]);
}

double Reading::winrate_passing(Player player) const {
    return share(player, values_[player == Player::first ? 1 : 0]);
}

bool Reading::borders_closed() const {
    const auto is_neutral = [&](Point point) { return !played_out_.owners[order(game_, point)]; };
    const auto is_living = [&](Point point) { return game_.at(point) && !is_neutral(point); };
    if (neutral_.size() > 2 * static_cast<std::size_t>(game_.size())) return false;
    return std::all_of(neutral_.begin(), neutral_.end(),
                       [&](Point point) { return any_beside(game_, {point}, is_living); });
}

go::Status Reading::status(Point point) const {
    const auto colour = game_.at(point);
    const auto owner_of = [&](Point at) { return score_.owners[order(game_, at)]; };
    if (owner_of(point) != colour) return go::Status::dead;
    const auto group = region(game_, point, [&](Point at) { return owner_of(at) == colour; });
    const auto territory =
        std::count_if(group.begin(), group.end(), [&](Point at) { return game_.at(at) != colour; });
    if (territory > 1) return go::Status::alive;
    const auto is_shared = [&](Point at) {
        if (owner_of(at) || game_.at(at)) return false;
        const auto liberty = region(game_, at, [&](Point next) { return !owner_of(next); });
        const auto is_enemy = [&](Point next) { return game_.at(next) == ~*colour; };
        return liberty.size() <= most_seki_liberties && any_beside(game_, liberty, is_enemy);
    };
    return any_beside(game_, group, is_shared) ? go::Status::seki : go::Status::alive;
}

std::vector<Point> Reading::stones(go::Status wanted) const {
    std::vector<Point> found;
    for_each_chain(game_, [&](const std::vector<Point>& chain) {
        if (status(chain.front()) == wanted) found.insert(found.end(), chain.begin(), chain.end());
    });
    return found;
}

Ending ending(const Go& game, const Reading& reading, bool clean_up) {
    const auto me = game.to_play();
    const bool agrees = agrees_on_dead_stones(game.rules()) && !clean_up;
    const bool wins_as_it_stands = lead_of(me, go::score(game)) > 0;
    // The opponent leaves us the last word.
    if (game.consecutive_passes() > 0 && !clean_up && wins_as_it_stands &&
        (!agrees || lead_of(me, reading.score()) > 0))
        return {true, {}};
    if (!reading.settled()) return {};
    if (!agrees) {
        auto captures = capturing_moves(game, reading);
        if (!captures.empty()) return {false, std::move(captures)};
    }
    const int lead = lead_of(me, reading.played_out());
    const int at_stake = 2 * static_cast<int>(reading.neutral().size());
    const bool wins = lead - at_stake > 0 && reading.winrate_passing(me) >= still_wins;
    const bool loses = lead + at_stake < 0 && reading.winrate_moving(me) <= cannot_win;
    const bool by_area =
        game.rules().scoring == go::Scoring::area && game.rules().tax == go::Tax::none;
    // Elsewhere neutral points beside territory spoil it.
    if (by_area && (wins || loses)) return {true, {}};
    auto fills = filling_moves(game, reading);
    if (!fills.empty()) return {false, std::move(fills)};
    return {!by_area || reading.neutral().empty(), {}};
}

}  // namespace protocols
