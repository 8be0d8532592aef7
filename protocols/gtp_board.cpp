// GTP commands about the position: board, moves, handicap, rules, SGF.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/files.h"
#include "protocols/gtp.h"

namespace protocols {

namespace {

using engine::Player;

char letter(Player player) { return player == Player::first ? 'B' : 'W'; }

// A board like `game`'s without stones.
go::Go emptied(const go::Go& game, int size) { return go::Go(size, game.komi(), game.rules()); }

// The first game of an SGF file.
go::sgf::Record read_record(const std::string& path, int most_moves) {
    const auto text = go::sgf::read_file(path);
    try {
        const auto tree = go::sgf::GameReader(text).next();
        if (!tree) engine::fail("no game in it");
        return go::sgf::main_line(*tree, most_moves);
    } catch (const engine::Error& error) {
        engine::fail("{}: {}", path, error.what());
    }
}

}  // namespace

void Gtp::restart(const go::Go& start) {
    session_.restart(start);
    turns_.clear();
    clock_.restart();
    hopeless_moves_.fill(0);
    result_.clear();
    forget();
}

void Gtp::play(Player player, go::Move move) {
    go::Go next = now();
    next.set_to_play(player);
    next.play(move);
    session_.append(next);
    turns_.push_back({player, move});
    result_.clear();
}

go::Point Gtp::vertex_of(std::string_view text) const {
    const auto point = go::point_from_vertex(text, now().size());
    if (!point) {
        const auto corner = go::vertex({now().size() - 1, now().size() - 1});
        engine::fail("{} is no point of this board (A1..{}, without I)", text.substr(0, 20),
                     corner);
    }
    return *point;
}

void Gtp::play_checked(Player player, std::string_view vertex) {
    const auto word = lower(vertex.substr(0, 20));
    if (word == "resign") {
        result_ = fmt::format("{}+R", letter(~player));
        return;
    }
    const go::Move move = word == "pass" ? go::Go::pass : now().move_at(vertex_of(vertex));
    go::Go game = now();
    game.set_to_play(player);
    if (const auto why = game.why_illegal(move); !why.empty())
        engine::fail("illegal move: {} ({})", vertex, why);
    play(player, move);
}

std::string Gtp::points_text(std::span<const go::Point> points) const {
    std::string text;
    for (const auto& point : points) text.append(text.empty() ? "" : " ").append(go::vertex(point));
    return text;
}

bool Gtp::board_empty() const {
    const auto& stones = now().board().stones();
    return stones[0].none() && stones[1].none();
}

void Gtp::resize(int size) {
    const auto start = emptied(now(), size);
    session_.prepare_for(start);
    restart(start);
}

std::string Gtp::board_size(Words& words) {
    const int size = words.whole("the size", go::min_size, go::max_size);
    if (!words.empty() && words.whole("the height", go::min_size, go::max_size) != size)
        engine::fail("boards are square");
    resize(size);
    return "";
}

std::string Gtp::rectangular_board_size(Words& words) {
    if (words.left() < 2) engine::fail("two sizes are needed");
    return board_size(words);
}

std::string Gtp::query_board_size(Words&) { return std::to_string(now().size()); }

std::string Gtp::clear_board(Words&) {
    resize(now().size());
    session_.new_game();
    return "";
}

std::string Gtp::komi(Words& words) {
    const auto komi = go::Komi::from_points(words.number("komi", -1000, 1000));
    session_.change_all([&](go::Go& game) { game.set_komi(komi); });
    return "";
}

std::string Gtp::query_komi(Words&) { return fmt::format("{:g}", now().komi().points()); }

std::string Gtp::play(Words& words) {
    const auto player = words.colour();
    play_checked(player, words.take("the vertex"));
    return "";
}

std::string Gtp::play_sequence(Words& words) {
    const auto before = turns_.size();
    const auto result = result_;
    try {
        while (!words.empty()) {
            const auto player = words.colour();
            play_checked(player, words.take("the vertex"));
        }
    } catch (const engine::Error&) {
        while (turns_.size() > before) take_back();
        result_ = result;
        throw;
    }
    return "";
}

std::string Gtp::undo(Words&) {
    if (turns_.empty()) engine::fail("cannot undo: no move has been played");
    take_back();
    return "";
}

void Gtp::take_back() {
    session_.undo();
    turns_.pop_back();
    result_.clear();
    hopeless_moves_.fill(0);
}

std::string Gtp::play_black(Words& words) {
    play_checked(Player::first, words.take("the vertex"));
    return "";
}

std::string Gtp::play_white(Words& words) {
    play_checked(Player::second, words.take("the vertex"));
    return "";
}

std::string Gtp::undo_many(Words& words) {
    const auto played = static_cast<int>(turns_.size());
    if (played == 0) engine::fail("cannot undo: no move has been played");
    const int moves = words.empty() ? 1 : words.whole("the number of moves", 0, played);
    for (int i = 0; i < moves; ++i) take_back();
    return "";
}

std::string Gtp::show_board(Words&) {
    auto text = fmt::format("\n{}", go::diagram(now()));
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

void Gtp::start_handicap(std::span<const go::Point> points) {
    auto game = emptied(now(), now().size());
    for (const auto& point : points) {
        if (game.at(point)) engine::fail("{} is named twice", go::vertex(point));
        game.set_up(point, Player::first);
    }
    if (points.size() < 2 || !game.every_chain_has_liberty())
        engine::fail("a handicap has at least 2 stones, each with a liberty");
    game.set_handicap(static_cast<int>(points.size()));
    game.set_to_play(Player::second);
    restart(game);
}

std::string Gtp::fixed_handicap(Words& words) {
    if (!board_empty()) engine::fail("the board is not empty");
    const int size = now().size(), most = go::most_fixed_handicap(size);
    if (most < 2) engine::fail("a board of size {} has no fixed handicap", size);
    const auto points = go::fixed_handicap(size, words.whole("the handicap", 2, most));
    start_handicap(points);
    return points_text(points);
}

std::string Gtp::place_free_handicap(Words& words) {
    if (!board_empty()) engine::fail("the board is not empty");
    const int size = now().size();
    const auto points = go::free_handicap(size, words.whole("the handicap", 2, size * size - 1));
    start_handicap(points);
    return points_text(points);
}

std::string Gtp::set_free_handicap(Words& words) {
    if (!board_empty()) engine::fail("the board is not empty");
    std::vector<go::Point> points;
    while (!words.empty()) points.push_back(vertex_of(words.take("the vertex")));
    start_handicap(points);
    return "";
}

std::string Gtp::query_handicap(Words&) { return std::to_string(now().handicap()); }

// A board like the present one with only the stones that `words` name.
go::Go Gtp::with_stones(Words& words) const {
    auto game = emptied(now(), now().size());
    while (!words.empty()) {
        const auto player = words.colour();
        const auto point = vertex_of(words.take("the vertex"));
        if (game.at(point)) engine::fail("{} is named twice", go::vertex(point));
        game.set_up(point, player);
    }
    if (!game.every_chain_has_liberty()) engine::fail("a chain has no liberty");
    return game;
}

std::string Gtp::set_position(Words& words) {
    restart(with_stones(words));
    return "";
}

std::string Gtp::set_up(Words& words) {
    if (!board_empty()) engine::fail("the board is not empty");
    restart(with_stones(words));
    return "";
}

std::string Gtp::setup_player(Words& words) {
    auto game = now();
    game.set_to_play(words.colour());
    session_.replace_last(game);
    return "";
}

std::string Gtp::all_legal(Words& words) {
    go::Go game = now();
    game.set_to_play(words.colour());
    std::vector<go::Point> legal;
    for (int y = 0; y < game.size(); ++y)
        for (int x = 0; x < game.size(); ++x)
            if (game.legal(game.move_at({x, y}))) legal.push_back({x, y});
    return points_text(legal);
}

std::string Gtp::is_legal(Words& words) {
    go::Go game = now();
    game.set_to_play(words.colour());
    const auto vertex = words.take("the vertex");
    return game.move_from_text(vertex) ? "1" : "0";
}

std::string Gtp::list_stones(Words& words) {
    const auto player = words.colour();
    std::vector<go::Point> stones;
    for (int y = 0; y < now().size(); ++y)
        for (int x = 0; x < now().size(); ++x)
            if (now().at({x, y}) == player) stones.push_back({x, y});
    return points_text(stones);
}

std::string Gtp::captures(Words& words) {
    return std::to_string(now().captured_by(words.colour()));
}

std::string Gtp::last_move(Words&) {
    if (turns_.empty()) engine::fail("no move has been played");
    const auto& [player, move] = turns_.back();
    return fmt::format("{} {}", player == Player::first ? "black" : "white",
                       now().move_to_text(move));
}

std::string Gtp::move_history(Words&) {
    std::string text;
    for (auto turn = turns_.rbegin(); turn != turns_.rend(); ++turn)
        text += fmt::format("{}{} {}", text.empty() ? "" : "\n",
                            turn->player == Player::first ? "black" : "white",
                            now().move_to_text(turn->move));
    return text;
}

std::string Gtp::rules(Words&) { return go::to_json(now().rules()); }

std::string Gtp::set_rules(Words& words) {
    const auto rules = go::rules_from_text(words.rest(), now().rules());
    session_.change_all([&](go::Go& game) { game.set_rules(rules); });
    return "";
}

std::string Gtp::set_rule(Words& words) {
    auto rules = now().rules();
    const auto field = words.take("the field");
    go::set_rule(rules, field, words.take("the value"));
    session_.change_all([&](go::Go& game) { game.set_rules(rules); });
    return "";
}

std::string Gtp::load_sgf(Words& words) {
    if (words.empty()) engine::fail("the file is missing");
    // A path may hold blanks; a number behind it is the move.
    auto path = words.rest();
    int most = 1 << 16;
    if (const auto blank = path.rfind(' '); blank != path.npos) {
        Words last(path.substr(blank + 1));
        if (last.peek().find_first_not_of("0123456789") == std::string::npos) {
            most = std::max(last.whole("the move", 0, 1 << 16) - 1, 0);
            path.resize(blank);
        }
    }
    const auto record = read_record(path, most);
    restart(record.start);
    for (const auto& turn : record.turns) play(turn.player, turn.move);
    session_.replace_last(record.end);
    return record.end.to_play() == Player::first ? "black" : "white";
}

std::string Gtp::result_text() {
    if (!result_.empty()) return result_;
    if (now().no_result()) return "Void";
    if (now().consecutive_passes() < 2) return "";
    return reading().score().text();
}

std::string Gtp::print_sgf(Words& words) {
    const std::vector<go::sgf::Property> facts{{"AP", {"sanban:" SANBAN_VERSION}}};
    const auto tree = go::sgf::tree_of(session_.states().front(), turns_, result_text(), facts);
    auto text = go::sgf::to_text(tree);
    while (text.ends_with('\n')) text.pop_back();
    const auto path = words.rest();
    if (path.empty() || path == "-") return text;
    text += "\n";
    engine::write_file(path, text);
    return "";
}

}  // namespace protocols
