// `sanban show FILE`: what a weight file or a file of self-play games is, or what is wrong with it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "nn/describe.h"
#include "nn/load.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "selfplay/records/export.h"

namespace protocols {

namespace {

namespace records = selfplay::records;

void show_game(const std::vector<records::Game>& games, std::size_t number) {
    if (number > games.size()) engine::fail("--game {}: there are {} games", number, games.size());
    const auto& game = games[number - 1];
    fmt::print("{}\n{}", records::describe(game), records::turns_text(game));
}

// The counts, then a line a game.
void list_games(const std::vector<records::Game>& games) {
    std::size_t turns = 0, taught = 0;
    for (const auto& game : games) {
        turns += game.turns.size();
        for (const auto& turn : game.turns) taught += turn.share_count > 0;
    }
    fmt::print("{} games, {} positions, {} of them with a policy target\n", games.size(), turns,
               taught);
    for (std::size_t i = 0; i < games.size(); ++i)
        fmt::print("{:6} {}\n", i + 1, records::summary(games[i]));
}

void show_games(const std::string& path, std::size_t number) {
    std::vector<std::string> damage;
    const auto games = records::read_games(path, damage);
    for (const auto& line : damage) fmt::print(stderr, "{}\n", line);
    if (number > 0) return show_game(games, number);
    list_games(games);
}

}  // namespace

int run_show(Arguments arguments) {
    std::string path;
    std::size_t game = 0;
    CLI::App app("Says what a file holds, or what is wrong with it", "sanban show");
    app.add_option("FILE", path,
                   "a network of sanban, KataGo, lc0 or Leela Zero; a file or folder of self-play "
                   "games")
        ->required();
    app.add_option("--game", game, "of self-play games: this one, move by move, from 1");
    if (const auto status = parse_flags(app, arguments)) return *status;
    if (records::holds_games(path))
        show_games(path, game);
    else
        fmt::print("{}", nn::describe(nn::load(path)));
    return 0;
}

}  // namespace protocols
