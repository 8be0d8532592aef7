#include "protocols/terminal.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>
#include <sstream>

#include "protocols/lines.h"

namespace protocols {

namespace {

constexpr std::string_view manual =
    "  a move    play it, as in: {}\n"
    "  hint      what the engine would play here\n"
    "  undo      take your last move back\n"
    "  save F    write the game to the file F\n"
    "  switch    change sides\n"
    "  resign    give the game up\n"
    "  quit      leave\n";

}  // namespace

Terminal::Terminal(const TerminalSettings& settings, Session& session, TerminalView view,
                   std::istream& in, std::ostream& out)
    : settings_(settings), session_(session), view_(std::move(view)), in_(in), out_(out) {}

std::string Terminal::name_of(engine::Player player) const {
    return player == engine::Player::first ? view_.first_name : view_.second_name;
}

void Terminal::run() {
    fmt::print(out_, "You are {}. Type a move ({}), or help.\n", name_of(settings_.human),
               view_.move_example);
    for (;;) {
        // Now and not at the end, so that no signal or crash can lose the game.
        if (!settings_.record.empty()) view_.save(settings_.record, resigned_);
        fmt::print(out_, "\n{}\n", view_.board());
        const bool over = resigned_ || session_.outcome() != engine::Outcome::ongoing;
        if (over)
            fmt::print(out_, "The game is over: {}\n", resigned_ ? "you resigned" : view_.result());
        if (over || session_.to_play() == settings_.human) {
            if (!human_turn()) return;
        } else {
            engine_turn();
        }
    }
}

bool Terminal::human_turn() {
    for (;;) {
        fmt::print(out_, "{}> ", name_of(session_.to_play()));
        out_.flush();
        Line line;
        if (!read_line(in_, line)) return false;
        try {
            if (line.text == "quit" || line.text == "exit") return false;
            if (obey(line.text)) return true;
        } catch (const engine::Error& error) {
            fmt::print(out_, "{}\n", error.what());
        }
    }
}

// True when the board has changed.
bool Terminal::obey(const std::string& line) {
    std::istringstream in(line);
    std::string word, rest;
    if (!(in >> word)) return false;
    std::getline(in >> std::ws, rest);
    if (word == "help") {
        fmt::print(out_, fmt::runtime(manual), view_.move_example);
    } else if (word == "hint") {
        hint();
    } else if (word == "save") {
        if (rest.empty()) engine::fail("save needs the name of a file");
        view_.save(rest, resigned_);
        fmt::print(out_, "saved to {}\n", rest);
    } else if (word == "undo") {
        take_back();
        return true;
    } else if (word == "resign") {
        resigned_ = true;
        return true;
    } else if (word == "switch") {
        settings_.human = ~settings_.human;
        return true;
    } else {
        if (session_.outcome() != engine::Outcome::ongoing)
            engine::fail("the game is over: undo, save or quit");
        if (!session_.move_from_text(word))
            engine::fail("{} is neither a legal move nor a command (help lists them)", word);
        session_.play(word);
        return true;
    }
    return false;
}

// Back to where the human is to move again.
void Terminal::take_back() {
    resigned_ = false;
    if (!session_.undo()) engine::fail("there is nothing to undo");
    if (session_.to_play() != settings_.human) session_.undo();
}

search::Analysis Terminal::think() {
    search::Limits limits;
    if (settings_.simulations > 0)
        limits.simulations = settings_.simulations;
    else
        limits.time = search::Milliseconds(std::llround(settings_.seconds * 1000));
    std::optional<search::Analysis> found;
    session_.start(limits, {}, [&](const search::Analysis& picture) { found = picture; });
    session_.wait();
    if (!found->fault.empty()) engine::fail("the search broke off: {}", found->fault);
    return *found;
}

void Terminal::engine_turn() {
    fmt::print(out_, "{} thinks ...", name_of(session_.to_play()));
    out_.flush();
    const auto picture = think();
    const auto text =
        view_.choose ? view_.choose(picture) : session_.move_to_text(picture.moves.front().move);
    fmt::print(out_, " {}\n", text);
    session_.play(text);
}

void Terminal::hint() {
    const auto picture = think();
    if (picture.moves.empty()) engine::fail("there is no move to suggest");
    const auto& best = picture.moves.front();
    fmt::print(out_, "{} (wins {:.0f} % of the games tried); expected: {}\n",
               session_.move_to_text(best.move), 50 * (best.value + 1),
               session_.line_to_text(best.variation));
}

}  // namespace protocols
