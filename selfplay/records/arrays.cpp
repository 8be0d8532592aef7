#include "selfplay/records/arrays.h"

#include <algorithm>
#include <concepts>
#include <vector>

#include "engine/base/error.h"
#include "engine/encoding.h"
#include "engine/games.h"
#include "selfplay/records/npz.h"

namespace selfplay::records {

namespace {

template <engine::Encoded G>
class ArrayWriter {
   public:
    ArrayWriter(std::span<const Game> games, const ArraySettings& settings,
                const std::filesystem::path& path)
        : encoding_(settings.encoding.empty() ? G::encodings()[0]
                                              : engine::find_encoding<G>(settings.encoding)),
          npz_(path) {
        for (const auto& game : games) take(game, settings.board);
        if (summary_.positions == 0) engine::fail("there is no position to write");
    }

    ArraySummary run() {
        write_inputs();
        write_policy();
        write_numbers("policy_known", [](const Game&, const Turn& turn, engine::Player) {
            return turn.share_count > 0 ? 1.0f : 0.0f;
        });
        write_numbers("value", [](const Game& game, const Turn&, engine::Player mover) {
            return engine::value_for(mover, game.outcome);
        });
        write_numbers("root_value",
                      [](const Game&, const Turn& turn, engine::Player) { return turn.value; });
        if (has_owners_) write_territory();
        npz_.close();
        return summary_;
    }

   private:
    void take(const Game& game, int board) {
        const auto shape = encoding_.shape(G::from_text(game.start));
        if (board != 0 && shape.height != board) return;
        if (!games_.empty() && shape != shape_)
            engine::fail("games on boards of {} and of {}: --size takes those of one",
                         shape_.height, shape.height);
        shape_ = shape;
        has_owners_ = has_owners_ || !game.owners.empty();
        games_.push_back(&game);
        ++summary_.games;
        summary_.positions += game.turns.size();
        for (const auto& turn : game.turns) summary_.taught += turn.share_count > 0;
    }

    // visit(record, turn, position before it)
    template <class Visit>
    void for_each_position(Visit visit) const {
        for (const auto* record : games_) {
            G game = G::from_text(record->start);
            for (const auto& turn : record->turns) {
                if (!game.legal_moves().contains(turn.move))
                    engine::fail("a record with an illegal move, number {}",
                                 &turn - record->turns.data() + 1);
                visit(*record, turn, game);
                game.play(turn.move);
            }
        }
    }

    void begin(const std::string& name, std::vector<std::size_t> row) {
        row.insert(row.begin(), summary_.positions);
        npz_.begin(name, row);
    }

    void write_inputs() {
        const auto side = [](int number) { return static_cast<std::size_t>(number); };
        std::vector<float> planes(shape_.planes_size()), globals(side(shape_.globals));
        begin("planes", {side(shape_.planes), side(shape_.height), side(shape_.width)});
        for_each_position([&](const Game&, const Turn&, const G& game) {
            encoding_.write(game, planes, globals);
            npz_.write(planes);
        });
        if (globals.empty()) return;
        begin("globals", {globals.size()});
        for_each_position([&](const Game&, const Turn&, const G& game) {
            encoding_.write(game, planes, globals);
            npz_.write(globals);
        });
    }

    void write_policy() {
        std::vector<float> policy(static_cast<std::size_t>(shape_.policy_size));
        begin("policy", {policy.size()});
        for_each_position([&](const Game& record, const Turn& turn, const G& game) {
            std::fill(policy.begin(), policy.end(), 0.0f);
            float sum = 1e-9f;
            for (const auto& target : record.policy(turn)) sum += static_cast<float>(target.share);
            const auto legal = game.legal_moves();
            for (const auto& [move, share] : record.policy(turn)) {
                if (!legal.contains(move)) engine::fail("a record with an illegal policy target");
                policy[static_cast<std::size_t>(encoding_.policy_index(game, move))] +=
                    static_cast<float>(share) / sum;
            }
            npz_.write(policy);
        });
    }

    template <class Number>
    void write_numbers(const std::string& name, Number number) {
        begin(name, {});
        for_each_position([&](const Game& record, const Turn& turn, const G& game) {
            const float value = number(record, turn, game.to_play());
            npz_.write(std::span(&value, 1));
        });
    }

    static float sign(engine::Player mover) {
        return mover == engine::Player::first ? 1.0f : -1.0f;
    }

    void write_territory() {
        std::vector<float> owners(shape_.points());
        begin("ownership",
              {static_cast<std::size_t>(shape_.height), static_cast<std::size_t>(shape_.width)});
        for_each_position([&](const Game& record, const Turn&, const G& game) {
            std::fill(owners.begin(), owners.end(), 0.0f);
            const auto known = std::min(owners.size(), record.owners.size());
            for (std::size_t i = 0; i < known; ++i)
                owners[i] = sign(game.to_play()) * static_cast<float>(record.owners[i]);
            npz_.write(owners);
        });
        write_numbers("lead", [](const Game& game, const Turn&, engine::Player mover) {
            return sign(mover) * game.lead;
        });
        write_numbers("score_known", [](const Game& game, const Turn&, engine::Player) {
            return game.owners.empty() ? 0.0f : 1.0f;
        });
    }

    const engine::Encoding<G>& encoding_;
    NpzWriter npz_;
    std::vector<const Game*> games_;
    engine::EncodingShape shape_{};
    bool has_owners_ = false;
    ArraySummary summary_;
};

}  // namespace

ArraySummary write_arrays(std::span<const Game> games, const ArraySettings& settings,
                          const std::filesystem::path& path) {
    if (games.empty()) engine::fail("there is no game to write");
    const auto& kind = games.front().game;
    if (std::any_of(games.begin(), games.end(),
                    [&](const Game& game) { return game.game != kind; }))
        engine::fail("games of different kinds in one place");
    return engine::Games::visit(
        kind, [&]<class G>() { return ArrayWriter<G>(games, settings, path).run(); });
}

}  // namespace selfplay::records
