// Learning from recorded games alone, without playing: from files of records to a file of weights.
// Blocks until it is done or stopped.
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "nn/load.h"
#include "selfplay/records/segment.h"
#include "selfplay/training/replay.h"
#include "selfplay/training/settings.h"
#include "selfplay/training/student.h"

namespace selfplay::training {

struct LectureInput {
    std::vector<std::filesystem::path> records;  // files of games, or folders of them
    std::filesystem::path out;
    std::optional<std::filesystem::path> weights;  // to go on from; else random ones
    int steps = 1000;
    int threads = 1;
};

// The files behind the paths, in their order; fails with engine::Error on a path that is not there.
std::vector<std::filesystem::path> record_files(std::span<const std::filesystem::path> paths);

template <engine::Encoded G>
class Lecture {
   public:
    Lecture(LectureInput input, const Settings& settings, Say say)
        : input_(std::move(input)), settings_(settings), say_(std::move(say)) {}

    // Fails with engine::Error when there is nothing to learn from, or the numbers run away.
    void run(const std::stop_token& stop);

   private:
    nn::Graph start(const records::Game& game) const;
    void read(Replay<G>& replay) const;
    void tell(Replay<G>& replay, nn::training::Learner& learner, QualityTally& tally) const;
    void save(Replay<G>& replay, nn::training::Learner& learner) const;

    LectureInput input_;
    Settings settings_;
    Say say_;
};

template <engine::Encoded G>
void Lecture<G>::read(Replay<G>& replay) const {
    std::uint64_t games = 0, left_out = 0;
    for (const auto& path : record_files(input_.records)) {
        auto segment = records::unpack(engine::read_file(path));
        if (!segment.damage.empty())
            say_(fmt::format("{}: {}; left out", path.string(), segment.damage));
        for (auto& game : segment.games)
            if (!replay.add(std::move(game), ++games)) ++left_out;
    }
    say_(fmt::format("{} games, {} of them teach nothing of {}", games, left_out, G::name));
    if (replay.lessons().positions() == 0) engine::fail("there is nothing to learn from");
}

template <engine::Encoded G>
nn::Graph Lecture<G>::start(const records::Game& game) const {
    if (input_.weights) return nn::load(*input_.weights);
    return new_network(settings_.network, G::from_text(game.start),
                       static_cast<std::uint64_t>(settings_.run.seed));
}

template <engine::Encoded G>
void Lecture<G>::run(const std::stop_token& stop) {
    auto replay_settings = settings_.replay;
    replay_settings.window = 100'000'000;  // all there are
    Replay<G> replay(replay_settings, settings_.network.encoding_name(), input_.threads);
    read(replay);
    const auto graph = start(*replay.lessons().newest());
    nn::training::Learner learner(graph, learner_settings(settings_.learn, graph, input_.threads));
    engine::Random random(static_cast<std::uint64_t>(settings_.run.seed));
    QualityTally tally;
    for (int step = 1; step <= input_.steps && !stop.stop_requested(); ++step) {
        const auto& samples = replay.draw(settings_.learn.batch, learner.terms(), random);
        const auto report = learner.step(samples);
        if (!report.fault.empty())
            engine::fail("step {}: {}; lower --rate or set --most-norm", step, report.fault);
        tally.add(report, learner.terms(), samples.size);
        if (step % settings_.run.refresh == 0) tell(replay, learner, tally);
    }
    save(replay, learner);
}

template <engine::Encoded G>
void Lecture<G>::tell(Replay<G>& replay, nn::training::Learner& learner,
                      QualityTally& tally) const {
    const auto learned = std::exchange(tally, {}).mean();
    auto line =
        fmt::format("step {} | loss {:.3f} | policy {:.1f} % | value error {:.3f}", learner.steps(),
                    learned.loss, 100 * learned.policy_accuracy, learned.value_error);
    if (replay.held_out().positions() > 0) {
        engine::Random random(1);
        QualityTally judged;
        const auto& samples = replay.draw_held_out(1024, learner.terms(), random);
        judged.add(learner.evaluate(samples), learner.terms(), samples.size);
        const auto held = judged.mean();
        line += fmt::format(" | held out: loss {:.3f}, policy {:.1f} %, value error {:.3f}",
                            held.loss, 100 * held.policy_accuracy, held.value_error);
    }
    say_(line);
}

template <engine::Encoded G>
void Lecture<G>::save(Replay<G>& replay, nn::training::Learner& learner) const {
    engine::Random random(2);
    const auto graph = settings_.learn.average > 0
                           ? learner.averaged_on(replay.draw(1024, learner.terms(), random))
                           : learner.newest();
    nn::save(graph, input_.out);
    say_(fmt::format("{}: step {}", input_.out.string(), learner.steps()));
}

}  // namespace selfplay::training
