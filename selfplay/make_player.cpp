#include "selfplay/make_player.h"

#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/go/rollouts.h"
#include "selfplay/gtp_player.h"
#include "selfplay/in_process_player.h"

namespace selfplay {

namespace {

using Made = std::unique_ptr<Player>;

// "name=value" words after the first of the command set the search's options.
search::SearchParams params_of(const PlayerSettings& settings) {
    search::SearchParams params;
    params.memory_mib = 256;
    const auto words = split_command(settings.command);
    for (std::size_t i = 1; i < words.size(); ++i) {
        const auto equals = words[i].find('=');
        if (equals == std::string::npos)
            engine::fail("internal player: wants name=value, not {}", words[i]);
        engine::set_option(params, words[i].substr(0, equals), words[i].substr(equals + 1));
    }
    return params;
}

Made make_internal(const PlayerSettings& settings, const std::string& game, Deadline,
                   std::stop_token stop) {
    if (game == "go")
        return std::make_unique<InProcessPlayer<go::Go>>(
            params_of(settings), settings.visits,
            [](const GameSetup& setup) { return start_of(setup.go); }, std::move(stop));
    engine::fail("no internal player of {}", game);
}

Made make_gtp(const PlayerSettings& settings, const std::string& game, Deadline deadline,
              std::stop_token stop) {
    if (game != "go") engine::fail("{}: GTP engines play Go only", settings.command);
    return std::make_unique<GtpPlayer>(settings, std::move(stop), deadline);
}

struct Protocol {
    std::string_view name;
    Made (*make)(const PlayerSettings&, const std::string& game, Deadline, std::stop_token);
};

constexpr Protocol protocols[] = {
    {"internal", make_internal},
    {"gtp", make_gtp},
};

}  // namespace

std::unique_ptr<Player> make_player(const PlayerSettings& settings, const std::string& game,
                                    Milliseconds timeout, std::stop_token stop) {
    for (const auto& protocol : protocols)
        if (protocol.name == settings.protocol)
            return protocol.make(settings, game, Clock::now() + timeout, std::move(stop));
    engine::fail("no such protocol: {}", settings.protocol);
}

}  // namespace selfplay
