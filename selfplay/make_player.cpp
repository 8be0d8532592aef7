#include "selfplay/make_player.h"

#include <string>
#include <type_traits>
#include <utility>

#include "engine/base/error.h"
#include "engine/games.h"
#include "search/load_player.h"
#include "selfplay/gnushogi_player.h"
#include "selfplay/gtp_player.h"
#include "selfplay/in_process_player.h"
#include "selfplay/uci_player.h"
#include "selfplay/xboard_player.h"

namespace selfplay {

namespace {

using Made = std::unique_ptr<Player>;

struct InternalSettings {
    search::SearchParams params;
    std::string weights;  // empty: none
    search::PrecisionChoice precision;

    void set(const std::string& name, const std::string& value) {
        if (name == "weights") {
            weights = value;
        } else if (name == "precision") {
            precision = search::precision_choice(value);
        } else {
            engine::set_option(params, name, value);
        }
    }
};

// "name=value" words after the first of the command: weights, precision, the search's options.
InternalSettings internal_settings(const PlayerSettings& settings) {
    InternalSettings internal;
    internal.params.memory_mib = 256;
    const auto words = split_command(settings.command);
    for (std::size_t i = 1; i < words.size(); ++i) {
        const auto equals = words[i].find('=');
        if (equals == std::string::npos)
            engine::fail("internal player: wants name=value, not {}", words[i]);
        internal.set(words[i].substr(0, equals), words[i].substr(equals + 1));
    }
    return internal;
}

template <engine::Game G>
typename InProcessPlayer<G>::Load loader_of(const InternalSettings& settings) {
    if (settings.weights.empty()) return {};
    return [weights = settings.weights, precision = settings.precision,
            method = settings.params.method](const G& start) {
        return search::load_player(weights, precision, start, method);
    };
}

template <engine::Game G>
G start_for(const GameSetup& setup) {
    if constexpr (std::is_same_v<G, go::Go>)
        return start_of(setup.go);
    else
        return setup.start.empty() ? G() : G::from_text(setup.start);
}

Made make_internal(const PlayerSettings& settings, const std::string& game, Deadline,
                   std::stop_token stop) {
    return engine::Games::visit(game, [&]<class G>() -> Made {
        const auto internal = internal_settings(settings);
        return std::make_unique<InProcessPlayer<G>>(internal.params, settings.visits, start_for<G>,
                                                    loader_of<G>(internal), std::move(stop));
    });
}

Made make_gtp(const PlayerSettings& settings, const std::string& game, Deadline deadline,
              std::stop_token stop) {
    if (game != "go") engine::fail("{}: GTP engines play Go only", settings.command);
    return std::make_unique<GtpPlayer>(settings, std::move(stop), deadline);
}

Made make_uci(const PlayerSettings& settings, const std::string& game, Deadline deadline,
              std::stop_token stop) {
    if (game != "chess") engine::fail("{}: UCI engines play chess only", settings.command);
    return std::make_unique<UciPlayer>(settings, uci_dialect(), std::move(stop), deadline);
}

Made make_usi(const PlayerSettings& settings, const std::string& game, Deadline deadline,
              std::stop_token stop) {
    if (game != "shogi") engine::fail("{}: USI engines play shogi only", settings.command);
    return std::make_unique<UciPlayer>(settings, usi_dialect(), std::move(stop), deadline);
}

Made make_xboard(const PlayerSettings& settings, const std::string& game, Deadline deadline,
                 std::stop_token stop) {
    if (game != "chess") engine::fail("{}: xboard engines play chess only", settings.command);
    return std::make_unique<XboardPlayer>(settings, std::move(stop), deadline);
}

Made make_gnushogi(const PlayerSettings& settings, const std::string& game, Deadline deadline,
                   std::stop_token stop) {
    if (game != "shogi") engine::fail("{}: gnushogi plays shogi only", settings.command);
    return std::make_unique<GnushogiPlayer>(settings, std::move(stop), deadline);
}

struct Protocol {
    std::string_view name;
    Made (*make)(const PlayerSettings&, const std::string& game, Deadline, std::stop_token);
};

constexpr Protocol protocols[] = {
    {"internal", make_internal}, {"gtp", make_gtp},       {"uci", make_uci},
    {"usi", make_usi},           {"xboard", make_xboard}, {"gnushogi", make_gnushogi},
};

}  // namespace

std::unique_ptr<Player> make_player(const PlayerSettings& settings, const std::string& game,
                                    Milliseconds timeout, std::stop_token stop) {
    for (const auto& protocol : protocols)
        if (protocol.name == settings.protocol)
            return protocol.make(settings, game, Clock::now() + timeout, std::move(stop));
    engine::fail("no such protocol: {} (internal, gtp, uci, usi, xboard, gnushogi)",
                 settings.protocol);
}

}  // namespace selfplay
