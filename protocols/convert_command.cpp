// `sanban convert IN OUT`: foreign weights to our own format, self-play games to formats that
// others read.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/games.h"
#include "nn/load.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "search/load_network.h"
#include "selfplay/records/arrays.h"
#include "selfplay/records/export.h"

namespace protocols {

namespace {

namespace records = selfplay::records;

void convert_network(const std::string& in, const std::string& out) {
    const auto contents = nn::load_contents(in);
    const auto& graph = contents.graph;
    nn::Calibration calibration;
    if (!graph.facts.game.empty())
        calibration = engine::Games::visit(
            graph.facts.game, [&]<class G>() { return search::calibration_of<G>(contents); });
    nn::save(graph, out, calibration);
    fmt::print("{}: {} parameters for {} ({})\n", out, nn::parameter_count(graph), graph.facts.game,
               graph.facts.encoding);
}

void write_texts(const std::vector<records::Game>& games, const std::filesystem::path& out) {
    std::string text;
    for (std::size_t i = 0; i < games.size(); ++i) {
        const auto extension = records::text_extension(games[i].game);
        if (out.extension() != fmt::format(".{}", extension))
            engine::fail("{}: games of {} become .{} or .npz", out.string(), games[i].game,
                         extension);
        text += records::to_text(games[i], static_cast<int>(i));
    }
    engine::write_file(out, text);
    fmt::print("{}: {} games\n", out.string(), games.size());
}

void convert_games(const std::string& in, const std::filesystem::path& out,
                   const records::ArraySettings& settings) {
    std::vector<std::string> damage;
    const auto games = records::read_games(in, damage);
    for (const auto& line : damage) fmt::print(stderr, "{}\n", line);
    if (out.extension() != ".npz") return write_texts(games, out);
    const auto summary = records::write_arrays(games, settings, out);
    fmt::print("{}: {} positions of {} games, {} with a policy target\n", out.string(),
               summary.positions, summary.games, summary.taught);
}

}  // namespace

int run_convert(Arguments arguments) {
    std::string in, out;
    records::ArraySettings arrays;
    CLI::App app("Writes a network as safetensors, or self-play games for other programs",
                 "sanban convert");
    app.add_option("IN", in,
                   "a network of sanban, KataGo, lc0 or Leela Zero; a file or folder of self-play "
                   "games")
        ->required();
    app.add_option("OUT", out, "our own format; of games .sgf, .pgn, .csa, or .npz for NumPy")
        ->required();
    app.add_option("--encoding", arrays.encoding,
                   "npz: what planes and policy are; alphazero unless given");
    app.add_option("--size", arrays.board, "npz: take the games on Go boards of this size only");
    if (const auto status = parse_flags(app, arguments)) return *status;
    if (records::holds_games(in))
        convert_games(in, out, arrays);
    else
        convert_network(in, out);
    return 0;
}

}  // namespace protocols
