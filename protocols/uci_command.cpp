// `sanban uci` and `sanban usi`: the front end, with the options that chess and shogi alone have.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

#include "engine/chess/chess.h"
#include "engine/chess/rollouts.h"
#include "engine/shogi/rollouts.h"
#include "engine/shogi/shogi.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "protocols/uci.h"

namespace protocols {

namespace {

struct UciFlags {
    search::SearchParams params;
    NetworkFlags network;
    std::string name = "sanban " SANBAN_VERSION;
    std::uint64_t simulations = 0;
};

void add_flags(CLI::App& app, UciFlags& flags) {
    flags.params.threads = default_threads();
    add_search_flags(app, flags.params);
    add_network_flags(app, flags.network);
    app.add_option("--name", flags.name, "what the engine calls itself")->capture_default_str();
    app.add_option("--simulations", flags.simulations,
                   "a move, beside its clock; 0: as time allows")
        ->capture_default_str();
}

int serve(const Dialect& dialect, const UciFlags& flags, std::unique_ptr<Session> session,
          std::vector<UciOption> extra, std::string_view first_line) {
    end_on_signals();
    Output output(std::cout);
    Uci uci(dialect, std::move(session), flags.name, output, std::move(extra));
    uci.limit_simulations(flags.simulations);
    if (!flags.network.weights.empty())
        uci.set_network(flags.network.weights, flags.network.precision);
    if (uci.handle(first_line)) uci.serve(std::cin);
    return 0;
}

UciOption chess960(GameSession<chess::Chess>& session) {
    return {"UCI_Chess960", "type check default false", [&session](std::string_view text) {
                const bool chess960 = text == "true";
                if (!chess960 && text != "false")
                    engine::fail("UCI_Chess960 must be true or false, not {}", text);
                session.set_house_rules([chess960](chess::Chess& game) {
                    if (chess960) game.set_chess960(true);
                });
            }};
}

struct ShogiRules {
    shogi::DeclarationRule declaration = shogi::DeclarationRule::csa_rule_27;
    int move_limit = 0;
};

std::vector<UciOption> shogi_options(GameSession<shogi::Shogi>& session,
                                     const std::shared_ptr<ShogiRules>& rules) {
    const auto apply = [&session, rules] {
        session.set_house_rules([rules](shogi::Shogi& game) {
            game.set_declaration_rule(rules->declaration);
            game.set_move_limit(rules->move_limit);
        });
    };
    const auto set_declaration = [rules, apply](std::string_view text) {
        const auto rule = shogi::declaration_rule_from_name(text);
        if (!rule)
            engine::fail("EnteringKingRule must be one of {}, not {}",
                         fmt::join(shogi::declaration_rule_names(), ", "), text);
        rules->declaration = *rule;
        apply();
    };
    const auto set_limit = [rules, apply](std::string_view text) {
        const int limit = engine::parse_number<int>(text);
        if (limit < 0 || limit > 100000)
            engine::fail("MaxMovesToDraw must lie in 0..100000, not {}", text);
        rules->move_limit = limit;
        apply();
    };
    return {{"EnteringKingRule",
             fmt::format("type combo default CSARule27 var {}",
                         fmt::join(shogi::declaration_rule_names(), " var ")),
             set_declaration},
            {"MaxMovesToDraw", "type spin default 0 min 0 max 100000", set_limit}};
}

}  // namespace

int run_uci(Arguments arguments) { return run_uci_from(arguments, ""); }
int run_usi(Arguments arguments) { return run_usi_from(arguments, ""); }

int run_uci_from(Arguments arguments, std::string_view first_line) {
    CLI::App app("Chess over UCI", "sanban uci");
    UciFlags flags;
    add_flags(app, flags);
    if (const auto status = parse_flags(app, arguments)) return *status;
    choose_weights(flags.network, flags.params, "chess");
    check_method(flags.params, flags.network);
    auto session = std::make_unique<GameSession<chess::Chess>>(flags.params);
    auto option = chess960(*session);
    return serve(uci_dialect, flags, std::move(session), {std::move(option)}, first_line);
}

int run_usi_from(Arguments arguments, std::string_view first_line) {
    CLI::App app("Shogi over USI", "sanban usi");
    UciFlags flags;
    add_flags(app, flags);
    if (const auto status = parse_flags(app, arguments)) return *status;
    choose_weights(flags.network, flags.params, "shogi");
    check_method(flags.params, flags.network);
    auto session = std::make_unique<GameSession<shogi::Shogi>>(flags.params);
    auto options = shogi_options(*session, std::make_shared<ShogiRules>());
    return serve(usi_dialect, flags, std::move(session), std::move(options), first_line);
}

}  // namespace protocols
