#include "selfplay/alphago/stage_network.h"

#include <fmt/format.h>

#include "nn/builders.h"

namespace selfplay::alphago {

namespace {

nn::Facts facts_of(const StageNetwork& network, std::string_view encoding, std::string_view kind) {
    nn::Facts facts;
    facts.game = go::Go::name;
    facts.encoding = encoding;
    facts.name = fmt::format("alphago {} {}x{}", kind, network.layers, network.filters);
    facts.source = fmt::format("sanban learn {}", kind);
    facts.board = network.size;
    facts.blocks = network.layers;
    facts.channels = network.filters;
    return facts;
}

int planes_of(const nn::Facts& facts) {
    return engine::find_encoding<go::Go>(facts.encoding).shape(go::Go(facts.board)).planes;
}

}  // namespace

nn::Graph new_policy(const StageNetwork& network, std::uint64_t seed) {
    engine::Random random(seed);
    const auto facts = facts_of(network, network.encoding(), "policy");
    return nn::build_alphago_policy(facts, planes_of(facts), random);
}

nn::Graph new_value(const StageNetwork& network, std::uint64_t seed) {
    engine::Random random(seed);
    const auto facts = facts_of(network, "alphago49", "value");
    return nn::build_alphago_value(facts, planes_of(facts), random);
}

const nn::training::Samples& ExpertBatches::make(std::span<const ExpertPlace> places,
                                                 std::span<const int> symmetries,
                                                 std::span<const nn::training::Term> terms) {
    lessons_.resize(places.size());
    const auto threads = static_cast<std::size_t>(workers_.count());
    workers_.run([&](int worker) {
        for (auto i = static_cast<std::size_t>(worker); i < places.size(); i += threads)
            training::write_lesson(record_of(places[i]), places[i].turn, encoding_, symmetries[i],
                                   {}, lessons_[i]);
    });
    batch_.fill(lessons_, places[0].game->size, terms);
    return batch_.samples();
}

}  // namespace selfplay::alphago
