#include "selfplay/training/journal.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "engine/base/error.h"
#include "engine/base/files.h"

namespace selfplay::training {

namespace {

using Json = nlohmann::ordered_json;
using nn::training::Loss;

// The fields of an entry by their names in the file; one table for writing and reading.
template <class Visit>
void for_quality(Visit visit) {
    visit("samples", &Quality::samples);
    visit("loss", &Quality::loss);
    visit("policy_loss", &Quality::policy_loss);
    visit("policy_accuracy", &Quality::policy_accuracy);
    visit("value_loss", &Quality::value_loss);
    visit("value_error", &Quality::value_error);
    visit("ownership_loss", &Quality::ownership_loss);
    visit("score_loss", &Quality::score_loss);
}

template <class Visit>
void for_tally(Visit visit) {
    visit("games", &GameTally::games);
    visit("plies", &GameTally::plies);
    visit("taught", &GameTally::taught);
    visit("draws", &GameTally::draws);
    visit("first_wins", &GameTally::first_wins);
    visit("resigned", &GameTally::resigned);
    visit("cut_off", &GameTally::cut_off);
}

template <class Visit>
void for_entry(Visit visit) {
    visit("seconds", &Entry::seconds);
    visit("games", &Entry::games);
    visit("positions", &Entry::positions);
    visit("steps", &Entry::steps);
    visit("games_per_hour", &Entry::games_per_hour);
    visit("evaluations_per_second", &Entry::evaluations_per_second);
    visit("learner_share", &Entry::learner_share);
    visit("ratio", &Entry::ratio);
    visit("window", &Entry::window);
    visit("simulations", &Entry::simulations);
    visit("resign_threshold", &Entry::resign_threshold);
}

Json json_of(const Quality& quality) {
    Json json;
    for_quality([&](const char* name, auto field) { json[name] = quality.*field; });
    return json;
}

template <class T, class Field>
void read(const Json& json, const char* name, T& to, Field field) {
    if (const auto found = json.find(name); found != json.end() && found->is_number())
        found->get_to(to.*field);
}

Quality quality_from(const Json& json) {
    Quality quality;
    for_quality([&](const char* name, auto field) { read(json, name, quality, field); });
    return quality;
}

std::optional<Entry> entry_from(std::string_view line) {
    const auto json = Json::parse(line, nullptr, false);
    if (!json.is_object()) return std::nullopt;
    Entry entry;
    for_entry([&](const char* name, auto field) { read(json, name, entry, field); });
    entry.learned = quality_from(json.value("learned", Json::object()));
    entry.held_out = quality_from(json.value("held_out", Json::object()));
    const auto played = json.value("played", Json::object());
    for_tally([&](const char* name, auto field) { read(played, name, entry.played, field); });
    return entry;
}

}  // namespace

void QualityTally::add(const nn::training::Report& report,
                       std::span<const nn::training::Term> terms, int samples) {
    terms_.assign(terms.begin(), terms.end());
    costs_.resize(terms.size());
    for (std::size_t t = 0; t < terms.size(); ++t) costs_[t] += report.costs[t];
    samples_ += samples;
    loss_ += report.loss * samples;
}

Quality QualityTally::mean() const {
    Quality quality;
    quality.samples = samples_;
    if (samples_ > 0) quality.loss = loss_ / samples_;
    for (std::size_t t = 0; t < terms_.size(); ++t) {
        const auto& cost = costs_[t];
        switch (terms_[t].loss) {
            case Loss::policy:
                quality.policy_loss = cost.mean_loss();
                quality.policy_accuracy = cost.accuracy();
                break;
            case Loss::distribution:
            case Loss::square:
                quality.value_loss = cost.mean_loss();
                quality.value_error = cost.mean_square_error();
                break;
            case Loss::ownership:
                quality.ownership_loss = cost.mean_loss();
                break;
            case Loss::score:
                quality.score_loss = cost.mean_loss();
                break;
            case Loss::moves_left:
                break;
        }
    }
    return quality;
}

void GameTally::add(const records::Game& game) {
    ++games;
    plies += game.turns.size();
    taught += static_cast<std::uint64_t>(
        std::count_if(game.turns.begin(), game.turns.end(),
                      [](const records::Turn& turn) { return turn.share_count > 0; }));
    draws += game.outcome == engine::Outcome::draw;
    first_wins += game.outcome == engine::Outcome::first_wins;
    resigned += game.ending == records::Ending::resigned;
    cut_off += game.ending == records::Ending::move_limit;
}

std::string to_json(const Entry& entry) {
    Json json;
    for_entry([&](const char* name, auto field) { json[name] = entry.*field; });
    json["learned"] = json_of(entry.learned);
    json["held_out"] = json_of(entry.held_out);
    Json played;
    for_tally([&](const char* name, auto field) { played[name] = entry.played.*field; });
    json["played"] = played;
    return json.dump();
}

Journal::Journal(std::filesystem::path path) : path_(std::move(path)) {
    if (!std::filesystem::exists(path_)) return;
    const auto text = engine::read_file(path_);
    std::size_t sound = 0;
    for (std::size_t at = 0; at < text.size();) {
        const auto end = text.find('\n', at);
        if (end == std::string::npos) break;
        if (const auto entry = entry_from(std::string_view(text).substr(at, end - at)))
            entries_.push_back(*entry);
        at = sound = end + 1;
    }
    if (sound < text.size()) std::filesystem::resize_file(path_, sound);
}

void Journal::append(const Entry& entry) {
    engine::append_file(path_, to_json(entry) + '\n');
    entries_.push_back(entry);
}

}  // namespace selfplay::training
