#include <algorithm>

#include "engine/base/charset.h"
#include "engine/base/error.h"
#include "engine/base/gzip.h"
#include "engine/base/text.h"
#include "engine/go/sgf.h"
#include "engine/go/sgf_parser.h"

namespace go::sgf {

namespace {

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF", utf16_little = "\xFF\xFE",
                           utf16_big = "\xFE\xFF";

// Where the next tree begins: a '(' whose next character but for blanks is a ';'.
std::size_t find_tree(std::string_view text, std::size_t from) {
    for (auto semicolon = text.find(';', from); semicolon != text.npos;
         semicolon = text.find(';', semicolon + 1)) {
        auto before = semicolon;
        while (before > from && engine::is_blank(text[before - 1])) --before;
        if (before > from && text[before - 1] == '(') return before - 1;
    }
    return text.size();
}

std::size_t find_tree_at_line_start(std::string_view text, std::size_t from) {
    const auto found = text.find("\n(;", from);
    return found == text.npos ? text.size() : found + 1;
}

}  // namespace

const Property* Node::find(std::string_view id) const {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const Property& property) { return property.id == id; });
    return found == properties.end() ? nullptr : &*found;
}

std::string_view Node::value(std::string_view id) const {
    const auto* const property = find(id);
    return property && !property->values.empty() ? std::string_view(property->values.front())
                                                 : std::string_view();
}

GameReader::GameReader(std::string_view text) : text_(text) {
    const bool little = text.starts_with(utf16_little), big = text.starts_with(utf16_big);
    if (little || big) {
        converted_ = engine::to_utf8(text.substr(2), little ? "UTF-16LE" : "UTF-16BE");
        text_ = converted_;
        is_utf8_ = true;
    } else if (text.starts_with(utf8_mark)) {
        text_.remove_prefix(utf8_mark.size());
        is_utf8_ = true;
    }
}

void GameReader::advance_to(std::size_t at) {
    for (auto next = text_.find('\n', at_); next < at; next = text_.find('\n', next + 1)) {
        ++line_;
        line_start_ = next + 1;
    }
    at_ = at;
}

std::optional<Tree> GameReader::next() {
    advance_to(find_tree(text_, at_));
    if (at_ == text_.size()) return {};
    tree_line_ = line_;
    auto parsed = TreeParser(text_, at_, is_utf8_).parse();
    if (parsed.why.empty()) {
        advance_to(parsed.end);
        return std::move(parsed.tree);
    }
    advance_to(parsed.where);
    const auto line = line_;
    const auto column = at_ - line_start_ + 1;
    advance_to(find_tree_at_line_start(text_, parsed.end));
    const auto what = parsed.what.empty() ? "" : ": " + parsed.what;
    engine::fail("line {}, column {}: {}{}", line, column, parsed.why, what);
}

std::vector<Tree> parse(std::string_view text) {
    constexpr std::size_t most_nodes = (std::size_t{1} << 30) / 256;
    std::vector<Tree> trees;
    std::size_t nodes = 0;
    GameReader reader(text);
    while (auto tree = reader.next()) {
        nodes += tree->nodes.size();
        if (nodes > most_nodes)
            engine::fail("line {}: over {} nodes in one collection", reader.line(), most_nodes);
        trees.push_back(std::move(*tree));
    }
    if (trees.empty()) engine::fail("line 1, column 1: no game tree, which would begin with (;");
    return trees;
}

std::string read_file(const std::filesystem::path& path) {
    return engine::read_plain_or_gzip(path);
}

}  // namespace go::sgf
