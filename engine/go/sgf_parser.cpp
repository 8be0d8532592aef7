#include "engine/go/sgf_parser.h"

#include <algorithm>

#include "engine/base/text.h"
#include "engine/go/sgf_values.h"

namespace go::sgf {

namespace {

constexpr std::size_t most_memory = std::size_t{256} << 20;
// Of a node, a property and a value, with what allocation and growth add.
constexpr std::size_t node_cost = 2 * sizeof(Node) + 48;
constexpr std::size_t property_cost = sizeof(Property) + 24;
constexpr std::size_t value_cost = 2 * sizeof(std::string);

}  // namespace

Parsed TreeParser::parse() {
    while (step() && !branches_.empty()) {
    }
    if (result_.why.empty()) decode();
    result_.end = at_;
    return std::move(result_);
}

bool TreeParser::fail(std::string_view why, std::string what) {
    result_.why = why;
    result_.where = at_;
    result_.what = std::move(what);
    return false;
}

bool TreeParser::charge(std::size_t bytes) {
    used_ += bytes;
    return used_ <= most_memory || fail("the game tree takes over 256 MiB");
}

// The next character that is no blank, 0 at the end (and for NUL, which fits nowhere).
char TreeParser::peek() {
    while (at_ < text_.size() && engine::is_blank(text_[at_])) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
}

bool TreeParser::step() {
    const char c = peek();
    if (c == '(') return open();
    if (c == ')') return close();
    if (c == ';') return node();
    if (at_ >= text_.size()) return fail("the text ends before the game tree does");
    return fail("expected a node, '(' or ')'");
}

bool TreeParser::open() {
    Branch branch;
    if (!branches_.empty()) {
        branch.parent = branches_.back().last;
        if (branch.parent == no_node) return fail("a variation without a node before it");
        branches_.back().divided = true;
    }
    ++at_;
    branches_.push_back(branch);
    return charge(2 * sizeof(Branch));
}

bool TreeParser::close() {
    ++at_;
    branches_.pop_back();
    return true;
}

bool TreeParser::node() {
    auto& nodes = result_.tree.nodes;
    auto& branch = branches_.back();
    if (branch.divided) return fail("a node after variations of the one before it");
    if (!charge(node_cost)) return false;
    ++at_;
    const auto parent = branch.last == no_node ? branch.parent : branch.last;
    branch.last = static_cast<std::uint32_t>(nodes.size());
    if (parent != no_node) nodes[parent].children.push_back(branch.last);
    nodes.emplace_back();
    while (engine::is_upper(peek()) || engine::is_lower(peek()))
        if (!property()) return false;
    return true;
}

// Lower-case letters are decoration in FF[3]: "AddBlack" is AB.
std::string TreeParser::id() {
    std::string id;
    for (; at_ < text_.size(); ++at_) {
        const char c = text_[at_];
        if (engine::is_upper(c) || engine::is_digit(c))
            id += c;
        else if (!engine::is_lower(c))
            break;
    }
    return id;
}

bool TreeParser::property() {
    const auto start = at_;
    auto& properties = result_.tree.nodes.back().properties;
    auto& property = properties.emplace_back();
    property.id = id();
    const auto written = text_.substr(start, at_ - start);
    const bool named = !property.id.empty(), has_value = peek() == '[';
    if (!named || !has_value) {
        at_ = start;
        return fail(
            named ? "a property without a value" : "a property name without a capital letter",
            engine::excerpt(written));
    }
    if (!charge(property_cost + property.id.size()) || !values(property)) return false;
    if (property.id == "CA" && result_.tree.nodes.size() == 1) charset_from(property);
    return true;
}

bool TreeParser::values(Property& property) {
    while (peek() == '[')
        if (!value(property)) return false;
    return true;
}

bool TreeParser::value(Property& property) {
    const auto end = value_end();
    if (end >= text_.size()) {
        fail("a value that is not closed", engine::excerpt(property.id));
        // No later value can be whole either; looking would take time squared.
        at_ = text_.size();
        return false;
    }
    const auto raw = text_.substr(at_ + 1, end - at_ - 1);
    if (!charge(value_cost + raw.size())) return false;
    property.values.push_back(is_known(property.id) ? unescaped(raw, pairs_) : std::string(raw));
    at_ = end + 1;
    return true;
}

// Of the bracket that closes the value whose opening bracket is next.
std::size_t TreeParser::value_end() const {
    auto end = at_ + 1;
    while (end < text_.size() && text_[end] != ']') {
        const bool two = text_[end] == '\\' || engine::begins_pair(pairs_, text_[end]);
        end += two ? 2 : 1;
    }
    return end;
}

void TreeParser::charset_from(const Property& property) {
    const auto name = engine::trimmed(property.values.front());
    if (is_utf8_ || !engine::is_charset(name)) return;
    charset_ = name;
    pairs_ = engine::pairs_of(name);
}

namespace {

template <class Use>
void for_each_value(Tree& tree, Use use) {
    for (auto& node : tree.nodes)
        for (auto& property : node.properties)
            for (auto& value : property.values) use(value);
}

bool all_utf8(Tree& tree) {
    bool all = true;
    for_each_value(tree, [&](const std::string& value) { all = all && engine::is_utf8(value); });
    return all;
}

// The root says UTF-8 if it names a charset, or if there is a character to which that matters.
void name_utf8(Tree& tree, bool needed) {
    if (tree.nodes.empty()) return;
    auto& properties = tree.nodes.front().properties;
    bool named = false;
    for (auto& property : properties) {
        if (property.id != "CA") continue;
        property.values = {"UTF-8"};
        named = true;
    }
    if (needed && !named) properties.push_back({"CA", {"UTF-8"}});
}

}  // namespace

// Values to UTF-8. Most games are plain ASCII and cost no more than the look.
void TreeParser::decode() {
    auto& tree = result_.tree;
    bool ascii = true;
    for_each_value(tree, [&](const std::string& v) { ascii = ascii && engine::is_ascii(v); });
    if (charset_.empty() && !ascii) charset_ = is_utf8_ || all_utf8(tree) ? "UTF-8" : "ISO-8859-1";
    name_utf8(tree, !ascii);
    if (ascii) return;
    engine::Decoder decoder(charset_);
    for_each_value(tree, [&](std::string& value) {
        if (!engine::is_ascii(value)) value = decoder(value);
    });
}

}  // namespace go::sgf
