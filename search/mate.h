// Forced mates, by depth-first proof-number search (Nagai 2002) within a number of plies that
// grows until a mate is proved, none is possible, or a limit ends it. It searches positions
// without a past: a repetition only makes a mate longer, so what is proved is a mate, though a
// draw might be claimed on the way to it.
//
// Any game will do whose `position()` has key() and what engine/forced_mate.h asks for.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/forced_mate.h"
#include "engine/game.h"
#include "search/clock.h"
#include "search/mate_table.h"
#include "search/relaxed.h"

namespace search {

struct MateLimits {
    int plies = 255;           // of the longest mate looked for: 2 * moves - 1; at most 255
    bool checks_only = false;  // every move of the attacker gives check, as in shogi's problems
    std::optional<std::uint64_t> nodes;
    std::optional<Milliseconds> time;
    const std::atomic<bool>* stop = nullptr;
    std::size_t table_bytes = std::size_t{64} << 20;
};

// The part of a memory budget that is left to a mate search beside a tree search: a sixteenth, as
// long as that is useful.
constexpr int mate_mebibytes(int memory_mib) { return std::min(memory_mib / 16, 64); }

struct MateResult {
    enum class Answer : std::uint8_t { mate, no_mate, unknown };
    Answer answer = Answer::unknown;
    // Of a mate: every move of both players, the defender's being the longest ones. Of an odd
    // length; shortest if the attacker gives check all the way.
    std::vector<engine::Move> line;
    std::uint64_t nodes = 0;
};

namespace mate {

// The proof and disproof numbers of a node as its mover sees them: how many leaves must still be
// won for it to reach, and to lose, what it is after.
struct Numbers {
    std::uint32_t win = 1, loss = 1;
};
inline constexpr std::uint32_t infinity = 1U << 30;

// How much of a search for any mate may go into the search for one by checks alone.
inline constexpr std::uint64_t most_nodes_of_checks = 1'000'000;

// Ends a search by nodes, time or from outside.
class Watch {
   public:
    // `limits` must outlive the watch.
    explicit Watch(const MateLimits& limits) : limits_(limits) {}

    std::uint64_t nodes() const { return nodes_; }
    bool over() const { return over_; }
    // To be called at every node; looks at the clock now and then.
    void count();
    // An earlier end for the first part of a search: this many nodes, or half of all.
    void end_part_at(std::uint64_t nodes);
    void begin_last_part();
    // Once a mate is proved only a stop from outside counts.
    void unlimit();

   private:
    using Clock = std::chrono::steady_clock;
    bool out_of_nodes() const;
    bool out_of_time() const;
    bool stopped() const { return limits_.stop && limits_.stop->load(relaxed); }

    const MateLimits& limits_;
    Clock::time_point start_ = Clock::now();
    std::optional<std::uint64_t> part_;
    std::uint64_t nodes_ = 0;
    bool over_ = false, unlimited_ = false;
};

// One kind of attack (checks only, or any moves) on one position.
template <class Position>
class Search {
   public:
    // `table` and `watch` must outlive the search.
    Search(MateTable& table, Watch& watch, bool checks_only)
        : table_(table), watch_(watch), checks_only_(checks_only) {}

    struct Verdict {
        bool mate = false;
        bool final = false;  // no mate at any depth
    };
    // Whether there is a mate in `plies`; meaningless when the watch is over.
    Verdict prove(const Position& position, int plies);

    // The moves of a mate in `plies` that prove() has found.
    std::vector<engine::Move> line(Position position, int plies);

   private:
    // A node at whose mover `plies` are left has the attacker to move when they are odd.
    static bool attacks(int plies) { return plies % 2 == 1; }

    struct Found {
        Numbers numbers;
        bool final = false;  // lost for the attacker however deep one looks
    };
    struct Child {
        engine::Move move;
        Found found;
    };
    struct Choice {
        Numbers numbers;       // of the parent
        std::size_t best = 0;  // in children_
        std::uint32_t second_loss = infinity;
        bool final = false;
    };

    Found visit(const Position& position, int plies, Numbers thresholds);
    void expand(const Position& position, int plies);
    Choice choose(std::size_t begin, int plies) const;
    Found look_up(const Position& position, int plies) const;
    Found defence(const Position& position, int plies) const;
    std::optional<Found> settled(const Position& position, int plies) const;
    void store(const Position& position, int plies, const Choice& choice, std::uint64_t work);
    void settle(const Position& position, int plies, const Choice& choice, std::uint32_t work);
    std::optional<int> shortest(const Position& position, int plies);
    bool play_longest_defence(Position& position, int& plies, std::vector<engine::Move>& line);

    // How the defender sees it.
    static constexpr Found mated() { return {{infinity, 0}, false}; }
    static constexpr Found escaped(bool final) { return {{0, infinity}, final}; }

    // Under the first key a position's numbers at one depth; under the second, one more than the
    // fewest plies that were proved (`first`) and the most that were disproved (`second`) enough.
    std::uint64_t key_at(const Position& position, int plies) const {
        return (key_of(position) + static_cast<std::uint64_t>(plies) + 1) * 0x9e3779b97f4a7c15;
    }
    std::uint64_t key_of(const Position& position) const {
        return (position.key() ^ (checks_only_ ? 0x5555555555555555 : 0)) * 0xbf58476d1ce4e5b9;
    }
    static constexpr std::uint32_t every_depth = 1000;

    MateTable& table_;
    Watch& watch_;
    const bool checks_only_;
    std::vector<Child> children_;  // of all nodes on the path, one behind the other
};

template <class Position>
auto Search<Position>::prove(const Position& position, int plies) -> Verdict {
    const auto known = look_up(position, plies);
    const auto found = known.numbers.win == 0 || known.numbers.loss == 0
                           ? known
                           : visit(position, plies, {infinity, infinity});
    return {found.numbers.win == 0, found.final};
}

template <class Position>
auto Search<Position>::visit(const Position& position, int plies, Numbers thresholds) -> Found {
    const auto begin = children_.size();
    const auto nodes_before = watch_.nodes();
    watch_.count();
    expand(position, plies);
    Choice choice = choose(begin, plies);
    while (choice.numbers.win < thresholds.win && choice.numbers.loss < thresholds.loss &&
           !watch_.over()) {
        const Child child = children_[choice.best];
        const Position next = engine::after(position, child.move);
        const Numbers own = choice.numbers, its = child.found.numbers;
        // A quarter more than the second best, or the search would go to and fro between them.
        const auto patience = choice.second_loss + choice.second_loss / 4 + 1;
        children_[choice.best].found =
            visit(next, plies - 1,
                  {std::min(infinity, thresholds.loss - own.loss + its.win),
                   std::min(thresholds.win, patience)});
        choice = choose(begin, plies);
    }
    if (!watch_.over()) store(position, plies, choice, watch_.nodes() - nodes_before);
    children_.resize(begin);
    return {choice.numbers, choice.final};
}

template <class Position>
void Search<Position>::expand(const Position& position, int plies) {
    // The last move must mate, so it must give check.
    const bool must_check = attacks(plies) && (checks_only_ || plies == 1);
    for (const engine::Move move :
         must_check ? engine::checks_of(position) : engine::moves_of(position))
        children_.push_back({move, look_up(engine::after(position, move), plies - 1)});
}

// A node wins by one child that loses, and loses when all of them win.
template <class Position>
auto Search<Position>::choose(std::size_t begin, int plies) const -> Choice {
    Choice choice{{infinity, 0}, begin};
    bool all_final = true, any_final = false;
    for (std::size_t i = begin; i < children_.size(); ++i) {
        const auto& found = children_[i].found;
        if (found.numbers.loss < choice.numbers.win) {
            choice.second_loss = std::exchange(choice.numbers.win, found.numbers.loss);
            choice.best = i;
        } else {
            choice.second_loss = std::min(choice.second_loss, found.numbers.loss);
        }
        choice.numbers.loss = std::min(choice.numbers.loss + found.numbers.win, infinity - 1);
        all_final &= found.final;
        any_final |= found.final;
    }
    if (choice.numbers.win == 0) choice.numbers.loss = infinity;
    // Any move might start a longer mate, so that leaving some out at the last ply is not final.
    const bool complete = checks_only_ || plies > 1;
    choice.final = attacks(plies) ? all_final && complete : any_final;
    return choice;
}

template <class Position>
auto Search<Position>::look_up(const Position& position, int plies) const -> Found {
    if (const auto known = settled(position, plies)) return *known;
    if (const auto* entry = table_.find(key_at(position, plies)))
        return {{entry->first, entry->second}, false};
    return attacks(plies) ? Found{} : defence(position, plies);
}

// A defender not seen before: the more answers, the harder to mate.
template <class Position>
auto Search<Position>::defence(const Position& position, int plies) const -> Found {
    const auto answers = static_cast<std::uint32_t>(engine::moves_of(position).size());
    if (answers == 0) return position.in_check() ? mated() : escaped(true);
    return plies == 0 ? escaped(false) : Found{{1, answers}, false};
}

// What is proved or disproved of the position.
template <class Position>
auto Search<Position>::settled(const Position& position, int plies) const -> std::optional<Found> {
    const auto* entry = table_.find(key_of(position));
    if (!entry) return std::nullopt;
    const auto depth = static_cast<std::uint32_t>(plies) + 1;
    if (entry->first != 0 && entry->first <= depth)
        return attacks(plies) ? Found{{0, infinity}, false} : mated();
    if (entry->second < depth) return std::nullopt;
    const bool final = entry->second == every_depth;
    return attacks(plies) ? Found{{infinity, 0}, final} : escaped(final);
}

template <class Position>
void Search<Position>::store(const Position& position, int plies, const Choice& choice,
                             std::uint64_t work) {
    const auto cost = static_cast<std::uint32_t>(std::min<std::uint64_t>(work, infinity));
    if (choice.numbers.win == 0 || choice.numbers.loss == 0)
        return settle(position, plies, choice, cost);
    auto& entry = table_.at(key_at(position, plies));
    entry.first = choice.numbers.win;
    entry.second = choice.numbers.loss;
    entry.work = std::max(entry.work, cost);
}

template <class Position>
void Search<Position>::settle(const Position& position, int plies, const Choice& choice,
                              std::uint32_t work) {
    auto& entry = table_.at(key_of(position));
    entry.work = std::max(entry.work, work);
    const auto depth = static_cast<std::uint32_t>(plies) + 1;
    const bool mover_wins = choice.numbers.win == 0;
    if (mover_wins != attacks(plies)) {
        entry.second = std::max(entry.second, choice.final ? every_depth : depth);
    } else if (entry.first == 0 || depth < entry.first) {
        entry.first = depth;
        if (mover_wins) entry.move = children_[choice.best].move;
    }
}

template <class Position>
std::optional<int> Search<Position>::shortest(const Position& position, int plies) {
    for (int fewer = 1; fewer <= plies && !watch_.over(); fewer += 2)
        if (prove(position, fewer).mate) return fewer;
    return std::nullopt;
}

// Plays the answer that puts off the mate longest and says how many plies are left then; false
// when there is none.
template <class Position>
bool Search<Position>::play_longest_defence(Position& position, int& plies,
                                            std::vector<engine::Move>& line) {
    std::optional<Position> latest;
    int longest = 0;
    for (const engine::Move move : engine::moves_of(position)) {
        const Position next = engine::after(position, move);
        const int left = shortest(next, plies).value_or(0);
        if (left <= longest) continue;
        if (latest) line.pop_back();
        line.push_back(move);
        latest = next;
        longest = left;
    }
    if (!latest) return false;
    position = *latest;
    plies = longest;
    return true;
}

template <class Position>
std::vector<engine::Move> Search<Position>::line(Position position, int plies) {
    std::vector<engine::Move> line;
    while (const auto left = shortest(position, plies)) {
        const auto* entry = table_.find(key_of(position));
        if (!entry || entry->first == 0) break;
        line.push_back(entry->move);
        position.play(entry->move);
        plies = *left - 2;
        if (!play_longest_defence(position, plies, line)) break;
    }
    return line;
}

// Longer and longer mates by one kind of attack.
template <class Position>
MateResult deepen(const Position& position, const MateLimits& limits, MateTable& table,
                  Watch& watch, bool checks_only) {
    Search<Position> search(table, watch, checks_only);
    for (int plies = 1; plies <= limits.plies; plies += 2) {
        const auto verdict = search.prove(position, plies);
        if (watch.over()) return {};
        if (verdict.mate) {
            watch.unlimit();
            return {MateResult::Answer::mate, search.line(position, plies), 0};
        }
        if (verdict.final) break;
    }
    return {MateResult::Answer::no_mate, {}, 0};
}

}  // namespace mate

// Blocks until the answer is known or a limit is reached. Looks first for a mate by checks, then,
// unless only these count, for one by any moves. No mate means: none within limits.plies.
template <engine::Game G>
MateResult find_mate(const G& game, const MateLimits& limits) {
    MateTable table(limits.table_bytes);
    mate::Watch watch(limits);
    if (!limits.checks_only) watch.end_part_at(mate::most_nodes_of_checks);
    auto result = mate::deepen(game.position(), limits, table, watch, true);
    if (!limits.checks_only && result.answer != MateResult::Answer::mate) {
        watch.begin_last_part();
        result = mate::deepen(game.position(), limits, table, watch, false);
    }
    result.nodes = watch.nodes();
    return result;
}

}  // namespace search
