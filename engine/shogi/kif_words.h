// The words of KIF, shared by its reader and its writer.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "engine/shogi/record.h"

namespace shogi::kif {

struct NamedKind {
    std::string_view name;
    Kind kind;
};
// The first name of a kind is the one written; a name comes before another that begins it.
inline constexpr std::array kinds{NamedKind{"歩", Kind::pawn},
                                  NamedKind{"香", Kind::lance},
                                  NamedKind{"桂", Kind::knight},
                                  NamedKind{"銀", Kind::silver},
                                  NamedKind{"金", Kind::gold},
                                  NamedKind{"角", Kind::bishop},
                                  NamedKind{"飛", Kind::rook},
                                  NamedKind{"玉", Kind::king},
                                  NamedKind{"王", Kind::king},
                                  NamedKind{"と", Kind::tokin},
                                  NamedKind{"成歩", Kind::tokin},
                                  NamedKind{"成香", Kind::promoted_lance},
                                  NamedKind{"成桂", Kind::promoted_knight},
                                  NamedKind{"成銀", Kind::promoted_silver},
                                  NamedKind{"馬", Kind::horse},
                                  NamedKind{"成角", Kind::horse},
                                  NamedKind{"龍", Kind::dragon},
                                  NamedKind{"竜", Kind::dragon},
                                  NamedKind{"成飛", Kind::dragon},
                                  NamedKind{"杏", Kind::promoted_lance},
                                  NamedKind{"圭", Kind::promoted_knight},
                                  NamedKind{"全", Kind::promoted_silver}};
// Promoted pieces of two letters have one on a diagram.
inline constexpr std::array diagram_kinds{NamedKind{"杏", Kind::promoted_lance},
                                          NamedKind{"圭", Kind::promoted_knight},
                                          NamedKind{"全", Kind::promoted_silver}};

inline constexpr std::array<std::string_view, 10> wide_digits{"０", "１", "２", "３", "４",
                                                              "５", "６", "７", "８", "９"};
inline constexpr std::array<std::string_view, 11> kanji_digits{"〇", "一", "二", "三", "四", "五",
                                                               "六", "七", "八", "九", "十"};

struct NamedEnding {
    std::string_view name;
    Ending ending;
};
inline constexpr std::array endings{NamedEnding{"投了", Ending::resignation},
                                    NamedEnding{"詰み", Ending::mate},
                                    NamedEnding{"詰", Ending::mate},
                                    NamedEnding{"千日手", Ending::repetition},
                                    NamedEnding{"持将棋", Ending::impasse},
                                    NamedEnding{"入玉勝ち", Ending::declaration},
                                    NamedEnding{"宣言勝ち", Ending::declaration},
                                    NamedEnding{"引き分け", Ending::draw},
                                    NamedEnding{"引分", Ending::draw},
                                    NamedEnding{"最大手数", Ending::move_limit},
                                    NamedEnding{"切れ負け", Ending::time_up},
                                    NamedEnding{"時間切れ", Ending::time_up},
                                    NamedEnding{"Time-up", Ending::time_up},
                                    NamedEnding{"反則負け", Ending::foul},
                                    NamedEnding{"反則勝ち", Ending::foul_of_opponent},
                                    NamedEnding{"不戦敗", Ending::forfeit},
                                    NamedEnding{"中断", Ending::interrupted},
                                    NamedEnding{"封じ手", Ending::interrupted},
                                    NamedEnding{"待った", Ending::taken_back},
                                    NamedEnding{"エラー", Ending::error},
                                    NamedEnding{"不詰", Ending::no_mate}};

struct Handicap {
    std::string_view name, sfen;
};
// White is the stronger player, who gives and moves first.
inline constexpr std::array handicaps{
    Handicap{"平手", "startpos"},
    Handicap{"香落ち", "lnsgkgsn1/1r5b1/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"右香落ち", "1nsgkgsnl/1r5b1/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"角落ち", "lnsgkgsnl/1r7/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"飛車落ち", "lnsgkgsnl/7b1/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"飛香落ち", "lnsgkgsn1/7b1/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"二枚落ち", "lnsgkgsnl/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"三枚落ち", "lnsgkgsn1/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"四枚落ち", "1nsgkgsn1/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"五枚落ち", "2sgkgsn1/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"左五枚落ち", "1nsgkgs2/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"六枚落ち", "2sgkgs2/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"左七枚落ち", "2sgkg3/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"右七枚落ち", "3gkgs2/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"八枚落ち", "3gkg3/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"},
    Handicap{"十枚落ち", "4k4/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1"}};

}  // namespace shogi::kif
