// One game tree out of SGF text, without recursion; for the SGF reader only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/charset.h"
#include "engine/go/sgf.h"

namespace go::sgf {

// A tree, or why it is none and where.
struct Parsed {
    Tree tree;
    std::size_t end = 0;    // after the tree's last bracket, or where another may be looked for
    std::size_t where = 0;  // of the failure
    std::string_view why;   // empty when all went well
    std::string what;       // the property that `why` speaks of, if it does
};

class TreeParser {
   public:
    // `at`: of the tree's opening bracket. With `is_utf8`, CA counts for nothing.
    TreeParser(std::string_view text, std::size_t at, bool is_utf8)
        : text_(text), at_(at), is_utf8_(is_utf8) {}

    Parsed parse();

   private:
    static constexpr std::uint32_t no_node = 0xFFFFFFFF;

    // A bracket that is open.
    struct Branch {
        std::uint32_t parent = no_node;  // the node before the bracket
        std::uint32_t last = no_node;    // the latest node in it
        bool divided = false;            // variations have begun
    };

    bool step();
    bool open();
    bool close();
    bool node();
    bool property();
    bool values(Property& property);
    bool value(Property& property);
    std::string id();
    std::size_t value_end() const;
    void charset_from(const Property& property);
    void decode();

    bool fail(std::string_view why, std::string what = {});
    bool charge(std::size_t bytes);
    char peek();

    std::string_view text_;
    std::size_t at_;
    bool is_utf8_;
    std::string charset_;
    engine::Pairs pairs_ = engine::Pairs::none;
    std::size_t used_ = 0;  // bytes of memory, about
    std::vector<Branch> branches_;
    Parsed result_;
};

}  // namespace go::sgf
