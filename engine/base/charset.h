// Text in other charsets, to UTF-8 and back, by iconv. Bytes without meaning are replaced, never
// refused; a charset that nobody knows is. Used by the readers of game records (SGF's CA, KIF's
// Shift_JIS).
#pragma once

#include <string>
#include <string_view>

namespace engine {

// Does the C library know the charset? Any case; names as in iconv or IANA's list. Names that
// files use for a smaller set than they hold are widened: GB2312 and GBK read as GB18030,
// Shift_JIS as CP932, EUC-KR as CP949.
bool is_charset(std::string_view charset);

// Bytes that mean nothing in `charset` become U+FFFD. Fails when the charset is not known.
std::string to_utf8(std::string_view bytes, std::string_view charset);

// What `charset` cannot write becomes '?'. Fails when the charset is not known.
std::string from_utf8(std::string_view text, std::string_view charset);

// Converts one text after another from a charset; cheaper than to_utf8 for many short ones.
// Not for use by two threads at once.
class Decoder {
   public:
    explicit Decoder(std::string_view charset);
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
    ~Decoder();

    std::string operator()(std::string_view bytes);

   private:
    void* handle_;  // of iconv; null for UTF-8, which is only repaired
};

// How characters of two bytes begin in charsets whose second byte may look like ASCII, a
// backslash or a bracket for instance.
enum class Pairs { none, from_0x81, shift_jis };
Pairs pairs_of(std::string_view charset);
constexpr bool begins_pair(Pairs pairs, char c) {
    const auto byte = static_cast<unsigned char>(c);
    if (pairs == Pairs::none || byte < 0x81 || byte == 0xFF) return false;
    return pairs == Pairs::from_0x81 || byte < 0xA0 || byte > 0xDF;
}

}  // namespace engine
