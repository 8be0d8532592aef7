// `sanban perft`: counts move by move, or checks a file of known counts.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/base/files.h"
#include "engine/base/option.h"
#include "engine/base/text.h"
#include "engine/games.h"
#include "engine/perft.h"
#include "protocols/commands.h"

namespace protocols {

namespace {

struct Request {
    std::string game;
    int depth = -1;
    std::vector<std::string> position;  // words
    std::string file;
};

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const auto end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == text.npos) return parts;
        text.remove_prefix(end + 1);
    }
}

template <engine::Game G>
int count_by_move(const Request& request) {
    std::string text;
    for (const auto& word : request.position) text += word + ' ';
    text = engine::trimmed(text);
    const G game = text.empty() ? G() : G::from_text(text);
    std::uint64_t nodes = request.depth == 0 ? 1 : 0;
    if (request.depth > 0)
        for (const engine::Move move : game.legal_moves()) {
            G next = game;
            next.play(move);
            const auto below = engine::perft(next, request.depth - 1);
            fmt::print("{} {}\n", game.move_to_text(move), below);
            nodes += below;
        }
    fmt::print("nodes {}\n", nodes);
    return 0;
}

// One line: "position ; D1 20 ; D2 400". Says on stderr which count is wrong.
template <engine::Game G>
bool passes(std::string_view line) {
    const auto parts = split(line, ';');
    const G game = G::from_text(engine::trimmed(parts[0]));
    if (parts.size() < 2) engine::fail("no counts behind the position");
    bool right = true;
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const auto words = split(engine::trimmed(parts[i]), ' ');
        if (words.size() != 2 || !words[0].starts_with('D'))
            engine::fail("\"{}\" is not like \"D1 20\"", engine::trimmed(parts[i]));
        const auto depth = engine::parse_number<int>(words[0].substr(1));
        const auto expected = engine::parse_number<std::uint64_t>(words[1]);
        const auto nodes = engine::perft(game, depth);
        if (nodes == expected) continue;
        fmt::print(stderr, "{}: depth {} has {} nodes, not {}\n", parts[0], depth, nodes, expected);
        right = false;
    }
    return right;
}

template <engine::Game G>
int check_file(const std::string& path) {
    const std::string text = engine::read_file(path);
    int number = 0, passed = 0, failed = 0;
    for (const auto line : split(text, '\n')) {
        ++number;
        const auto content = engine::trimmed(line);
        if (content.empty() || content.starts_with('#')) continue;
        try {
            ++(passes<G>(content) ? passed : failed);
        } catch (const engine::Error& error) {
            engine::fail("{}:{}: {}", path, number, error.what());
        }
    }
    fmt::print("{} passed, {} failed\n", passed, failed);
    return failed == 0 ? 0 : 1;
}

}  // namespace

int run_perft(Arguments arguments) {
    Request request;
    CLI::App app("Counts the positions that lie DEPTH moves behind one", "sanban perft");
    app.add_option("GAME", request.game, "chess, shogi, go")->required();
    app.add_option("DEPTH", request.depth, "moves to look ahead")->check(CLI::Range(0, 20));
    app.add_option("POSITION", request.position,
                   "as the game writes it (FEN, SFEN); else the start");
    app.add_option("--file", request.file, "check lines \"POSITION ; D1 20 ; D2 400\"");
    std::vector<std::string> words(arguments.rbegin(), arguments.rend());
    try {
        app.parse(words);
        if ((request.depth < 0) == request.file.empty())
            throw CLI::ValidationError("give DEPTH or --file");
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return engine::Games::visit(request.game, [&]<class G>() {
        return request.file.empty() ? count_by_move<G>(request) : check_file<G>(request.file);
    });
}

}  // namespace protocols
