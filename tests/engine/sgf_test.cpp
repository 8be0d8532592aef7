#include "engine/go/sgf.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "engine/base/random.h"

namespace go::sgf {

namespace {

Tree only(std::string_view text) {
    auto trees = parse(text);
    EXPECT_EQ(trees.size(), 1u);
    return trees.front();
}

std::string value(std::string_view text, std::string_view id) {
    return std::string(only(text).nodes.front().value(id));
}

// The tree as text says, and the same once written and read again.
std::string rewritten(std::string_view text) {
    const auto tree = only(text);
    auto written = to_text(tree);
    EXPECT_EQ(only(written), tree) << written;
    written.pop_back();
    return written;
}

std::string why_refused(std::string_view text) {
    try {
        for (const auto& tree : parse(text)) main_line(tree);
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "not refused";
}

std::string repeated(std::string_view part, std::size_t times) {
    std::string text;
    text.reserve(part.size() * times);
    for (std::size_t i = 0; i < times; ++i) text += part;
    return text;
}

}  // namespace

TEST(SgfText, TreeInTheOrderOfTheText) {
    const auto tree = only("(;GM[1](;B[aa];W[bb](;B[cc])(;B[dd]))(;B[ee]))");
    ASSERT_EQ(tree.nodes.size(), 6u);
    using Children = std::vector<std::uint32_t>;
    EXPECT_EQ(tree.nodes[0].children, (Children{1, 5}));
    EXPECT_EQ(tree.nodes[1].children, (Children{2}));
    EXPECT_EQ(tree.nodes[2].children, (Children{3, 4}));
    EXPECT_EQ(tree.nodes[4].value("B"), "dd");
    EXPECT_EQ(tree.nodes[5].value("B"), "ee");
}

TEST(SgfText, WritesBackWhatItRead) {
    for (const std::string_view text :
         {"(;GM[1];B[aa];W[bb])", "(;GM[1](;B[aa];W[bb](;B[cc])(;B[dd]))(;B[ee]))",
          "(;LB[dd:1][ee:a]TR[aa][bb]XX[a\\:b:c\\]][\\\\];ZZ[])", "(;C[a \\] b \\\\ c: [d\n e])",
          "(;AP[one\\:two:3])", "(;)"})
        EXPECT_EQ(rewritten(text), text);
}

TEST(SgfText, EscapesAndLineBreaks) {
    EXPECT_EQ(value("(;C[a\\]b\\\\c\\:d\\e])", "C"), "a]b\\c:de");
    EXPECT_EQ(value("(;C[a\\\nb\\\r\nc])", "C"), "abc");
    EXPECT_EQ(value("(;C[a\r\nb\n\rc\rd\n\ne])", "C"), "a\nb\nc\nd\n\ne");
}

TEST(SgfText, OldLongNames) {
    const auto tree = only("(;GaMe[1]SiZe[9]KoMi[5.5]AddBlack[aa]CoPyright[x];White[bb])");
    EXPECT_EQ(tree.nodes[0].value("GM"), "1");
    EXPECT_EQ(tree.nodes[0].value("AB"), "aa");
    EXPECT_EQ(tree.nodes[0].value("CP"), "x");
    EXPECT_EQ(tree.nodes[1].value("W"), "bb");
}

TEST(SgfText, SkipsWhatStandsAroundTheTrees) {
    const auto trees = parse("\xEF\xBB\xBFmail (see below)\n ( ;B[aa])) noise\n(;W[bb])\n;-)");
    ASSERT_EQ(trees.size(), 2u);
    EXPECT_EQ(trees[0].nodes[0].value("B"), "aa");
    EXPECT_EQ(trees[1].nodes[0].value("W"), "bb");
}

TEST(SgfText, Charsets) {
    EXPECT_EQ(value("(;PB[\xE6\x9D\x8E])", "PB"), "李");
    EXPECT_EQ(value("(;CA[gb2312]PB[\xC0\xEE])", "PB"), "李");
    EXPECT_EQ(value("(;CA[EUC-KR]PB[\xC0\xCC])", "PB"), "이");
    EXPECT_EQ(value("(;PB[J\xF6rg])", "PB"), "Jörg");
    EXPECT_EQ(value("(;CA[klingon]PB[J\xF6rg])", "PB"), "Jörg");
    EXPECT_EQ(value("(;CA[UTF-8]PB[J\xF6rg])", "PB"), "J\xEF\xBF\xBDrg");
    EXPECT_EQ(value(std::string_view("\xFF\xFE(\0;\0P\0B\0[\0\x4E\x67]\0)\0", 18), "PB"), "李");
}

TEST(SgfText, BytesOfOtherCharsetsAreNoEscapes) {
    // The second bytes are a backslash and a bracket.
    EXPECT_EQ(value("(;CA[Shift_JIS]PB[\x95\x5C]C[x])", "PB"), "表");
    EXPECT_EQ(value("(;CA[Shift_JIS]PB[\x83\x5D]C[x])", "PB"), "ゾ");
    EXPECT_EQ(value("(;CA[Big5]PB[\xA5\x5C]C[x])", "C"), "x");
}

TEST(SgfText, WrittenTextIsUtf8AndSaysSo) {
    EXPECT_EQ(rewritten("(;CA[GBK]PB[\xC0\xEE])"), "(;CA[UTF-8]PB[李])");
    EXPECT_EQ(rewritten("(;PB[李])"), "(;PB[李]CA[UTF-8])");
}

TEST(SgfText, ErrorsSayWhere) {
    EXPECT_EQ(why_refused("(;B[aa]\n;C[abc"), "line 2, column 3: a value that is not closed: C");
    EXPECT_EQ(why_refused("(;B[aa]\n x;W[bb])"),
              "line 2, column 2: a property name without a capital letter: x");
    EXPECT_NE(why_refused("(;B[aa](;W[bb])").find("the text ends"), std::string::npos);
    EXPECT_NE(why_refused("(;(;B[aa]);W[bb])").find("after variations"), std::string::npos);
    EXPECT_NE(why_refused("").find("no game tree"), std::string::npos);
    EXPECT_NE(why_refused(std::string_view("(;B[aa]\0)", 9)).find("expected"), std::string::npos);
}

TEST(SgfText, ReaderGoesOnAfterABadTree) {
    GameReader reader("(;B[aa])\n(;B?)\n(;B[bb])\n");
    EXPECT_TRUE(reader.next());
    EXPECT_THROW(reader.next(), engine::Error);
    EXPECT_EQ(reader.line(), 2);
    const auto third = reader.next();
    ASSERT_TRUE(third);
    EXPECT_EQ(third->nodes[0].value("B"), "bb");
    EXPECT_EQ(reader.line(), 3);
    EXPECT_FALSE(reader.next());
}

TEST(SgfText, EveryPrefixIsRefused) {
    const std::string text = "(;GM[1]SZ[9]C[a\\]b](;B[aa];W[])(;B[cc:dd]))";
    for (std::size_t length = 0; length < text.size(); ++length)
        EXPECT_THROW(parse(text.substr(0, length)), engine::Error) << length;
}

TEST(SgfText, DeepNesting) {
    constexpr std::size_t depth = 300000;
    const auto text = repeated("(;", depth) + repeated(")", depth);
    const auto tree = only(text);
    EXPECT_EQ(tree.nodes.size(), depth);
    EXPECT_EQ(only(to_text(tree)), tree);
    EXPECT_TRUE(main_line(tree).turns.empty());
    EXPECT_THROW(parse(repeated("(;", depth)), engine::Error);
    EXPECT_THROW(parse(repeated("(", depth)), engine::Error);
    EXPECT_THROW(parse("(;" + repeated("(", depth)), engine::Error);
}

TEST(SgfText, HugeInputsEndSoon) {
    constexpr std::size_t size = 100'000'000;
    EXPECT_EQ(value("(;C[" + std::string(size, 'x') + "])", "C").size(), size);
    EXPECT_THROW(parse("(;C[" + std::string(size, '\\')), engine::Error);
    EXPECT_NE(why_refused("(" + std::string(size, ';') + ")").find("256 MiB"), std::string::npos);
    const auto unclosed = "(;C[\n" + repeated("(;C[\n", 100000);
    GameReader reader(unclosed);
    EXPECT_THROW(reader.next(), engine::Error);
    EXPECT_FALSE(reader.next());
}

TEST(SgfText, NoiseIsReadOrRefused) {
    engine::Random random(7);
    const std::vector<std::string> pieces{
        "(",      ")",        ";",       "B[aa]", "C[",
        "]",      "\\",       ":",       "x",     "W",
        "[]",     "\n",       "CA[GBK]", "\xFF",  std::string(1, '\0'),
        ";W[bb]", "(;B[cc])", "AP[a:b]"};
    int read = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string text = "(;";
        for (int i = random.below(12); i > 0; --i)
            text += pieces[static_cast<std::size_t>(random.below(static_cast<int>(pieces.size())))];
        try {
            for (const auto& tree : parse(text + ")")) {
                EXPECT_EQ(only(to_text(tree)), tree);
                ++read;
            }
        } catch (const engine::Error&) {
        }
    }
    EXPECT_GT(read, 100);
}

TEST(SgfText, RandomTreesSurvive) {
    engine::Random random(11);
    for (int round = 0; round < 200; ++round) {
        Tree tree{{Node{{{"GM", {"1"}}, {"CA", {"UTF-8"}}}, {}}}};
        // Parents come off the path to the latest node, so that the order is that of the text.
        std::vector<std::uint32_t> path{0};
        for (std::uint32_t at = 1; at < 60; ++at) {
            path.resize(path.size() -
                        static_cast<std::size_t>(random.below(3) == 0
                                                     ? random.below(static_cast<int>(path.size()))
                                                     : 0));
            tree.nodes[path.back()].children.push_back(at);
            std::string text;
            for (int i = random.below(12); i > 0; --i) text += "\\]:[;()\n a"[random.below(10)];
            tree.nodes.push_back({{{"C", {text, "é" + text}}, {"LB", {"aa:x"}}}, {}});
            path.push_back(at);
        }
        EXPECT_EQ(only(to_text(tree)), tree);
    }
}

}  // namespace go::sgf
