// The replay memory: a window of the newest self-play games that grows with the run, a small part
// of it held out to judge by, and batches drawn from it. Planes are made when a position is drawn,
// by playing its game again, on a few threads of its own. One owner, one thread; calls block.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/encoding.h"
#include "nn/training/workers.h"
#include "selfplay/training/batch.h"
#include "selfplay/training/pool.h"
#include "selfplay/training/replay_settings.h"

namespace selfplay::training {

template <engine::Encoded G>
class Replay {
   public:
    Replay(ReplaySettings settings, std::string_view encoding, int threads)
        : settings_(settings),
          encoding_(engine::find_encoding<G>(encoding)),
          workers_(std::max(threads, 1)) {}

    // Takes a game in, and drops what the window no longer has room for when `played` games have
    // been played in all. False, and nothing is taken, when it cannot be played or teaches nothing.
    bool add(records::Game record, std::uint64_t played);

    const Pool& lessons() const { return lessons_; }
    const Pool& held_out() const { return held_out_; }
    std::size_t games() const { return lessons_.games() + held_out_.games(); }

    // A batch of one board side. Shown until the next call.
    const nn::training::Samples& draw(int count, std::span<const nn::training::Term> terms,
                                      engine::Random& random) {
        return draw(lessons_, count, terms, random);
    }
    // Of the games that were held out, of which there must be one.
    const nn::training::Samples& draw_held_out(int count, std::span<const nn::training::Term> terms,
                                               engine::Random& random) {
        return draw(held_out_, count, terms, random);
    }
    // Positions for the calibration of a network.
    std::vector<G> positions(int count, engine::Random& random) const;

   private:
    const nn::training::Samples& draw(const Pool& pool, int count,
                                      std::span<const nn::training::Term> terms,
                                      engine::Random& random);
    std::vector<std::uint16_t> turns_of(const records::Game& record) const;
    static bool playable(const records::Game& record, const G& start);

    ReplaySettings settings_;
    const engine::Encoding<G>& encoding_;
    Pool lessons_, held_out_;
    nn::training::Workers workers_;
    std::vector<Lesson> drawn_;
    Batch batch_;
};

template <engine::Encoded G>
bool Replay<G>::playable(const records::Game& record, const G& start) {
    G game = start;
    for (const auto& turn : record.turns) {
        if (!game.legal_moves().contains(turn.move)) return false;
        game.play(turn.move);
    }
    return true;
}

template <engine::Encoded G>
std::vector<std::uint16_t> Replay<G>::turns_of(const records::Game& record) const {
    std::vector<std::uint16_t> turns;
    const auto most = std::min<std::size_t>(record.turns.size(), 0xffff);
    for (std::size_t i = 0; i < most; ++i) {
        const auto& turn = record.turns[i];
        if (turn.share_count > 0 || (settings_.fast_searches && turn.simulations > 0))
            turns.push_back(static_cast<std::uint16_t>(i));
    }
    return turns;
}

template <engine::Encoded G>
bool Replay<G>::add(records::Game record, std::uint64_t played) {
    if (record.game != G::name) return false;
    const G start = G::from_text(record.start);
    auto turns = turns_of(record);
    if (turns.empty() || !playable(record, start)) return false;
    // By what the game is, so that a resumed run holds out the same ones.
    std::uint64_t key = record.steps;
    for (const auto& turn : record.turns) key = engine::mixed(key, turn.move.code);
    const bool held =
        static_cast<double>(engine::Random(key)() >> 11) * 0x1p-53 < double{settings_.held_out};
    auto& pool = held ? held_out_ : lessons_;
    pool.add(std::move(record), encoding_.shape(start).height, std::move(turns));
    const auto room = static_cast<double>(window_of(settings_, played));
    while (static_cast<double>(lessons_.games()) > room) lessons_.drop_oldest();
    while (static_cast<double>(held_out_.games()) > std::max(1.0, room * settings_.held_out))
        held_out_.drop_oldest();
    return true;
}

template <engine::Encoded G>
const nn::training::Samples& Replay<G>::draw(const Pool& pool, int count,
                                             std::span<const nn::training::Term> terms,
                                             engine::Random& random) {
    const int side = pool.draw_side(random);
    const auto places = pool.draw(side, count, random);
    const auto symmetries =
        settings_.symmetries ? encoding_.shape(G::from_text(places[0].game->start)).symmetries : 1;
    std::vector<int> turned(places.size());
    for (auto& symmetry : turned) symmetry = random.below(symmetries);
    drawn_.resize(places.size());
    const auto threads = static_cast<std::size_t>(workers_.count());
    workers_.run([&](int worker) {
        for (auto i = static_cast<std::size_t>(worker); i < places.size(); i += threads)
            write_lesson(*places[i].game, places[i].turn, encoding_, turned[i],
                         {settings_.search_share, settings_.judges_cut_off}, drawn_[i]);
    });
    batch_.fill(drawn_, side, terms);
    return batch_.samples();
}

template <engine::Encoded G>
std::vector<G> Replay<G>::positions(int count, engine::Random& random) const {
    std::vector<G> positions;
    const auto places = lessons_.draw(lessons_.draw_side(random), count, random);
    positions.reserve(places.size());
    for (const auto& place : places) positions.push_back(position_of<G>(*place.game, place.turn));
    return positions;
}

}  // namespace selfplay::training
