#include "selfplay/training/scatter.h"

#include <array>
#include <optional>

#include "engine/base/error.h"
#include "selfplay/training/chance.h"

namespace selfplay::training {

namespace {

using chess::Piece;
using engine::Player;

constexpr std::array men = {Piece::queen,  Piece::rook,   Piece::rook, Piece::bishop, Piece::bishop,
                            Piece::knight, Piece::knight, Piece::pawn, Piece::pawn,   Piece::pawn,
                            Piece::pawn,   Piece::pawn,   Piece::pawn, Piece::pawn,   Piece::pawn};

chess::Square free_square(const chess::Setup& setup, Piece piece, engine::Random& random) {
    constexpr int files = 8, ranks = 8;
    const bool pawn = piece == Piece::pawn;
    for (;;) {
        const int rank = pawn ? 1 + random.below(ranks - 2) : random.below(ranks);
        const auto square = chess::square_at(random.below(files), rank);
        if (!setup.board[chess::index(square)]) return square;
    }
}

chess::Setup scatter(engine::Random& random) {
    chess::Setup setup;
    const auto put = [&](Player player, Piece piece) {
        setup.board[chess::index(free_square(setup, piece, random))] = {player, piece};
    };
    // Few men more often than many: a quarter of the games begin with less than a sixteenth of
    // them, so that mating a bare king is met with.
    const auto unit = static_cast<float>(search::open_unit(random));
    const float share = unit * unit;
    for (const auto player : {Player::first, Player::second}) {
        put(player, Piece::king);
        for (const auto piece : men)
            if (happens(random, share)) put(player, piece);
    }
    setup.to_play = happens(random, 0.5f) ? Player::first : Player::second;
    setup.ply = setup.to_play == Player::first ? 0 : 1;
    return setup;
}

// Nothing where whoever has moved stands in check.
std::optional<chess::Chess> legal_game(const chess::Setup& setup) {
    try {
        return chess::Chess(chess::Position(setup));
    } catch (const engine::Error&) {
        return std::nullopt;
    }
}

}  // namespace

chess::Chess scattered_chess(engine::Random& random) {
    for (;;)
        if (const auto game = legal_game(scatter(random));
            game && game->outcome() == engine::Outcome::ongoing)
            return *game;
}

}  // namespace selfplay::training
