// UCI, which chess GUIs speak, and its dialect USI for shogi: a session served over lines of text.
// Answers `uci` before anything is loaded; unknown commands are ignored with one `info string`, as
// UCI demands; nothing but protocol is written, and nothing between a bestmove and the next go.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "protocols/lines.h"
#include "protocols/mate_think.h"
#include "protocols/session.h"
#include "protocols/uci_go.h"

namespace protocols {

// The words in which the two protocols differ.
struct Dialect {
    std::string_view hello, hello_done, new_game, position, hash_option, ponder_option;
    std::string_view no_move;  // bestmove of a side that has none
    bool white_first = true;
    bool knows_resignation = false;
    // go mate asks for a problem's solution, within milliseconds; else for the move, in moves.
    bool asks_for_checkmate = false;
};

inline constexpr Dialect uci_dialect{"uci",    "uciok",  "ucinewgame", "fen", "Hash",
                                     "Ponder", "(none)", true,         false, false};
inline constexpr Dialect usi_dialect{"usi",        "usiok",  "usinewgame", "sfen", "USI_Hash",
                                     "USI_Ponder", "resign", false,        true,   true};

// One option as GUIs see it.
struct UciOption {
    std::string name;
    std::string declaration;  // from `type` on
    std::function<void(std::string_view)> set;
};

class Uci {
   public:
    // `extra`: options that only this game has. `name`: what `id name` answers.
    Uci(const Dialect& dialect, std::unique_ptr<Session> session, std::string name, Output& out,
        std::vector<UciOption> extra = {});
    ~Uci() { end_think(); }
    Uci(const Uci&) = delete;
    Uci& operator=(const Uci&) = delete;

    // The network to load before the first think; `uci` is answered before.
    void set_network(const std::string& file, search::PrecisionChoice precision);

    // A move is given after so many at the latest; 0: as time allows. Analysis knows no such limit.
    void limit_simulations(std::uint64_t most) { most_simulations_ = most; }

    // Until `quit` or the end of input; a think with limits that is under way then is finished.
    void serve(std::istream& in);
    // One line; false for `quit`.
    bool handle(std::string_view line);

   private:
    struct Command {
        std::string_view name;
        void (Uci::*run)(std::string_view arguments);
    };

    std::vector<Command> commands() const;
    std::vector<UciOption> common_options();
    UciOption row_option(std::string name, std::string_view row);
    void add_strength(std::vector<UciOption>& options);
    void limit_strength();

    void hello(std::string_view);
    void is_ready(std::string_view);
    void set_option(std::string_view arguments);
    void new_game(std::string_view);
    void position(std::string_view arguments);
    void go(std::string_view arguments);
    void stop(std::string_view);
    void ponder_hit(std::string_view arguments);
    void game_over(std::string_view);
    void ignore(std::string_view) {}

    void begin(const GoCommand& go);
    void think(const GoCommand& go);
    void search(const GoCommand& go);
    void solve(const GoCommand& go);
    void start_mate_think(const GoCommand& go);
    void tell_solution(const search::MateResult& result);
    void progress(const search::Analysis& picture);
    void report(const search::Analysis& picture);
    bool tell_mate(const search::Analysis& picture);
    void finish(const search::Analysis& picture);
    void end_think();
    void load_network();
    void tell(const engine::Error& error);
    std::string info(const search::Analysis& picture, std::size_t rank) const;
    std::string score(const search::MoveAnalysis& move) const;
    std::string wdl(const search::Analysis& picture, const search::MoveAnalysis& move) const;
    std::string moves_left(const search::Analysis& picture) const;
    std::string best_move(const search::Analysis& picture) const;
    search::Limits search_limits(const GoCommand& go);
    static search::MateLimits mate_limits(const GoCommand& go);
    void change(const std::function<void(search::SearchParams&)>& edit);

    const Dialect dialect_;
    std::unique_ptr<Session> session_;
    std::string name_;
    Output& out_;
    std::vector<UciOption> options_;

    std::string weights_;
    search::PrecisionChoice precision_;
    bool verbose_ = false;
    bool network_due_ = false;  // weights_ and precision_ are not in force yet

    std::uint64_t most_simulations_ = 0;
    int multi_pv_ = 1;
    bool offers_ponder_ = true;
    bool shows_wdl_ = false, shows_moves_left_ = false;
    bool limits_strength_ = false;
    int elo_ = search::strongest_elo;
    int resign_per_mille_ = 0;

    // The present think.
    GoCommand last_go_;
    std::chrono::steady_clock::time_point begun_;  // since when its time counts
    ClockLag lag_;
    std::vector<engine::Move> allowed_;  // as searchmoves
    int reported_depth_ = 0;
    search::Milliseconds reported_at_{0};
    std::atomic<bool> silenced_ = false;      // its bestmove is not wanted
    std::optional<search::MateResult> mate_;  // the mate search's to write
    std::atomic<bool> mate_known_ = false;
    MateThink mate_think_;
};

// 100 centipawns are a mean value of about 0.4; `value` in [-1, 1].
int centipawns(float value);

}  // namespace protocols
