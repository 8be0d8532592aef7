// The Go Text Protocol, version 2 (Farneback 2002), with the commands that GoGui, Sabaki, Lizzie,
// KGS and the tournament managers send beyond it. A table of commands onto a session: lists, help
// and the README's table come from it. Every command is answered; a bad one leaves the game as it
// was.
#pragma once

#include <array>
#include <istream>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/go/go.h"
#include "engine/go/rollouts.h"
#include "engine/go/sgf.h"
#include "protocols/go_judge.h"
#include "protocols/gtp_analysis.h"
#include "protocols/gtp_input.h"
#include "protocols/gtp_time.h"
#include "protocols/lines.h"
#include "protocols/session.h"
#include "protocols/words.h"

namespace protocols {

struct GtpSettings {
    std::string name = "sanban";
    int size = 19;
    double komi = 7.5;
    go::Rules rules;
    double seconds = 5;             // a move when no clock and no other limit is set
    std::uint64_t simulations = 0;  // a move; 0: no such limit
    std::uint64_t visits = 0;       // likewise, those kept from earlier moves counted
    double resign_below = 0.1;      // winrate; 0: never
    bool ponder = false;
    std::string weights;  // of the network; empty: none
    search::PrecisionChoice precision;
};

class Gtp {
   public:
    struct Command {
        std::string_view name;
        std::string (Gtp::*run)(Words& words);
        std::string_view arguments, help;
    };
    static std::span<const Command> commands();
    // The table of commands in Markdown.
    static std::string manual();

    Gtp(const GtpSettings& settings, const search::SearchParams& params, Output& out);
    ~Gtp();
    Gtp(const Gtp&) = delete;
    Gtp& operator=(const Gtp&) = delete;

    // Until `quit` or the end of input.
    void serve(std::istream& in);
    // One line, answered; false for `quit`. Lines of an analysis go on until the next call.
    bool handle(std::string_view line);
    // Called for each line as it comes in, from any thread: cuts a think short where it may.
    void arrived(std::string_view line);

   private:
    // Which lines cut short what the engine is thinking about.
    enum class Cut : std::uint8_t { by_none, by_interrupt, by_any };

    // What a genmove is to do with its result.
    struct Errand {
        engine::Player player;
        bool plays = true, cleans_up = false;
        const AnalysisRequest* reports = nullptr;  // an answer in lines that ends with `play`
        Cut cut = Cut::by_interrupt;
    };

    // gtp_core.cpp: about the engine and the session
    std::string protocol_version(Words&);
    std::string name(Words&);
    std::string version(Words&);
    std::string known_command(Words& words);
    std::string list_commands(Words&);
    std::string help(Words& words);
    std::string quit(Words&);
    std::string stop(Words&);
    std::string clear_cache(Words&);
    std::string cpu_time(Words&);
    std::string nothing(Words&);
    std::string chat(Words& words);
    std::string level(Words& words);
    std::string random_seed(Words&);
    std::string set_random_seed(Words& words);
    std::string set_option(Words& words);
    std::string list_params(Words&);
    std::string all_params(Words&);
    std::string param(Words& words);
    std::string set_param(Words& words);
    std::string set_params(Words& words);
    std::string memory_report(Words&);

    // gtp_board.cpp: the position
    std::string board_size(Words& words);
    std::string rectangular_board_size(Words& words);
    std::string query_board_size(Words&);
    std::string clear_board(Words&);
    std::string komi(Words& words);
    std::string query_komi(Words&);
    std::string play(Words& words);
    std::string play_sequence(Words& words);
    std::string undo(Words&);
    std::string undo_many(Words& words);
    std::string show_board(Words&);
    std::string fixed_handicap(Words& words);
    std::string place_free_handicap(Words& words);
    std::string set_free_handicap(Words& words);
    std::string query_handicap(Words&);
    std::string set_position(Words& words);
    std::string set_up(Words& words);
    std::string play_black(Words& words);
    std::string play_white(Words& words);
    std::string setup_player(Words& words);
    std::string all_legal(Words& words);
    std::string is_legal(Words& words);
    std::string list_stones(Words& words);
    std::string captures(Words& words);
    std::string last_move(Words&);
    std::string move_history(Words&);
    std::string rules(Words&);
    std::string set_rules(Words& words);
    std::string set_rule(Words& words);
    std::string load_sgf(Words& words);
    std::string print_sgf(Words& words);

    // gtp_time.cpp
    std::string time_settings(Words& words);
    std::string kgs_time_settings(Words& words);
    std::string kata_time_settings(Words& words);
    std::string list_time_settings(Words&);
    std::string time_left(Words& words);

    // gtp_think.cpp: moves, scores, analysis
    std::string genmove_command(Words& words);
    std::string reg_genmove(Words& words);
    std::string cleanup(Words& words);
    std::string lz_genmove_analyze(Words& words);
    std::string kata_genmove_analyze(Words& words);
    std::string any_genmove_analyze(Words& words);
    std::string kata_search_analyze(Words& words);
    std::string kata_search_cancellable(Words& words);
    std::string lz_analyze(Words& words);
    std::string kata_analyze(Words& words);
    std::string any_analyze(Words& words);
    std::string top_moves(Words&);
    std::string debug_moves(Words&);
    std::string explain_last_move(Words&);
    std::string benchmark(Words& words);
    std::string final_score(Words&);
    std::string estimate_score(Words&);
    std::string final_status_list(Words& words);
    std::string final_status(Words& words);

    // gtp_network.cpp
    std::string kata_raw_nn(Words& words);
    std::string heatmap(Words& words);
    search::Evaluation ask_network(const go::Go& game, const engine::MoveList& moves,
                                   int symmetry) const;

    // gtp_gogui.cpp
    std::string gogui_commands(Words&);
    std::string gogui_ownership(Words&);
    std::string gogui_visits(Words&);
    std::string gogui_variation(Words&);
    std::string gogui_title(Words&);

    static const Command table_[];

    const go::Go& now() const { return session_.now(); }
    static const Command* find(std::string_view name);
    void run(const Command& command, Words& words);
    void answer(char sign, std::string_view text);
    void end_analysis();
    void restart(const go::Go& start);
    void play(engine::Player player, go::Move move);
    void play_checked(engine::Player player, std::string_view vertex);
    void take_back();
    go::Go with_stones(Words& words) const;
    void start_handicap(std::span<const go::Point> points);
    void change_params(std::string_view row, std::string_view value);
    void load_weights(const std::string& file);
    void renew_network();
    go::Point vertex_of(std::string_view text) const;
    std::string points_text(std::span<const go::Point> points) const;
    std::string result_text();
    void resize(int size);
    bool board_empty() const;

    search::Limits move_limits(engine::Player player);
    std::optional<search::Milliseconds> reading_time(engine::Player player) const;
    go::Go root_for(engine::Player player) const;
    bool disputed(engine::Player player) const;
    Ending read_ending(const go::Go& game, bool clean_up);
    void allow_cut(Cut cut);
    search::Analysis think(const go::Go& root, const search::Limits& limits,
                           const AnalysisRequest* reports);
    std::string choose(const Errand& errand);
    std::string best_move(const search::Analysis& picture, const Errand& errand);
    std::string genmove(const Errand& errand);
    std::string genmove_analyze(Words& words, AnalysisDialect dialect);
    std::string search_analyze(Words& words, Cut cut);
    std::string analyze(Words& words, AnalysisDialect dialect);
    Session::Report printer(const AnalysisRequest& request);
    void begin_stream();
    Reading reading() { return judge_.read(now()); }
    std::vector<float> black_owners() const;
    const search::Analysis& last_search() const;
    void remember(const go::Go& root);
    void forget();
    void ponder();

    GtpSettings settings_;
    search::PrecisionChoice network_precision_;  // that the network was loaded for
    Output& out_;
    GameSession<go::Go> session_;
    GoJudge judge_;
    std::vector<go::sgf::Turn> turns_;
    std::string id_;         // of the command being answered
    bool answered_ = false;  // its first line is out
    bool analysing_ = false;
    bool quitting_ = false;
    GtpClock clock_;
    std::array<int, 2> hopeless_moves_{};  // in a row, of each side
    std::string result_;                   // of a game that ended by resignation
    std::optional<go::Go> ponder_on_;

    InputAhead* input_ = nullptr;
    std::mutex cut_mutex_;  // the two below: the reading thread cuts a think short
    Cut cut_ = Cut::by_none;
    bool was_cut_ = false;

    search::Analysis last_picture_;
    std::optional<go::Go> last_root_;
};

}  // namespace protocols
