#include "selfplay/alphago/expert_games.h"

#include <algorithm>
#include <optional>

#include "engine/base/error.h"
#include "engine/go/sgf.h"
#include "selfplay/records/files_behind.h"

namespace selfplay::alphago {

namespace {

namespace fs = std::filesystem;

bool is_sgf(const fs::path& path) {
    const auto name = path.filename().string();
    const auto ends = [&](std::string_view end) { return name.ends_with(end); };
    return ends(".sgf") || ends(".sgfs") || ends(".sgf.gz") || ends(".sgfs.gz");
}

ExpertGame game_of(const go::sgf::Record& record) {
    ExpertGame game{record.start.size(), record.start.komi(), {}, go::sgf::outcome_of(record)};
    for (const auto& turn : record.turns) game.moves.push_back(turn.move.code);
    while (!game.moves.empty() && game.moves.back() == go::Go::pass.code) game.moves.pop_back();
    return game;
}

// Empty, and counted, when the game is left out.
std::optional<ExpertGame> selected(const go::sgf::Tree& tree, const ExpertSelection& selection,
                                   ExpertCounts& counts) {
    const auto record = go::sgf::main_line(tree);
    const auto count = [](std::uint64_t& number) {
        ++number;
        return std::nullopt;
    };
    if (record.start.size() != selection.size) return count(counts.other_size);
    if (!go::sgf::is_even(record)) return count(counts.handicap);
    auto game = game_of(record);
    if (game.moves.size() < static_cast<std::size_t>(selection.least_moves))
        return count(counts.brief);
    if (selection.finished && game.outcome == engine::Outcome::ongoing)
        return count(counts.unfinished);
    return game;
}

class Reading {
   public:
    explicit Reading(const ExpertSelection& selection) : selection_(selection) {}

    void read(const fs::path& path) {
        const auto text = go::sgf::read_file(path);
        go::sgf::GameReader reader(text);
        while (!enough() && read_next(reader)) {
        }
    }
    bool enough() const {
        return selection_.most_games > 0 &&
               games_.counts.kept >= static_cast<std::uint64_t>(selection_.most_games);
    }
    ExpertGames take() { return std::move(games_); }

   private:
    bool read_next(go::sgf::GameReader& reader) {
        auto& counts = games_.counts;
        try {
            const auto tree = reader.next();
            if (!tree) return false;
            if (auto game = selected(*tree, selection_, counts)) keep(*std::move(game));
        } catch (const engine::Error&) {
            ++counts.broken;
        }
        ++counts.games;
        return true;
    }

    void keep(ExpertGame game) {
        constexpr std::uint64_t held_out_of = 10;
        auto& counts = games_.counts;
        game.moves.shrink_to_fit();
        counts.positions += game.moves.size();
        auto& list = ++counts.kept % held_out_of == 0 ? games_.held_out : games_.lessons;
        list.push_back(std::move(game));
    }

    ExpertSelection selection_;
    ExpertGames games_;
};

}  // namespace

std::vector<fs::path> sgf_files(std::span<const fs::path> paths) {
    return records::files_behind<fs::recursive_directory_iterator>(
        paths, [](const auto& entry) { return entry.is_regular_file() && is_sgf(entry.path()); });
}

ExpertGames read_expert_games(std::span<const fs::path> paths, const ExpertSelection& selection,
                              const Say& say) {
    Reading reading(selection);
    for (const auto& path : sgf_files(paths))
        if (!reading.enough()) reading.read(path);
    auto games = reading.take();
    const auto& counts = games.counts;
    say(fmt::format(
        "{} games, {} kept with {} positions; left out: {} of handicap or out of turn, "
        "{} of under {} moves, {} of another size, {} broken{}",
        counts.games, counts.kept, counts.positions, counts.handicap, counts.brief,
        selection.least_moves, counts.other_size, counts.broken,
        selection.finished ? fmt::format(", {} without a result", counts.unfinished) : ""));
    if (games.held_out.empty())
        engine::fail("expected 10 games on {0}x{0} or more to learn from, found {1}",
                     selection.size, counts.kept);
    return games;
}

ExpertPositions::ExpertPositions(const std::vector<ExpertGame>& games) : games_(games) {
    ends_.reserve(games.size());
    std::uint64_t end = 0;
    for (const auto& game : games) ends_.push_back(end += game.moves.size());
}

ExpertPlace ExpertPositions::operator[](std::uint64_t number) const {
    const auto found = std::upper_bound(ends_.begin(), ends_.end(), number);
    const auto& game = games_[static_cast<std::size_t>(found - ends_.begin())];
    return {&game, game.moves.size() - static_cast<std::size_t>(*found - number)};
}

ExpertPlace ExpertPositions::draw(engine::Random& random) const {
    return (*this)[random() % count()];
}

go::Go start_of(const ExpertGame& game) { return go::Go(game.size, game.komi); }

records::Game record_of(const ExpertPlace& place) {
    records::Game record;
    record.game = go::Go::name;
    record.start = start_of(*place.game).to_text();
    record.outcome = place.game->outcome;
    for (std::size_t i = 0; i <= place.turn; ++i) {
        const engine::Move move{place.game->moves[i]};
        const float all = 1;
        if (i == place.turn)
            record.add(move, 0, 0, {&move, 1}, {&all, 1});
        else
            record.add(move, 0, 0, {}, {});
    }
    return record;
}

}  // namespace selfplay::alphago
