// The table of GTP commands, and how a line becomes a call of one.
#include "protocols/gtp.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace protocols {

namespace {

// How many words a pattern such as "COLOUR [VERTEX]" or "NAME..." takes at most.
std::size_t most_words(std::string_view pattern) {
    if (pattern.find("...") != pattern.npos) return static_cast<std::size_t>(-1);
    return Words(pattern).left();
}

bool is_interrupt(std::string_view line) {
    const auto text = lower(line.substr(0, 100));
    if (text.starts_with("# interrupt")) return true;
    Words words(text.substr(0, text.find('#')));
    if (!words.empty() && words.at_number()) words.take("id");
    return !words.empty() && (words.peek() == "stop" || words.peek() == "gogui-interrupt");
}

bool is_number(std::string_view word) {
    return !word.empty() && word.find_first_not_of("0123456789") == word.npos;
}

}  // namespace

const Gtp::Command Gtp::table_[] = {
    {"protocol_version", &Gtp::protocol_version, "", "version of GTP"},
    {"name", &Gtp::name, "", "name of the engine"},
    {"version", &Gtp::version, "", "version of the engine"},
    {"known_command", &Gtp::known_command, "[COMMAND]", "whether there is such a command"},
    {"list_commands", &Gtp::list_commands, "", "all commands, one a line"},
    {"help", &Gtp::help, "[COMMAND]", "what a command does, or all of them"},
    {"quit", &Gtp::quit, "", "end the program"},
    {"stop", &Gtp::stop, "", "end an analysis"},
    {"clear_cache", &Gtp::clear_cache, "", "forget what the search knows"},
    {"cputime", &Gtp::cpu_time, "", "seconds of processor time used so far"},
    {"gomill-cpu_time", &Gtp::cpu_time, "", "as cputime"},

    {"boardsize", &Gtp::board_size, "SIZE [SIZE]", "empty board of 2 to 25 lines"},
    {"rectangular_boardsize", &Gtp::rectangular_board_size, "X Y", "as boardsize; X equals Y"},
    {"query_boardsize", &Gtp::query_board_size, "", "size of the board"},
    {"clear_board", &Gtp::clear_board, "", "start a new game"},
    {"komi", &Gtp::komi, "KOMI", "a multiple of 0.5 within 1000"},
    {"get_komi", &Gtp::query_komi, "", "komi in force"},
    {"play", &Gtp::play, "COLOUR VERTEX", "play a move; colours need not alternate"},
    {"black", &Gtp::play_black, "VERTEX", "play black VERTEX"},
    {"white", &Gtp::play_white, "VERTEX", "play white VERTEX"},
    {"gogui-play_sequence", &Gtp::play_sequence, "[COLOUR VERTEX]...", "play several moves"},
    {"undo", &Gtp::undo, "", "take the last move back"},
    {"gg-undo", &Gtp::undo_many, "[N]", "take N moves back"},
    {"showboard", &Gtp::show_board, "", "the board, rules, komi and prisoners"},
    {"fixed_handicap", &Gtp::fixed_handicap, "N", "N black stones on the star points"},
    {"place_free_handicap", &Gtp::place_free_handicap, "N", "N black stones of our choice"},
    {"set_free_handicap", &Gtp::set_free_handicap, "VERTEX VERTEX...", "black stones there"},
    {"get_handicap", &Gtp::query_handicap, "", "handicap stones"},
    {"set_position", &Gtp::set_position, "[COLOUR VERTEX]...", "a board of these stones"},
    {"gogui-setup", &Gtp::set_up, "COLOUR VERTEX...", "stones on the empty board"},
    {"gogui-setup_player", &Gtp::setup_player, "COLOUR", "who is to move"},
    {"all_legal", &Gtp::all_legal, "COLOUR", "all legal points"},
    {"is_legal", &Gtp::is_legal, "COLOUR VERTEX", "1 or 0"},
    {"list_stones", &Gtp::list_stones, "COLOUR", "points with a stone of the colour"},
    {"captures", &Gtp::captures, "COLOUR", "prisoners that the colour took"},
    {"last_move", &Gtp::last_move, "", "colour and vertex"},
    {"move_history", &Gtp::move_history, "", "moves so far, the last first"},
    {"kata-get-rules", &Gtp::rules, "", "rules in force, as JSON"},
    {"kata-set-rules", &Gtp::set_rules, "NAME|JSON...", "rules by name or by fields"},
    {"kata-set-rule", &Gtp::set_rule, "FIELD VALUE", "one field of the rules"},
    {"loadsgf", &Gtp::load_sgf, "FILE... [MOVE]", "the main line, to before that move"},
    {"printsgf", &Gtp::print_sgf, "[FILE|-]...", "the game as SGF"},

    {"time_settings", &Gtp::time_settings, "MAIN PERIOD STONES", "seconds; Canadian overtime"},
    {"kgs-time_settings", &Gtp::kgs_time_settings, "KIND [NUMBER]...",
     "none, absolute M, byoyomi M P N or canadian M P S"},
    {"kata-time_settings", &Gtp::kata_time_settings, "KIND [NUMBER]...",
     "as kgs-time_settings, fischer M I, or fischer-capped M I LIMIT MOST"},
    {"kata-list_time_settings", &Gtp::list_time_settings, "", "kinds of kata-time_settings"},
    {"time_left", &Gtp::time_left, "COLOUR SECONDS STONES", "what a side has left"},

    {"genmove", &Gtp::genmove_command, "COLOUR", "think and play"},
    {"reg_genmove", &Gtp::reg_genmove, "COLOUR", "think, and do not play"},
    {"kgs-genmove_cleanup", &Gtp::cleanup, "COLOUR", "play until no dead stone is left"},
    {"lz-genmove_analyze", &Gtp::lz_genmove_analyze, "[COLOUR] [CS] [KEY VALUE]...",
     "genmove with reports"},
    {"kata-genmove_analyze", &Gtp::kata_genmove_analyze, "[COLOUR] [CS] [KEY VALUE]...",
     "genmove with reports"},
    {"genmove_analyze", &Gtp::any_genmove_analyze, "[COLOUR] [CS] [KEY VALUE]...",
     "genmove with reports"},
    {"kata-search_analyze", &Gtp::kata_search_analyze, "[COLOUR] [CS] [KEY VALUE]...",
     "as kata-genmove_analyze, without playing"},
    {"kata-search_analyze_cancellable", &Gtp::kata_search_cancellable,
     "[COLOUR] [CS] [KEY VALUE]...", "likewise, ended by any line"},
    {"lz-analyze", &Gtp::lz_analyze, "[COLOUR] [CS] [KEY VALUE]...", "analyse until any line"},
    {"kata-analyze", &Gtp::kata_analyze, "[COLOUR] [CS] [KEY VALUE]...", "analyse until any line"},
    {"analyze", &Gtp::any_analyze, "[COLOUR] [CS] [KEY VALUE]...", "analyse until any line"},
    {"top_moves", &Gtp::top_moves, "", "best moves of the last search, with winrates"},
    {"debug_moves", &Gtp::debug_moves, "", "all moves of the last search"},
    {"gomill-explain_last_move", &Gtp::explain_last_move, "", "the last search in a line"},
    {"kata-benchmark", &Gtp::benchmark, "VISITS", "search this position and say how fast"},
    {"final_score", &Gtp::final_score, "", "result, dead stones off where rules agree on them"},
    {"estimate_score", &Gtp::estimate_score, "", "expected lead from the games played out"},
    {"final_status_list", &Gtp::final_status_list, "alive|seki|dead", "stones of that fate"},
    {"final_status", &Gtp::final_status, "VERTEX", "fate of one stone"},

    {"kata-raw-nn", &Gtp::kata_raw_nn, "[COLOUR] 0-7|all", "what the network says, as KataGo does"},
    {"heatmap", &Gtp::heatmap, "[all|average|0-7]", "what it says, as Leela Zero does"},

    {"gogui-analyze_commands", &Gtp::gogui_commands, "", "what GoGui can show"},
    {"gogui-interrupt", &Gtp::nothing, "", "genmove may be cut short by `# interrupt`"},
    {"gogui-title", &Gtp::gogui_title, "", "title for the window"},
    {"sanban-ownership", &Gtp::gogui_ownership, "", "expected owner of each point"},
    {"sanban-visits", &Gtp::gogui_visits, "", "visits of each move"},
    {"sanban-variation", &Gtp::gogui_variation, "", "principal variation"},
    {"kgs-chat", &Gtp::chat, "KIND NAME [MESSAGE]...", "answer a chat message"},
    {"kgs-game_over", &Gtp::nothing, "", "the server's word that the game has ended"},
    {"level", &Gtp::level, "N", "strength from 0 to 20, which is full"},
    {"get_random_seed", &Gtp::random_seed, "", "seed of all randomness"},
    {"set_random_seed", &Gtp::set_random_seed, "SEED", "seed of all randomness"},
    {"lz-setoption", &Gtp::set_option, "name NAME... value VALUE", "options by Leela Zero's names"},
    {"lz-memory_report", &Gtp::memory_report, "", "share of the memory that is used"},
    {"kata-list-params", &Gtp::list_params, "", "names for kata-get-param"},
    {"kata-get-params", &Gtp::all_params, "", "all parameters, as JSON"},
    {"kata-get-param", &Gtp::param, "NAME", "a parameter's value"},
    {"kata-set-param", &Gtp::set_param, "NAME VALUE...", "set a parameter; WeightsFile: a network"},
    {"kata-set-params", &Gtp::set_params, "JSON...", "set several"},
};

std::span<const Gtp::Command> Gtp::commands() { return table_; }

std::string Gtp::manual() {
    std::string text = "| command | arguments | what it does |\n|---|---|---|\n";
    for (const auto& command : commands()) {
        std::string arguments(command.arguments);
        for (std::size_t at = 0; (at = arguments.find('|', at)) != arguments.npos; at += 2)
            arguments.insert(at, 1, '\\');
        text += fmt::format("| `{}` | {} | {} |\n", command.name, arguments, command.help);
    }
    return text;
}

Gtp::Gtp(const GtpSettings& settings, const search::SearchParams& params, Output& out)
    : settings_(settings), out_(out), session_(params), judge_(params) {
    restart(go::Go(settings.size, go::Komi::from_points(settings.komi), settings.rules));
    if (!settings.weights.empty()) load_weights(settings.weights);
}

Gtp::~Gtp() { session_.stop(); }

const Gtp::Command* Gtp::find(std::string_view name) {
    const auto table = commands();
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const Command& command) { return command.name == name; });
    return found == table.end() ? nullptr : &*found;
}

void Gtp::serve(std::istream& in) {
    InputAhead input(in, [this](const Line& line) { arrived(line.text); });
    input_ = &input;
    for (Line line; !quitting_ && input.pop(line);) {
        if (line.too_long) {
            end_analysis();
            id_.clear();
            answer('?', fmt::format("a line is longer than {} bytes", longest_line));
        } else {
            handle(line.text);
        }
        if (!analysing_ && !quitting_) ponder();
    }
    input_ = nullptr;
    end_analysis();
}

void Gtp::arrived(std::string_view line) {
    const std::lock_guard lock(cut_mutex_);
    if (cut_ == Cut::by_none || (cut_ == Cut::by_interrupt && !is_interrupt(line))) return;
    was_cut_ = true;
    judge_.interrupt();
    session_.interrupt();
}

bool Gtp::handle(std::string_view line) {
    end_analysis();
    Words words(line.substr(0, line.find('#')));
    if (words.empty()) return true;
    session_.stop();  // a ponder
    id_.clear();
    if (is_number(words.peek())) id_ = words.take("id");
    if (words.empty()) return answer('?', "the command is missing"), true;
    const Command* command = find(words.take("the command"));
    if (!command) return answer('?', "unknown command"), true;
    run(*command, words);
    return !quitting_;
}

void Gtp::run(const Command& command, Words& words) {
    answered_ = false;
    try {
        // Too few are missed by name when the command takes them.
        if (words.left() > most_words(command.arguments))
            engine::fail("too many words: {} {}", command.name, command.arguments);
        const auto text = (this->*command.run)(words);
        if (!answered_) answer('=', text);
    } catch (const engine::Error& error) {
        // After the first line of a streamed answer only its end is left to say.
        if (answered_)
            out_.line("");
        else
            answer('?', error.what());
    }
}

void Gtp::answer(char sign, std::string_view text) {
    answered_ = true;
    out_.line(fmt::format("{}{} {}\n", sign, id_, text));
}

void Gtp::begin_stream() {
    answered_ = true;
    out_.line(fmt::format("={}", id_));
}

void Gtp::end_analysis() {
    if (!analysing_) return;
    session_.stop();
    analysing_ = false;
    last_picture_ = session_.searcher().analysis();
    out_.line("");
}

void Gtp::ponder() {
    if (!settings_.ponder || !ponder_on_ || !(*ponder_on_ == now())) return;
    session_.start({}, {}, {});
}

}  // namespace protocols
