// `sanban convert IN OUT`: foreign weights and foreign games to our own formats, self-play games to
// those that others read.
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
#include "selfplay/records/import.h"
#include "selfplay/records/segment.h"

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

void import_texts(const std::vector<std::filesystem::path>& files, const std::string& out) {
    records::Archive archive(out);
    if (!archive.segments().empty()) engine::fail("{}: holds games already", out);
    const auto counts = records::import_games(files, [&](auto games) { archive.append(games); });
    fmt::print("{}: {} games; left out: {} without a result, {} uneven, {} broken\n", out,
               counts.kept, counts.unfinished, counts.uneven, counts.broken);
}

}  // namespace

int run_convert(Arguments arguments) {
    std::string in, out;
    records::ArraySettings arrays;
    CLI::App app(
        "Writes a network as safetensors, self-play games for other programs, or games by others "
        "to learn from",
        "sanban convert");
    app.add_option("IN", in,
                   "a network of sanban, KataGo, lc0 or Leela Zero; a file or folder of self-play "
                   "games; .pgn, .csa, .kif or .sgf, plain or .gz, or a folder of them")
        ->required();
    app.add_option("OUT", out,
                   "our own format; of self-play games .sgf, .pgn, .csa, or .npz for NumPy; of "
                   "games by others a folder for `sanban learn`")
        ->required();
    app.add_option("--encoding", arrays.encoding,
                   "npz: what planes and policy are; alphazero unless given");
    app.add_option("--size", arrays.board, "npz: take the games on Go boards of this size only");
    if (const auto status = parse_flags(app, arguments)) return *status;
    if (const auto texts = records::texts_behind(in); !texts.empty())
        import_texts(texts, out);
    else if (records::holds_games(in))
        convert_games(in, out, arrays);
    else
        convert_network(in, out);
    return 0;
}

}  // namespace protocols
