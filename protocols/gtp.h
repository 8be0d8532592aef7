// The Go Text Protocol, version 2 (Farneback 2002), with the commands that GoGui, Sabaki, Lizzie,
// KGS and the tournament managers send beyond it. A table of commands onto a session: lists, help
// and the README's table come from it. Every command is answered; a bad one leaves the game as it
// was.
#pragma once

#include <array>
#include <atomic>
#include <istream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/go/go.h"
#include "engine/go/rollouts.h"
#include "engine/go/sgf.h"
#include "protocols/go_endgame.h"
#include "protocols/gtp_input.h"
#include "protocols/gtp_time.h"
#include "protocols/lines.h"
#include "protocols/session.h"

namespace protocols {

struct GtpSettings {
    std::string name = "sanban";
    int size = 19;
    double komi = 7.5;
    go::Rules rules;
    double seconds = 5;             // a move when no clock and no simulations are set
    std::uint64_t simulations = 0;  // a move; 0: no such limit
    double resign_below = 0.05;     // winrate; 0: never
    bool ponder = false;
};

// The words behind a command's name.
class Words {
   public:
    explicit Words(std::string_view text);

    bool empty() const { return at_ == words_.size(); }
    std::size_t left() const { return words_.size() - at_; }
    // The next word; fails, naming `what` is missing.
    std::string_view take(std::string_view what);
    // Likewise as a number within [least, most].
    int whole(std::string_view what, int least, int most);
    double number(std::string_view what, double least, double most);
    engine::Player colour();
    std::string rest() const;
    const std::string& peek() const { return words_[at_]; }

   private:
    std::vector<std::string> words_;
    std::size_t at_ = 0;
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
    // One line, answered; false for `quit`.
    bool handle(std::string_view line);
    // Called for each line as it arrives, from any thread: whether to cut a think short.
    void arrived(std::string_view line);

   private:
    // What a running think is for: which lines end it.
    enum class Thinking : std::uint8_t { no, to_move, analysing, cancellable };

    struct AnalysisRequest {
        engine::Player player;
        search::Limits limits;
        bool kata = false, floats = false;
        int most_moves = 1000, least_moves = 0;
        bool root_info = false, ownership = false, visits_of_variation = false;
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
    std::string random_seed(Words&);
    std::string set_random_seed(Words& words);
    std::string set_option(Words& words);
    std::string list_params(Words&);
    std::string all_params(Words&);
    std::string param(Words& words);
    std::string set_param(Words& words);
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
    std::string genmove(Words& words);
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
    std::string final_score(Words&);
    std::string estimate_score(Words&);
    std::string final_status_list(Words& words);
    std::string final_status(Words& words);

    // gtp_gogui.cpp
    std::string gogui_commands(Words&);
    std::string gogui_ownership(Words&);
    std::string gogui_visits(Words&);
    std::string gogui_variation(Words&);

    static const Command table_[];

    const go::Go& now() const { return session_.now(); }
    const Command* find(std::string_view name) const;
    void run(const Command& command, std::string_view arguments);
    void answer(char sign, std::string_view text);
    void end_analysis();
    void restart(const go::Go& start);
    void play(engine::Player player, go::Move move);
    void play_checked(engine::Player player, std::string_view vertex);
    go::Point vertex_of(std::string_view text) const;
    std::string points_text(std::span<const go::Point> points) const;
    std::string result_text();
    void resize(int size);
    bool board_empty() const;

    search::Limits move_limits(engine::Player player) const;
    search::Analysis think(const AnalysisRequest& request, Thinking purpose);
    std::string choose(const search::Analysis& picture, engine::Player player, bool clean_up);
    std::string move_now(engine::Player player, bool play_it, bool clean_up);
    std::string genmove_analyze(Words& words, bool kata, bool floats);
    std::string search_analyze(Words& words, bool cancellable);
    std::string analyze(Words& words, bool kata, bool floats);
    AnalysisRequest parse_analysis(Words& words, bool kata, bool floats) const;
    void parse_key(std::string_view key, Words& words, AnalysisRequest& request) const;
    static void parse_switch(std::string_view key, std::string_view value,
                             AnalysisRequest& request);
    void parse_restriction(Words& words, bool allow, AnalysisRequest& request) const;
    void print_analysis(const search::Analysis& picture, const AnalysisRequest& request);
    std::string move_info(const search::MoveAnalysis& move, int order,
                          const AnalysisRequest& request) const;
    const Reading& reading();
    void read_by_rollouts();
    void remember(const search::Analysis& picture, engine::Player player, bool restricted);
    void remember_owners(const search::Analysis& picture, engine::Player player);
    bool knows_owners() const;
    bool may_read(engine::Player player) const;
    std::vector<go::Move> moves_against_dead(engine::Player player);
    void forget();
    search::Limits limits_of(const AnalysisRequest& request) const;
    void ponder();

    GtpSettings settings_;
    Output& out_;
    GameSession<go::Go> session_;
    std::vector<go::sgf::Turn> turns_;
    std::string id_;  // of the command being answered
    bool answered_ = false;
    bool quitting_ = false;
    GtpClock clock_;
    std::array<int, 2> hopeless_moves_{};  // in a row, of each side
    std::string result_;                   // of a game that ended by resignation

    std::atomic<Thinking> thinking_ = Thinking::no;
    std::atomic<bool> cut_ = false;
    bool restricted_ = false;  // the running analysis looks at some moves only
    search::Analysis last_picture_;
    engine::Player last_player_ = engine::Player::first;  // who was to move in it

    // Expected owners of the stones of `read_`, and what they say about the present game.
    std::vector<float> owners_;
    go::Stones read_{};
    std::optional<Reading> reading_;
};

}  // namespace protocols
