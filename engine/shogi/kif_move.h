// One move of KIF or KI2 read off a text, before it is known what piece it means.
#pragma once

#include <optional>
#include <string_view>

#include "engine/shogi/position.h"

namespace shogi::kif {

// Takes what it understands off the front of a text.
class Scanner {
   public:
    explicit Scanner(std::string_view text) : text_(text) {}
    std::string_view rest() const { return text_; }
    bool take(std::string_view word);
    // ASCII and wide ones.
    void skip_blanks();
    // 1 to 9, in ASCII, wide or kanji.
    std::optional<int> take_digit();
    std::optional<Kind> take_kind();

   private:
    std::string_view text_;
};

// The move that stands first in the scanner's text, in `position` after the move `before`: with
// the square it comes from in brackets (KIF) or by words such as 右 and 直 where they are needed
// (KI2). Empty when there is none, or when the words fit several.
std::optional<Move> take_move(Scanner& scanner, const Position& position, Move before);

}  // namespace shogi::kif
