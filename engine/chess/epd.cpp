#include "engine/chess/epd.h"

#include "engine/base/error.h"
#include "engine/base/option.h"
#include "engine/base/text.h"
#include "engine/chess/fen.h"
#include "engine/chess/san.h"

namespace chess {

namespace {

bool starts_with_digit(std::string_view text) {
    text = engine::trimmed(text);
    return !text.empty() && engine::is_digit(text.front());
}

// The position's fields: the counters may stand there as in FEN.
std::string take_fen(std::string_view& text) {
    std::string fen;
    for (int field = 0; field < 6; ++field) {
        if (field >= 4 && !starts_with_digit(text)) break;
        if (field > 0) fen += ' ';
        fen += engine::take_word(text);
    }
    return fen;
}

std::vector<Move> moves_from(std::string_view text, const Position& position) {
    std::vector<Move> moves;
    for (auto word = engine::take_word(text); !word.empty(); word = engine::take_word(text)) {
        const auto move = move_from_san_or_uci(position, word);
        if (!move)
            engine::fail("EPD: \"{}\" is not a legal move in {}", engine::excerpt(word),
                         fen(position));
        moves.push_back(*move);
    }
    return moves;
}

// "f5=10, Be5+=2"; empty unless all of it is like that, for c0 is free text.
std::vector<Problem::Points> points_from(std::string_view text, const Position& position) {
    std::vector<Problem::Points> points;
    while (!text.empty()) {
        const auto comma = std::min(text.find(','), text.size());
        const auto item = engine::trimmed(text.substr(0, comma));
        text.remove_prefix(std::min(comma + 1, text.size()));
        const auto equals = item.rfind('=');
        if (equals == item.npos || item.size() - equals > 4 ||
            !starts_with_digit(item.substr(equals + 1)))
            return {};
        const auto move = move_from_san_or_uci(position, item.substr(0, equals));
        if (!move) return {};
        points.push_back({*move, engine::parse_number<int>(item.substr(equals + 1))});
    }
    return points;
}

void accept(std::string_view operation, Problem& problem) {
    std::string_view operands = operation;
    const auto name = engine::take_word(operands);
    operands = engine::trimmed(operands);
    const Position& position = problem.game.position();
    if (name == "bm")
        problem.best = moves_from(operands, position);
    else if (name == "am")
        problem.avoid = moves_from(operands, position);
    else if (name == "id")
        problem.id = engine::unquoted(operands);
    else if (name == "dm")
        problem.mate_in = engine::parse_number<int>(operands);
    else
        problem.others.emplace_back(operation);
    if (name == "c0") problem.points = points_from(engine::unquoted(operands), position);
}

}  // namespace

Problem problem_from_epd(std::string_view line) {
    Problem problem;
    problem.game = Chess::from_text(take_fen(line));
    while (!engine::trimmed(line).empty())
        if (const auto operation = engine::take_operation(line); !operation.empty())
            accept(operation, problem);
    return problem;
}

}  // namespace chess
