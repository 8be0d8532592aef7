#include "engine/go/katago_v7.h"

#include <algorithm>
#include <cmath>

#include "engine/go/ladder.h"
#include "engine/go/score.h"

namespace go {

namespace {

enum Plane : int {
    on_board = 0,
    own_stones,
    enemy_stones,
    one_liberty,
    forbidden_by_ko = 6,
    last_moves = 9,
    in_ladder = 14,
    in_ladder_before = 15,
    in_ladder_two_before = 16,
    ladder_captures_plane = 17,
    own_area = 18,
    enemy_area = 19,
    plane_count = 22,
};

enum Global : int {
    passes = 0,
    komi_global = 5,
    ko_rule = 6,
    suicide_allowed = 8,
    territory_scoring = 9,
    tax_rule = 10,
    pass_would_end = 14,
    komi_wave = 18,
    global_count = 19,
};

constexpr int history = 5;  // moves

engine::EncodingShape shape(const Go& game) {
    const int size = game.size();
    return {plane_count, size, size, global_count, size * size + 1, 8};
}

class KatagoWriter {
   public:
    KatagoWriter(const Go& game, std::span<float> planes, std::span<float> globals)
        : game_(game), planes_(planes), globals_(globals), size_(game.size()) {
        std::fill(planes.begin(), planes.end(), 0.0f);
        std::fill(globals.begin(), globals.end(), 0.0f);
    }

    void write() {
        write_stones();
        const int included = write_history();
        write_ladders(included);
        if (game_.rules().scoring == Scoring::area) write_area();
        write_globals();
    }

   private:
    void set(int plane, int x, int y) {
        const int row = plane * size_ + size_ - 1 - y;
        planes_[static_cast<std::size_t>(row) * static_cast<std::size_t>(size_) +
                static_cast<std::size_t>(x)] = 1;
    }
    void set(int plane, int at) { set(plane, game_.board().x(at), game_.board().y(at)); }
    void set_global(int global, double value) {
        globals_[static_cast<std::size_t>(global)] = static_cast<float>(value);
    }

    void write_stones() {
        const auto& board = game_.board();
        const auto own = colour_of(game_.to_play());
        std::array<std::uint8_t, 1024> liberties_of{};  // by the chain's head; 0: not known yet
        board.for_each_point([&](int at) {
            set(on_board, at);
            const auto colour = board.at(at);
            if (colour == Colour::empty) {
                const auto why = game_.why_illegal({static_cast<std::uint16_t>(at)});
                if (why == "ko" || why == "superko") set(forbidden_by_ko, at);
                return;
            }
            set(colour == own ? own_stones : enemy_stones, at);
            auto& liberties = liberties_of[static_cast<std::size_t>(board.head(at))];
            if (liberties == 0) liberties = static_cast<std::uint8_t>(board.liberties(at, 4));
            if (liberties < 4) set(one_liberty + liberties - 1, at);
        });
    }

    // Was the move `ago` moves back made by the player who would make it if all had alternated?
    bool alternates(int ago, Move move) const {
        if (move == Go::pass) return true;
        const auto mover = ago % 2 == 0 ? ~game_.to_play() : game_.to_play();
        const auto& stones = game_.stones_before(ago)[mover == Player::first ? 0 : 1];
        return stones[game_.board().order(move.code)];
    }

    // How many moves were included.
    int write_history() {
        const int most = game_.consecutive_passes() >= 2 ? 1 : history;
        for (int ago = 0; ago < most; ++ago) {
            const auto move = game_.move_before(ago);
            if (!move || !alternates(ago, *move)) return ago;
            if (*move == Go::pass)
                set_global(passes + ago, 1);
            else
                set(last_moves + ago, move->code);
        }
        return most;
    }

    LadderBoard board_before(int ago) const {
        if (ago == 0)
            return {game_.board(), game_.ko_point() ? game_.move_at(*game_.ko_point()).code : 0};
        const auto move = game_.move_before(ago);
        if (!move || *move == Go::pass) return {{size_, game_.stones_before(ago)}, 0};
        // Playing the move again shows whether it left a ko.
        LadderBoard past{{size_, game_.stones_before(ago + 1)}, 0};
        if (past.board.at(move->code) != Colour::empty)
            return {{size_, game_.stones_before(ago)}, 0};
        past.play(move->code, colour_of(ago % 2 == 0 ? ~game_.to_play() : game_.to_play()));
        return past;
    }

    // Whether the board `ago` moves back may have a ko: only what took a stone leaves one.
    bool may_have_ko(int ago) const {
        if (ago == 0) return game_.ko_point().has_value();
        const auto move = game_.move_before(ago);
        if (!move || *move == Go::pass) return false;
        const auto count = [&](int moves) {
            const auto& stones = game_.stones_before(moves);
            return stones[0].count() + stones[1].count();
        };
        return count(ago) <= count(ago + 1);
    }

    Ladders ladders_before(int ago) const {
        if (may_have_ko(ago)) return read_ladders(board_before(ago));
        auto& memory = LadderMemory::of_this_thread();
        const auto& board = game_.board();
        if (ago == 0) return memory.recall(size_, board.stones(), [&] { return board; });
        const auto& stones = game_.stones_before(ago);
        return memory.recall(size_, stones, [&] { return Board(size_, stones); });
    }

    void write_ladders(int included) {
        const auto ladders = ladders_before(0);
        write_points(in_ladder, ladders.stones);
        const auto enemy = ~game_.to_play();
        write_points(ladder_captures_plane, ladders.captures[enemy == Player::first ? 0 : 1]);
        if (included < 1) {
            copy_plane(in_ladder, in_ladder_before);
        } else {
            write_points(in_ladder_before, ladders_before(1).stones);
        }
        if (included < 2) {
            copy_plane(in_ladder_before, in_ladder_two_before);
        } else {
            write_points(in_ladder_two_before, ladders_before(2).stones);
        }
    }

    void write_points(int plane, const PointSet& points) {
        if (points.none()) return;
        game_.board().for_each_point([&](int at) {
            if (points[game_.board().order(at)]) set(plane, at);
        });
    }

    void copy_plane(int from, int to) {
        const auto points = std::ptrdiff_t{size_} * size_;
        std::copy_n(planes_.begin() + from * points, points, planes_.begin() + to * points);
    }

    void write_area() {
        const auto owners = area_owners(game_);
        const auto own = game_.to_play() == Player::first ? 0u : 1u;
        owners[own].for_each([&](int x, int y) { set(own_area, x, y); });
        owners[1 - own].for_each([&](int x, int y) { set(enemy_area, x, y); });
    }

    double own_komi() const {
        double white = game_.komi().points() + game_.white_bonus();
        // Area less one point a stone played is territory: so the networks count it.
        if (game_.rules().scoring == Scoring::territory) white += game_.stone_surplus();
        const double own = game_.to_play() == Player::second ? white : -white;
        const double most = size_ * size_ + 20;
        return std::clamp(own, -most, most);
    }

    // How far komi is from the next lower value that allows a draw, as a wave of period 2.
    double komi_parity() const {
        const double odd = size_ % 2;
        const double below = std::floor((own_komi() - odd) / 2) * 2 + odd;
        const double above = own_komi() - below;
        if (above < 0.5) return above;
        return above < 1.5 ? 1 - above : above - 2;
    }

    void write_globals() {
        const auto& rules = game_.rules();
        set_global(komi_global, own_komi() / 20);
        if (rules.ko != Ko::simple) {
            set_global(ko_rule, 1);
            set_global(ko_rule + 1, rules.ko == Ko::positional ? 0.5 : -0.5);
        }
        set_global(suicide_allowed, rules.suicide);
        set_global(territory_scoring, rules.scoring == Scoring::territory);
        set_global(tax_rule, rules.tax != Tax::none);
        set_global(tax_rule + 1, rules.tax == Tax::all);
        set_global(pass_would_end, game_.consecutive_passes() > 0);
        if (rules.scoring == Scoring::area) set_global(komi_wave, komi_parity());
    }

    const Go& game_;
    std::span<float> planes_, globals_;
    int size_;
};

void write(const Go& game, std::span<float> planes, std::span<float> globals) {
    KatagoWriter(game, planes, globals).write();
}

int policy_index(const Go& game, Move move) {
    const int size = game.size();
    const auto point = game.point_of(move);
    return point ? (size - 1 - point->y) * size + point->x : size * size;
}

}  // namespace

engine::Encoding<Go> katago_v7() { return {"katago-v7", shape, write, policy_index, nullptr}; }

}  // namespace go
