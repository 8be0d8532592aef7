#include "engine/shogi/problem.h"

#include "engine/base/error.h"
#include "engine/base/option.h"
#include "engine/base/text.h"

namespace shogi {

namespace {

std::string_view first_word(std::string_view text) { return engine::take_word(text); }

// The position's fields, the last of which may be missing.
std::string take_sfen(std::string_view& text) {
    for (const std::string_view word : {"position", "sfen"})
        if (first_word(text) == word) engine::take_word(text);
    std::string sfen;
    for (int field = 0; field < 4; ++field) {
        const auto word = first_word(text);
        if (field == 3 && (word.empty() || !engine::is_digit(word[0]))) break;
        const bool closed = word.ends_with(';');
        sfen.append(field > 0 ? " " : "").append(word.substr(0, word.size() - (closed ? 1 : 0)));
        engine::take_word(text);
        if (closed) break;
    }
    return sfen;
}

std::vector<Move> moves_from(std::string_view text, const Shogi& game) {
    std::vector<Move> moves;
    for (auto word = engine::take_word(text); !word.empty(); word = engine::take_word(text)) {
        const auto move = game.move_from_text(word);
        if (!move)
            engine::fail("\"{}\" is not a legal move in {}", engine::excerpt(word), game.to_text());
        moves.push_back(*move);
    }
    return moves;
}

void accept(std::string_view operation, Problem& problem) {
    std::string_view operands = operation;
    const auto name = engine::take_word(operands);
    operands = engine::trimmed(operands);
    if (name == "bm")
        problem.best = moves_from(operands, problem.game);
    else if (name == "am")
        problem.avoid = moves_from(operands, problem.game);
    else if (name == "id")
        problem.id = engine::unquoted(operands);
    else if (name == "dm")
        problem.mate_plies = engine::parse_number<int>(operands);
}

}  // namespace

Problem problem_from_sfen(std::string_view line) {
    Problem problem;
    problem.game = Shogi::from_text(take_sfen(line));
    while (!engine::trimmed(line).empty())
        if (const auto operation = engine::take_operation(line); !operation.empty())
            accept(operation, problem);
    return problem;
}

}  // namespace shogi
