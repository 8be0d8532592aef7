// What lies under the SGF reader: charsets, UTF-8, gzip.
#include <gtest/gtest.h>
#include <zlib.h>

#include "engine/base/charset.h"
#include "engine/base/error.h"
#include "engine/base/gzip.h"
#include "engine/base/text.h"

namespace engine {

namespace {

std::string gzipped(std::string_view text) {
    std::string packed(text.size() / 500 + 200, '\0');
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 16 + 15, 9, Z_DEFAULT_STRATEGY), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

}  // namespace

TEST(Charset, ThereAndBack) {
    EXPECT_EQ(to_utf8("\x90\xE6\x8E\xE8", "Shift_JIS"), "先手");
    EXPECT_EQ(from_utf8("先手", "Shift_JIS"), "\x90\xE6\x8E\xE8");
    EXPECT_EQ(from_utf8("a李b", "ISO-8859-1"), "a?b");
    EXPECT_EQ(to_utf8("\\~", "Shift_JIS"), "\\~");
    EXPECT_EQ(to_utf8("\xFC", "latin1"), "ü");
}

TEST(Charset, BadBytesAreReplaced) {
    EXPECT_EQ(to_utf8("a\xFF"
                      "b",
                      "GBK"),
              "a\xEF\xBF\xBD"
              "b");
    EXPECT_EQ(to_utf8("a\x90", "Shift_JIS"), "a\xEF\xBF\xBD");
    EXPECT_EQ(to_utf8("\xC0\x80\xED\xA0\x80", "UTF-8"),
              std::string("\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"));
    for (const auto* const charset : {"GBK", "Shift_JIS", "EUC-KR", "Big5", "UTF-8", "EUC-JP"}) {
        std::string all;
        for (int i = 0; i < 65536; ++i) (all += static_cast<char>(i >> 8)) += static_cast<char>(i);
        EXPECT_TRUE(is_utf8(to_utf8(all, charset))) << charset;
    }
}

TEST(Charset, UnknownOnesFail) {
    for (const auto* const name : {"", "klingon", "../../etc", "UTF-8//IGNORE", "GBK//TRANSLIT"}) {
        EXPECT_FALSE(is_charset(name)) << name;
        EXPECT_THROW(to_utf8("x", name), Error) << name;
    }
    EXPECT_TRUE(is_charset(" gb2312 "));
    EXPECT_TRUE(is_charset("utf-8"));
}

TEST(Text, Utf8) {
    EXPECT_TRUE(is_utf8("aé李\xF0\x9F\x98\x80"));
    for (const auto* const bad : {"\x80", "\xC3", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80",
                                  "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xE6\x9D"})
        EXPECT_FALSE(is_utf8(bad));
    EXPECT_EQ(excerpt("a\nb\xFFllllll", 4), "a?b?...");
}

TEST(Gzip, UnpacksMembersInTurn) {
    const std::string text(300000, 'x');
    const auto packed = gzipped(text);
    EXPECT_TRUE(is_gzip(packed));
    EXPECT_EQ(gunzip(packed), text);
    EXPECT_EQ(gunzip(packed + gzipped("more")), text + "more");
    EXPECT_EQ(gunzip(gzipped("")), "");
}

TEST(Gzip, RefusesDamageAndBombs) {
    const auto packed = gzipped(std::string(50'000'000, '\0'));
    EXPECT_LT(packed.size(), 100'000u);
    EXPECT_THROW(gunzip(packed, 1'000'000), Error);
    EXPECT_THROW(gunzip(packed.substr(0, packed.size() - 9)), Error);
    auto damaged = gzipped("a text of some length");
    damaged[damaged.size() - 6] ^= 1;
    EXPECT_THROW(gunzip(damaged), Error);
}

}  // namespace engine
