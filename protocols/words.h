// The words of a command line, taken one after the other. Each failure names what was expected.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/game.h"

namespace protocols {

// ASCII letters only.
std::string lower(std::string_view text);

class Words {
   public:
    explicit Words(std::string_view text);

    bool empty() const { return at_ == words_.size(); }
    std::size_t left() const { return words_.size() - at_; }
    // The next word, left where it is; there must be one.
    const std::string& peek() const { return words_[at_]; }
    std::string_view take(std::string_view what);
    int whole(std::string_view what, int least, int most);
    double number(std::string_view what, double least, double most);
    bool yes_or_no(std::string_view what);
    // b, w, black or white, in any case.
    engine::Player colour();
    bool at_colour() const;
    bool at_number() const;
    // All that is left, with single blanks between.
    std::string rest() const;
    // Fails unless all has been taken.
    void finish() const;

   private:
    std::vector<std::string> words_;
    std::size_t at_ = 0;
};

}  // namespace protocols
