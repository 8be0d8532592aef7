#include "engine/base/error.h"
#include "engine/shogi/shogi.h"
#include "selfplay/csa_text.h"
#include "selfplay/line_openings.h"
#include "selfplay/rulebook.h"

namespace selfplay {

using shogi::Shogi;

template <>
struct Manner<Shogi> {
    static std::optional<engine::Move> read(const Shogi& game, std::string_view text) {
        return game.move_from_text(text);
    }
    static std::string ending(const Shogi& game) {
        const auto outcome = game.outcome();
        if (outcome == engine::Outcome::draw) return "repetition";
        if (outcome == engine::win_for(game.to_play()))
            return game.can_declare_win() ? "declaration" : "perpetual check";
        if (game.legal_moves().empty()) return game.in_check() ? "checkmate" : "no legal move";
        const bool by_try = game.declaration_rule() == shogi::DeclarationRule::try_rule;
        return by_try && game.repetitions() == 0 ? "try" : "perpetual check";
    }
    static bool may_claim_win(const Shogi& game) { return game.can_declare_win(); }
};

namespace {

class ShogiRulebook final : public Rulebook {
   public:
    explicit ShogiRulebook(const std::string& declaration_rule) {
        const auto rule = shogi::declaration_rule_from_name(declaration_rule);
        if (!rule) engine::fail("no such rule of declaring a win: {}", declaration_rule);
        rule_ = *rule;
    }

    std::unique_ptr<Referee> referee(const std::string& start) const override {
        auto game = start.empty() ? Shogi() : Shogi::from_text(start);
        game.set_declaration_rule(rule_);
        return std::make_unique<GameReferee<Shogi>>(std::move(game));
    }
    GameSetup setup(const std::string& start) const override {
        GameSetup setup;
        setup.game = "shogi";
        setup.start = start;
        return setup;
    }
    std::vector<Opening> openings(const std::filesystem::path& path, int plies) const override {
        return openings_of_lines(path, plies, opening_of_position,
                                 [this](const std::string& start) { return referee(start); });
    }
    std::string to_text(const GameRecord& record) const override { return to_csa(record); }
    std::string_view extension() const override { return "csa"; }
    int usual_move_limit() const override { return 0; }

   private:
    shogi::DeclarationRule rule_{};
};

}  // namespace

std::unique_ptr<Rulebook> shogi_rulebook(const std::string& declaration_rule) {
    return std::make_unique<ShogiRulebook>(declaration_rule);
}

}  // namespace selfplay
