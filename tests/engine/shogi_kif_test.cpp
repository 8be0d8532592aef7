// KIF and KI2: what is read, what is written, what is refused, and the real games in ../shared.
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/random.h"
#include "engine/shogi/kif.h"
#include "engine/shogi/usi.h"
#include "tests/engine/shogi_data.h"

namespace shogi::kif {
namespace {

constexpr std::string_view branching = R"(#KIF version=2.0 encoding=UTF-8
棋戦：王座戦
手合割：平手
先手：鈴木大介
後手：深浦康市
手数----指手---------消費時間--
*始め
   1 ７六歩(77)   ( 0:12/00:00:12)
   2 ３四歩(33)   ( 1:05/00:01:05)+
*角道
   3 ２二角成(88)   ( 0:03/00:00:15)+
   4 同　銀(31)   ( 0:00/00:01:05)
   5 ５五角打   ( 0:01/00:00:16)
   6 投了

変化：3手
   3 ６六歩(67)
   4 中断

変化：2手
   2 ８四歩(83)
   3 ２六歩(27)
)";

std::string moves_of(const Record& record) {
    std::string text;
    for (const Move move : record.main_line()) text += to_usi(move) + ' ';
    return text;
}

TEST(ShogiKif, ReadsAGameWithVariations) {
    const auto record = parse(branching);
    EXPECT_EQ(record.black, "鈴木大介");
    EXPECT_EQ(record.white, "深浦康市");
    EXPECT_EQ(record.facts, (std::vector<Fact>{{"棋戦", "王座戦"}}));
    EXPECT_EQ(moves_of(record), "7g7f 3c3d 8h2b+ 3a2b B*5e ");
    EXPECT_EQ(record.ending(), Ending::resignation);
    EXPECT_EQ(record.outcome(), Outcome::first_wins);
    ASSERT_EQ(record.nodes.size(), 9u);
    EXPECT_EQ(record.nodes[0].comment, "始め");
    EXPECT_EQ(record.nodes[2].comment, "角道");
    EXPECT_EQ(record.nodes[2].seconds, 65);
    EXPECT_EQ(record.nodes[1].children, (std::vector<std::uint32_t>{2, 7}));
    EXPECT_EQ(record.nodes[2].children, (std::vector<std::uint32_t>{3, 6}));
    EXPECT_EQ(record.nodes[6].ending, Ending::interrupted);
    EXPECT_EQ(to_usi(record.nodes[8].move), "2g2f");
}

TEST(ShogiKif, WritesWhatItReads) {
    const auto record = parse(branching);
    EXPECT_EQ(to_text(record), branching);
    EXPECT_EQ(parse(to_shift_jis(record)), record);
}

// The same squares in print, told apart by words.
TEST(ShogiKif, ReadsPrint) {
    const auto record = parse(
        "▲７六歩 △８四歩 ▲７八金 △８五歩\n▲７七角△３四歩▲８八銀△７七角成\n"
        "▲同 銀△２二銀▲３八銀△７二銀▲５八金 △投了\n");
    EXPECT_EQ(moves_of(record),
              "7g7f 8c8d 6i7h 8d8e 8h7g 3c3d 7i8h 2b7g+ 8h7g 3a2b 3i3h 7a7b 4i5h ");
    EXPECT_EQ(record.outcome(), Outcome::first_wins);
}

struct Printed {
    const char *sfen, *text, *usi;
};

TEST(ShogiKif, WordsOfPrintTellPiecesApart) {
    constexpr auto golds = "4k4/9/9/9/9/9/9/3G1G3/K3G4 b - 1";
    constexpr auto horses = "4k4/9/9/9/9/4+B4/9/9/K3+B4 b - 1";
    for (const auto& [sfen, text, usi] :
         {Printed{golds, "▲５八金右", "4h5h"}, Printed{golds, "▲５八金左", "6h5h"},
          Printed{golds, "▲５八金直", "5i5h"}, Printed{golds, "▲５八金上", "5i5h"},
          Printed{horses, "▲５八馬引", ""}, Printed{horses, "▲５八馬上", "5i5h"},
          Printed{horses, "▲５七馬引", "5f5g"}}) {
        const auto game = Shogi::from_text(sfen);
        auto whole = to_text(record_of(game, {}, Ending::none)) + text + "\n";
        if (std::string_view(usi).empty())
            EXPECT_THROW(parse(whole), engine::Error) << text;
        else
            EXPECT_EQ(moves_of(parse(whole)), std::string(usi) + ' ') << text;
    }
}

TEST(ShogiKif, Handicaps) {
    const auto record = parse("手合割：二枚落ち\n下手：a\n上手：b\n1 ６二銀(71)\n2 ７六歩(77)\n");
    EXPECT_EQ(record.start.to_text(),
              "lnsgkgsnl/9/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL w - 1");
    EXPECT_EQ(record.black, "a");
    EXPECT_EQ(moves_of(record), "7a6b 7g7f ");
    EXPECT_EQ(parse(to_text(record)), record);
}

TEST(ShogiKif, Diagrams) {
    for (const char* sfen :
         {"8l/1l+R2P3/p2pBG1pp/kps1p4/Nn1P2G2/P1P1P2PP/1PS6/1KSG3+r1/LN2+p3L w Sbgn3p 1",
          "k8/9/9/9/9/9/4+L4/4+N4/4+S4 b 2G 1", "4k4/9/9/9/9/9/9/9/4K4 b 2R2B4G4S4N4L18P 1"}) {
        const auto start = Shogi::from_text(sfen);
        const auto text = to_text(record_of(start, {}, Ending::none));
        EXPECT_EQ(parse(text).start, start) << text;
    }
}

TEST(ShogiKif, EveryMoveSurvives) {
    engine::Random random(11);
    for (int i = 0; i < 20; ++i) {
        Shogi game;
        std::vector<Move> moves;
        while (game.outcome() == Outcome::ongoing && moves.size() < 200) {
            const auto legal = game.legal_moves();
            moves.push_back(legal[random.below(legal.size())]);
            game.play(moves.back());
        }
        const auto record = record_of(Shogi(), moves, Ending::none);
        EXPECT_EQ(parse(to_text(record)), record);
    }
}

TEST(ShogiKif, RefusesWithPlaceAndReason) {
    const auto reason = [](std::string_view text) -> std::string {
        try {
            parse(text);
        } catch (const engine::Error& error) {
            return error.what();
        }
        return "taken";
    };
    EXPECT_EQ(reason("1 ７六歩(77)\n2 ７五歩(76)\n").substr(0, 19), "KIF: line 2: move 2");
    EXPECT_NE(reason("1 ７五歩(77)\n").find("(77)) is illegal"), std::string::npos);
    EXPECT_NE(reason("1 同　歩(77)\n").find("is none"), std::string::npos);
    EXPECT_EQ(reason("1 ７六歩(77)\n変化：9手\n"),
              "KIF: line 2: a variation of move 9, which no line has");
    EXPECT_EQ(reason("1 ７六歩(77)\nwhat\n"), "KIF: line 2: not understood: what");
    EXPECT_EQ(reason("先手の持駒：王\n").substr(0, 32), "KIF: line 1: no pieces in hand: ");
    EXPECT_EQ(reason("|v玉|\n").substr(0, 31), "KIF: line 1: no piece on the bo");
}

TEST(ShogiKif, Noise) {
    engine::Random random(5);
    int taken = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string text(branching.substr(
            0, static_cast<std::size_t>(random.below(static_cast<int>(branching.size())))));
        for (int changes = random.below(3); changes > 0 && !text.empty(); --changes)
            text[static_cast<std::size_t>(random.below(static_cast<int>(text.size())))] =
                static_cast<char>(random.below(256));
        try {
            const auto record = parse(text);
            EXPECT_EQ(parse(to_text(record)).main_line(), record.main_line());
            ++taken;
        } catch (const engine::Error&) {
        }
    }
    EXPECT_GT(taken, 300);
    EXPECT_LT(taken, 2900);
}

// Three games there end with an illegal move, which is refused by name.
TEST(ShogiKif, SharedRecords) {
    if (!std::filesystem::exists(shared_data() / "shogi"))
        GTEST_SKIP() << "no ../shared/data/shogi";
    int read = 0, refused = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(shared_data() / "shogi")) {
        if (entry.path().extension() != ".kif" && entry.path().extension() != ".ki2") continue;
        try {
            const auto record = parse(engine::read_file(entry.path()));
            const auto text = to_text(record);
            EXPECT_EQ(to_text(parse(text)), text) << entry.path();
            ++read;
        } catch (const engine::Error& error) {
            EXPECT_NE(std::string_view(error.what()).find("is illegal"), std::string_view::npos)
                << entry.path() << error.what();
            ++refused;
        }
    }
    EXPECT_EQ(read, 21);
    EXPECT_EQ(refused, 3);
}

// The fifth KI2 game and others there are KIF games told again.
TEST(ShogiKif, SharedPrintAgreesWithKif) {
    const auto folder = shared_data() / "shogi/csa-kif-misc/mog-core-resources";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no ../shared/data/shogi";
    const auto read = [&](const char* name) {
        return parse(engine::read_file(folder / name)).main_line();
    };
    EXPECT_EQ(read("ki2/game/001.ki2"), read("kif/game/001.kif"));
    EXPECT_EQ(read("ki2/game/005.ki2"), read("kif/game/010.kif"));
}

}  // namespace
}  // namespace shogi::kif
