#include "engine/chess/bitboard.h"

#include <bit>

namespace chess::tables {

namespace {

using Numbers = std::array<Bitboard, 64>;
using Directions = std::array<std::array<int, 2>, 4>;

constexpr Directions diagonal = {{{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
constexpr Directions straight = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

// Found by trying sparse random numbers until none of a square's occupancies collided.
constexpr Numbers bishop_numbers = {
    0x6024090802040242, 0x2420510422808003, 0x00120c8c07020088, 0x240804a100001688,
    0x0381104021201024, 0x0002024261400858, 0x9818884410040080, 0x0009040200820840,
    0x0002c09081020080, 0xa190830802168208, 0x01c1104400484040, 0xa420882040422018,
    0x0582011040000480, 0x0012090403400045, 0x0340811831042000, 0x80028820a4042000,
    0x8040031024018428, 0x02904c8404080040, 0x0010000104088010, 0x0084028924048000,
    0x2114000088a00002, 0x4001010080600201, 0x8001000608120201, 0x0005000242681c00,
    0x0620500120240100, 0x4144024820421445, 0x1940500001010600, 0x0040090010090020,
    0x1031010038104001, 0x0001010202004101, 0x0040841501043224, 0x6000822083040200,
    0x0204024002208408, 0x0200844403600800, 0x8280180200040400, 0x0100020080880081,
    0x4201010400220020, 0x0002008a00410040, 0x542240a406020200, 0x1d84084600068890,
    0x0008280804080980, 0x0350808888406000, 0x00040a0804000201, 0x0004002028001c20,
    0x020940090b010200, 0x1402020041000202, 0x000901180081060c, 0x2082080103039220,
    0x2002190120111238, 0x0008420094210200, 0x6028608c00880020, 0x0000408020880800,
    0x2000001202020000, 0x4c000424088209a1, 0x0238068882140000, 0x8082042800910840,
    0xc04026020a200200, 0x0010002108029004, 0x8101028094008800, 0x4110431904840400,
    0x0402004c20052c00, 0x8100000430020a08, 0x0100720210042080, 0x8003221801010200};

constexpr Numbers rook_numbers = {
    0x0080002040008010, 0x0140012000100040, 0x218008a000801001, 0x0880040800100281,
    0x0900040208010010, 0x0d00010008321400, 0x0c00044108020090, 0x6080004080002100,
    0x101180019060c000, 0x2003401004a000c4, 0x0000808020001000, 0x0001000810002100,
    0x20018008008c0080, 0x0012000408100200, 0x1211000401000200, 0x0002000844010092,
    0x0005848000400020, 0x0400404010002004, 0x0122020040802014, 0x88700100200c1100,
    0x9008004004004200, 0x0480808002000400, 0x00000400020110c8, 0x00820a0000489104,
    0x00800e4840002001, 0x0200400180600080, 0x0000200080801000, 0x000c080080801000,
    0x0020080080040080, 0x0000040080800200, 0x0130040101000200, 0x900a108200011044,
    0x1080004000402001, 0x0010004000402006, 0x0020001041002100, 0x0203041001000820,
    0x0088001009000500, 0x1402008502001008, 0x0080410204002810, 0x002a004082000114,
    0x0040008040288000, 0x02c0004020008080, 0x8800200041010010, 0x2010010080080800,
    0x2038008004008008, 0x0425820004008080, 0x1010280290040021, 0x01e8811084c20024,
    0x3080022000400a40, 0x0010902000400080, 0x0204120424408200, 0x2140801000080080,
    0x2010080080040080, 0x0050040080020080, 0x0600080102100400, 0x0001114ba4010200,
    0x00102080030011c3, 0x41004001001c8021, 0x0411001209402003, 0x0440100020040901,
    0x0002002008041002, 0x0081008802040041, 0xc000808130080224, 0x00020500204c1082};

constexpr bool on_board(int file, int rank) {
    return file >= 0 && file < 8 && rank >= 0 && rank < 8;
}

// The squares from `square` on in one direction, up to and with the first occupied one.
Bitboard ray(Square square, const std::array<int, 2>& step, Bitboard occupied) {
    Bitboard result = 0;
    int file = file_of(square) + step[0], rank = rank_of(square) + step[1];
    for (; on_board(file, rank); file += step[0], rank += step[1]) {
        result |= bit(square_at(file, rank));
        if (occupied & bit(square_at(file, rank))) break;
    }
    return result;
}

Bitboard rays(Square square, const Directions& directions, Bitboard occupied) {
    Bitboard result = 0;
    for (const auto& step : directions) result |= ray(square, step, occupied);
    return result;
}

// Pieces on the last square of a ray change nothing.
Bitboard relevant(Square square, const Directions& directions) {
    Bitboard result = 0;
    for (const auto& step : directions) {
        const Bitboard squares = ray(square, step, 0);
        for (Bitboard rest = squares; rest != 0;) {
            const Square at = pop(rest);
            if (on_board(file_of(at) + step[0], rank_of(at) + step[1])) result |= bit(at);
        }
    }
    return result;
}

// Fills the table of one square and returns where the next one's begins.
Bitboard* fill(Magic& magic, Square square, const Directions& directions, Bitboard number,
               Bitboard* attacks) {
    magic.mask = relevant(square, directions);
    magic.number = number;
    magic.attacks = attacks;
    magic.shift = 64 - std::popcount(magic.mask);
    Bitboard occupied = 0;
    do {
        attacks[(occupied * number) >> magic.shift] = rays(square, directions, occupied);
        occupied = (occupied - magic.mask) & magic.mask;
    } while (occupied != 0);
    return attacks + (std::size_t{1} << std::popcount(magic.mask));
}

}  // namespace

Sliders::Sliders() {
    Bitboard* attacks = attacks_.data();
    for (Square square = 0; square < 64; ++square)
        attacks =
            fill(bishop[index(square)], square, diagonal, bishop_numbers[index(square)], attacks);
    for (Square square = 0; square < 64; ++square)
        attacks = fill(rook[index(square)], square, straight, rook_numbers[index(square)], attacks);
    for (const auto* directions : {&diagonal, &straight})
        for (Square from = 0; from < 64; ++from)
            for (const auto& step : *directions) {
                const auto whole =
                    ray(from, step, 0) | ray(from, {-step[0], -step[1]}, 0) | bit(from);
                for (Bitboard rest = ray(from, step, 0); rest != 0;) {
                    const Square to = pop(rest);
                    line[index(from)][index(to)] = whole;
                    between[index(from)][index(to)] = ray(from, step, bit(to)) & ~bit(to);
                }
            }
}

const Sliders sliders;

}  // namespace chess::tables
