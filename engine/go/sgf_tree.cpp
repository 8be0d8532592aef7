#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/go/sgf.h"

namespace go::sgf {

namespace {

// Letters count from the top left corner.
std::string point_text(Point point, int size) {
    return {static_cast<char>('a' + point.x), static_cast<char>('a' + size - 1 - point.y)};
}

// A large whole number keeps its point, lest it read as hundredths.
std::string komi_text(Komi komi) {
    if (komi.halves() % 2 != 0 || komi.halves() >= 400) return fmt::format("{:.1f}", komi.points());
    return fmt::format("{}", komi.halves() / 2);
}

// SGF has its own spelling of a few names.
std::string rules_text(const Rules& rules) {
    auto name = describe(rules);
    constexpr std::pair<std::string_view, std::string_view> spelled[] = {
        {"chinese", "Chinese"}, {"japanese", "Japanese"}, {"korean", "Korean"},
        {"aga", "AGA"},         {"new-zealand", "NZ"},    {"ing", "GOE"},
    };
    for (const auto& [ours, sgf] : spelled)
        if (name == ours) return std::string(sgf);
    return name;
}

Property stones_of(const Go& game, Player player) {
    Property property{player == Player::first ? "AB" : "AW", {}};
    for (int y = game.size() - 1; y >= 0; --y)
        for (int x = 0; x < game.size(); ++x)
            if (game.at({x, y}) == player)
                property.values.push_back(point_text({x, y}, game.size()));
    return property;
}

void set(Node& node, Property property) {
    const auto same = std::find_if(node.properties.begin(), node.properties.end(),
                                   [&](const Property& p) { return p.id == property.id; });
    if (same != node.properties.end())
        *same = std::move(property);
    else
        node.properties.push_back(std::move(property));
}

Node root_of(const Go& start, std::string_view result, const std::vector<Property>& facts) {
    Node root;
    root.properties = {{"GM", {"1"}},
                       {"FF", {"4"}},
                       {"CA", {"UTF-8"}},
                       {"AP", {"sanban:" SANBAN_VERSION}},
                       {"SZ", {std::to_string(start.size())}},
                       {"RU", {rules_text(start.rules())}},
                       {"KM", {komi_text(start.komi())}}};
    if (start.handicap() >= 2) set(root, {"HA", {std::to_string(start.handicap())}});
    if (!result.empty()) set(root, {"RE", {std::string(result)}});
    for (const auto& fact : facts) set(root, fact);
    bool stones = false;
    for (const auto player : {Player::first, Player::second}) {
        auto property = stones_of(start, player);
        if (property.values.empty()) continue;
        set(root, std::move(property));
        stones = true;
    }
    if (stones || start.to_play() != Player::first)
        set(root, {"PL", {start.to_play() == Player::first ? "B" : "W"}});
    return root;
}

Node node_of(const Go& game, const Turn& turn) {
    const auto point = game.point_of(turn.move);
    Node node;
    node.properties.push_back({turn.player == Player::first ? "B" : "W",
                               {point ? point_text(*point, game.size()) : std::string()}});
    return node;
}

}  // namespace

Tree tree_of(const Go& start, const std::vector<Turn>& turns, std::string_view result,
             const std::vector<Property>& facts, const std::vector<std::string>& comments) {
    Tree tree;
    tree.nodes.reserve(turns.size() + 1);
    tree.nodes.push_back(root_of(start, result, facts));
    for (std::size_t i = 0; i < turns.size(); ++i) {
        tree.nodes.back().children.push_back(static_cast<std::uint32_t>(i + 1));
        tree.nodes.push_back(node_of(start, turns[i]));
        if (i < comments.size() && !comments[i].empty())
            set(tree.nodes.back(), {"C", {comments[i]}});
    }
    return tree;
}

}  // namespace go::sgf
