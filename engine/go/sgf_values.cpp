#include "engine/go/sgf_values.h"

#include <algorithm>
#include <array>

namespace go::sgf {

namespace {

constexpr std::array<std::string_view, 94> known{
    "AB", "AE", "AN", "AP", "AR", "AW", "B",  "BL", "BM", "BR", "BS", "BT", "C",  "CA", "CH", "CI",
    "CP", "CR", "DD", "DI", "DM", "DO", "DP", "DT", "EL", "EV", "EX", "FF", "FG", "GB", "GC", "GE",
    "GK", "GM", "GN", "GW", "HA", "HO", "ID", "IT", "KK", "KM", "KO", "L",  "LB", "LN", "LT", "M",
    "MA", "MN", "N",  "OB", "OM", "ON", "OP", "OT", "OV", "OW", "PB", "PC", "PL", "PM", "PW", "RE",
    "RG", "RO", "RU", "SC", "SE", "SI", "SL", "SO", "SP", "SQ", "ST", "SU", "SY", "SZ", "TB", "TC",
    "TE", "TM", "TR", "TW", "UC", "US", "V",  "VW", "W",  "WC", "WL", "WR", "WS", "WT",
};

bool is_break(char c) { return c == '\n' || c == '\r'; }

// One line break: \n, \r, \r\n or \n\r.
std::size_t break_length(std::string_view rest) {
    return rest.size() > 1 && is_break(rest[1]) && rest[1] != rest[0] ? 2 : 1;
}

void append_known(std::string& text, std::string_view id, std::string_view value) {
    // AP is the one property whose first half is free text: name:version.
    const auto divider = id == "AP" ? value.rfind(':') : value.npos;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const char c = value[i];
        const bool inner_colon = c == ':' && divider != value.npos && i < divider;
        if (c == '\\' || c == ']' || inner_colon) text += '\\';
        text += c;
    }
}

// Escaped already, unless it was never read from a file.
void append_raw(std::string& text, std::string_view value) {
    for (std::size_t i = 0; i < value.size(); ++i) {
        const bool escape = value[i] == '\\';
        const bool last = i + 1 == value.size();
        if (value[i] == ']' || (escape && last)) text += '\\';
        text += value[i];
        if (escape && !last) text += value[++i];
    }
}

}  // namespace

bool is_known(std::string_view id) {
    static_assert(std::is_sorted(known.begin(), known.end()));
    return std::binary_search(known.begin(), known.end(), id);
}

std::string unescaped(std::string_view raw, engine::Pairs pairs) {
    if (raw.find('\\') == raw.npos && raw.find('\r') == raw.npos) return std::string(raw);
    std::string text;
    text.reserve(raw.size());
    while (!raw.empty()) {
        std::size_t taken = 1;
        if (engine::begins_pair(pairs, raw[0])) {
            taken = std::min<std::size_t>(2, raw.size());
            text += raw.substr(0, taken);
        } else if (is_break(raw[0])) {
            taken = break_length(raw);
            text += '\n';
        } else if (raw[0] == '\\' && raw.size() > 1) {
            raw.remove_prefix(1);
            if (is_break(raw[0]))
                taken = break_length(raw);
            else if (engine::begins_pair(pairs, raw[0]))
                taken = 0;  // the pair stands for itself on the next round
            else
                text += raw[0];
        } else {
            text += raw[0];
        }
        raw.remove_prefix(taken);
    }
    return text;
}

void append_value(std::string& text, std::string_view id, std::string_view value) {
    text += '[';
    is_known(id) ? append_known(text, id, value) : append_raw(text, value);
    text += ']';
}

}  // namespace go::sgf
