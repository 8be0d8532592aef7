#include <fstream>
#include <sstream>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/gzip.h"
#include "engine/base/text.h"
#include "engine/chess/fen.h"
#include "engine/chess/pgn.h"
#include "engine/chess/pgn_lexer.h"
#include "engine/chess/san.h"

namespace chess::pgn {

namespace {

bool is_letter(char letter) { return engine::is_lower(engine::to_lower(letter)); }

bool is_result(std::string_view word) {
    return word == "1-0" || word == "0-1" || word == "1/2-1/2" || word == "*";
}

bool is_null_move(std::string_view word) { return word == "--" || word == "Z0" || word == "null"; }

// Move numbers, and signs such as "+-" or "=" that have no letter or digit.
bool means_nothing(std::string_view word) {
    if (word == "e.p" || word == "ep") return true;
    for (const char letter : word)
        if (is_letter(letter)) return false;
    return word.find('-') == word.npos || word.find_first_of("0123456789") == word.npos;
}

// "!" is $1, "?" $2, "!!" $3, "??" $4, "!?" $5, "?!" $6; else nothing.
std::optional<std::uint8_t> nag_of_suffix(std::string_view word) {
    constexpr std::array<std::string_view, 6> suffixes = {"!", "?", "!!", "??", "!?", "?!"};
    const auto at = word.find_last_not_of("!?");
    const auto suffix = word.substr(at == word.npos ? 0 : at + 1);
    for (std::size_t i = 0; i < suffixes.size(); ++i)
        if (suffix == suffixes[i]) return static_cast<std::uint8_t>(i + 1);
    return std::nullopt;
}

void append(std::string& text, std::string_view more) {
    if (!text.empty() && !more.empty()) text += ' ';
    text += more;
}

// A tree of moves as it grows, and the position at its tip.
class Tree {
   public:
    Tree(const Position& start, std::vector<Node>& nodes)
        : nodes_(nodes), before_(start), now_(start) {}

    const Position& position() const { return now_; }
    int depth() const { return static_cast<int>(branches_.size()); }
    bool at_beginning() const { return node_ == parent_; }

    void play(Move move) {
        const auto child = static_cast<std::uint32_t>(nodes_.size());
        nodes_[node_].children.push_back(child);
        nodes_.emplace_back().move = move;
        nodes_[child].comment_before = std::exchange(pending_comment_, {});
        parent_ = std::exchange(node_, child);
        before_ = now_;
        now_.play(move);
    }
    // A variation of the last move.
    void open() {
        branches_.push_back({node_, parent_, before_, now_});
        node_ = parent_;
        now_ = before_;
    }
    void close() {
        const Branch& branch = branches_.back();
        node_ = branch.node;
        parent_ = branch.parent;
        before_ = branch.before;
        now_ = branch.now;
        branches_.pop_back();
        pending_comment_.clear();
    }
    void comment(std::string_view text) {
        append(depth() > 0 && at_beginning() ? pending_comment_ : nodes_[node_].comment, text);
    }
    void nag(std::uint8_t nag) {
        if (!at_beginning()) nodes_[node_].nags.push_back(nag);
    }

   private:
    struct Branch {
        std::uint32_t node, parent;
        Position before, now;
    };
    std::vector<Node>& nodes_;
    std::vector<Branch> branches_;
    std::uint32_t node_ = 0, parent_ = 0;
    Position before_, now_;
    std::string pending_comment_;
};

std::string lower(std::string_view text) {
    std::string result;
    for (const char letter : text)
        if (is_letter(letter) || engine::is_digit(letter)) result += engine::to_lower(letter);
    return result;
}

// Whether castling is Chess960's; fails on a game that is not chess.
bool is_chess960(std::string_view variant) {
    const std::string name = lower(variant);
    for (const auto* known :
         {"chess960", "fischerandom", "fischerrandom", "freestyle", "frc", "960"})
        if (name.find(known) != name.npos) return true;
    for (const auto* known : {"", "standard", "normal", "chess", "fromposition", "orthodox"})
        if (name == known) return false;
    engine::fail("the variant \"{}\" is not played here", engine::excerpt(variant));
}

Chess start_of(const Record& record) {
    const auto fen = record.tag("FEN");
    Chess start = fen.empty() ? Chess() : Chess::from_text(fen);
    if (is_chess960(record.tag("Variant"))) start.set_chess960(true);
    return start;
}

}  // namespace

class Reader::Parser {
   public:
    explicit Parser(std::istream& in) : lexer_(in) {}

    std::optional<Record> next();
    int games() const { return games_; }

   private:
    Token take() {
        if (!pending_) return lexer_.next();
        Token token = *std::move(pending_);
        pending_.reset();
        return token;
    }
    std::optional<Record> read();
    void read_moves(Record& record);
    void accept(const Token& token, Tree& tree);
    void move(const Token& token, Tree& tree);
    void open(const Token& token, Tree& tree);
    bool skipped(const Token& token, Tree& tree);

    Lexer lexer_;
    std::optional<Token> pending_;
    int games_ = 0;
    int skipping_ = 0;  // parentheses open since a null move
};

std::optional<Record> Reader::Parser::next() {
    try {
        return read();
    } catch (const Refusal& refusal) {
        pending_.reset();
        lexer_.skip_to_tags();
        engine::fail("PGN game {}, line {}, column {}: {}", games_, refusal.place.line,
                     refusal.place.column, refusal.message);
    }
}

std::optional<Record> Reader::Parser::read() {
    skipping_ = 0;
    Token token = take();
    if (token.kind == Token::Kind::end) return std::nullopt;
    ++games_;
    Record record;
    const Place place = token.place;
    for (; token.kind == Token::Kind::tag; token = take())
        record.tags.push_back({std::move(token.text), std::move(token.value)});
    pending_ = std::move(token);
    try {
        record.start = start_of(record);
    } catch (const engine::Error& error) {
        throw Refusal{error.what(), place};
    }
    read_moves(record);
    std::erase_if(record.tags, [](const Tag& tag) {
        return tag.name == "FEN" || tag.name == "SetUp" || tag.name == "Variant";
    });
    return record;
}

void Reader::Parser::read_moves(Record& record) {
    Tree tree(record.start.position(), record.nodes);
    if (const auto result = record.tag("Result"); is_result(result)) record.result = result;
    for (;;) {
        Token token = take();
        const bool over = token.kind == Token::Kind::end || token.kind == Token::Kind::tag;
        if (over && tree.depth() > 0) throw Refusal{"a variation without its end", token.place};
        if (token.kind == Token::Kind::tag) {
            pending_ = std::move(token);
            return;
        }
        if (over) return;
        if (token.kind == Token::Kind::word && is_result(token.text)) {
            if (tree.depth() > 0) continue;  // some programs end variations with "*"
            record.result = token.text;
            return;
        }
        if (!skipped(token, tree)) accept(token, tree);
    }
}

// What follows a null move up to the end of its variation.
bool Reader::Parser::skipped(const Token& token, Tree& tree) {
    if (skipping_ == 0) return false;
    if (token.kind == Token::Kind::open) ++skipping_;
    if (token.kind == Token::Kind::close && --skipping_ == 0) tree.close();
    return true;
}

void Reader::Parser::accept(const Token& token, Tree& tree) {
    switch (token.kind) {
        case Token::Kind::comment:
            return tree.comment(token.text);
        case Token::Kind::nag:
            if (!token.text.empty() && token.text.size() <= 3 && std::stoi(token.text) <= 255)
                tree.nag(static_cast<std::uint8_t>(std::stoi(token.text)));
            return;
        case Token::Kind::open:
            return open(token, tree);
        case Token::Kind::close:
            if (tree.depth() == 0) throw Refusal{"\")\" without \"(\"", token.place};
            return tree.close();
        default:
            return move(token, tree);
    }
}

void Reader::Parser::open(const Token& token, Tree& tree) {
    if (tree.at_beginning()) throw Refusal{"a variation before any move", token.place};
    if (tree.depth() >= deepest_variation)
        throw Refusal{fmt::format("variations nested deeper than {}", deepest_variation),
                      token.place};
    tree.open();
}

void Reader::Parser::move(const Token& token, Tree& tree) {
    const auto nag = nag_of_suffix(token.text);
    if (is_null_move(token.text) && tree.depth() > 0) {
        skipping_ = 1;
    } else if (is_null_move(token.text) || !means_nothing(token.text)) {
        const auto move = move_from_san_or_uci(tree.position(), token.text);
        if (!move)
            throw Refusal{fmt::format("\"{}\" is not a legal move in {}",
                                      engine::excerpt(token.text), fen(tree.position())),
                          token.place};
        tree.play(*move);
    }
    if (nag) tree.nag(*nag);
}

Reader::Reader(std::istream& in) : parser_(std::make_unique<Parser>(in)) {}
Reader::~Reader() = default;
std::optional<Record> Reader::next() { return parser_->next(); }
int Reader::games() const { return parser_->games(); }

std::unique_ptr<std::istream> open(const std::filesystem::path& path) {
    auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
    std::string magic(2, ' ');
    if (!file->read(magic.data(), 2) && !file->eof())
        engine::fail("{}: cannot read", path.string());
    if (engine::is_gzip(magic))
        return std::make_unique<std::istringstream>(engine::read_plain_or_gzip(path));
    file->clear();
    file->seekg(0);
    return file;
}

Record read_one(std::string_view text) {
    std::istringstream in{std::string(text)};
    auto record = Reader(in).next();
    if (!record) engine::fail("PGN: there is no game");
    return *std::move(record);
}

}  // namespace chess::pgn
