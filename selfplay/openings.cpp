#include "selfplay/openings.h"

#include <utility>

#include "engine/base/random.h"

namespace selfplay {

Openings::Openings(const OpeningSettings& settings, const Rulebook& rulebook)
    : settings_(settings), rulebook_(rulebook) {
    if (settings.file.empty()) return;
    book_ = rulebook.openings(settings.file, settings.plies);
    engine::Random random(settings.seed);
    for (int i = static_cast<int>(book_.size()) - 1; i > 0; --i)
        std::swap(book_[static_cast<std::size_t>(i)],
                  book_[static_cast<std::size_t>(random.below(i + 1))]);
}

Opening Openings::at(int number) const {
    if (!book_.empty()) return book_[static_cast<std::size_t>(number) % book_.size()];
    return random(number);
}

Opening Openings::random(int number) const {
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;  // neighbouring seeds lie far apart
    engine::Random random(settings_.seed + odd * static_cast<std::uint64_t>(number + 1));
    const auto referee = rulebook_.referee({});
    Opening opening;
    for (int ply = 0; ply < settings_.random_plies; ++ply) {
        const auto moves = referee->opening_moves();
        if (moves.empty()) break;
        const auto& move =
            moves[static_cast<std::size_t>(random.below(static_cast<int>(moves.size())))];
        referee->play(move);
        opening.moves.push_back(move);
    }
    return opening;
}

}  // namespace selfplay
