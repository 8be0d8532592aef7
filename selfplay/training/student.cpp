#include "selfplay/training/student.h"

#include <fmt/format.h>

#include <utility>

#include "engine/base/error.h"

namespace selfplay::training {

namespace {

namespace fs = std::filesystem;
constexpr int most_faults = 3;

nn::training::Learner make_learner(nn::Graph fresh, const LearnSettings& settings, int threads) {
    const auto learner = learner_settings(settings, fresh, threads);
    return {std::move(fresh), learner};
}

}  // namespace

Student::Student(nn::Graph fresh, const LearnSettings& settings, int threads,
                 const RunFolder& folder, Say say)
    : folder_(folder),
      say_(std::move(say)),
      learner_(make_learner(std::move(fresh), settings, threads)),
      averages_(settings.average > 0) {
    if (folder.has_checkpoint())
        restore();
    else
        save();
}

void Student::restore() {
    std::string damage;
    for (const auto& path : {folder_.checkpoint(), folder_.old_checkpoint()}) {
        if (!fs::exists(path)) continue;
        try {
            learner_.restore(path);
            if (!damage.empty())
                say_(fmt::format("{}; going on from {}", damage, path.filename().string()));
            return;
        } catch (const engine::Error& error) {
            if (damage.empty()) damage = error.what();
        }
    }
    engine::fail(
        "{}; no checkpoint is left to go on from: remove both to learn from the games "
        "anew",
        damage);
}

void Student::learn(const nn::training::Samples& samples) {
    const auto report = learner_.step(samples);
    if (!report.fault.empty()) return fall_back(report.fault);
    tally_.add(report, learner_.terms(), samples.size);
}

void Student::fall_back(const std::string& fault) {
    if (++faults_ > most_faults)
        engine::fail("step {}: {}; so it was {} times: lower --rate or set --most-norm",
                     learner_.steps(), fault, most_faults);
    say_(fmt::format("step {}: {}; back to the last checkpoint", learner_.steps(), fault));
    tally_ = {};
    restore();
}

void Student::save() {
    try {
        nn::validate(learner_.newest());
    } catch (const engine::Error& error) {
        return fall_back(error.what());
    }
    // Only what can be read again takes the place of the old one.
    if (fs::exists(folder_.checkpoint()))
        fs::rename(folder_.checkpoint(), folder_.old_checkpoint());
    learner_.save(folder_.checkpoint());
    faults_ = 0;
}

Quality Student::take_quality() { return std::exchange(tally_, {}).mean(); }

}  // namespace selfplay::training
