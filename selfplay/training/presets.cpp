// The recipes that a run may start from.
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/base/error.h"
#include "engine/games.h"
#include "selfplay/training/settings.h"

namespace selfplay::training {

namespace {

// What both papers have in common: 800 simulations by PUCT with noise, every turn a lesson, no
// target but policy and value, the plain average of nothing.
void take_papers(Settings& settings) {
    settings.network = {.blocks = 19,
                        .channels = 256,
                        .heads = HeadKind::flat,
                        .value_width = 256,
                        .wdl = false,
                        .ownership = false,
                        .score = false};
    auto& actors = settings.actors;
    actors.exploration = Exploration::noise;
    actors.noise_share = 0.25f;
    actors.simulations = actors.fast_simulations = 800;
    actors.full_share = 1;
    actors.temperature = 1;
    actors.late_temperature = 0;
    actors.temperature_moves = 30;
    actors.opening_share = 0;
    settings.replay = {.window = 500'000, .window_factor = 0};
    auto& learn = settings.learn;
    learn.momentum = 0.9f;
    learn.weight_decay = 1e-4f;
    learn.average = 0;
    learn.warm_up = 0;
    settings.run.last_simulations = settings.run.growth_games = 0;
    settings.run.refresh = 1000;
    settings.run.learner_share = 0.4f;
}

// Chess and shogi from nothing within an hour or two (README says how far). Random players mate too
// rarely for a value to be learned from how their games end: rollouts teach it first what men are
// worth, and a game that is cut off ends as the search expected. Small networks want the present
// board and who attacks what, not eight boards of the past, and steps that stochastic gradient
// descent at the usual rate does not take. A game has one result but a hundred positions: a value
// that learns results alone, or from few games, knows those games by heart.
void take_laptop_of_men(Settings& settings) {
    settings.network.blocks = 4;
    settings.network.channels = 32;
    settings.network.encoding = EncodingName::attacks;
    settings.network.heads = HeadKind::flat;
    settings.learn.optimiser = nn::training::Method::adamw;
    settings.learn.rate = 0.003f;
    settings.learn.value_weight = 2;
    settings.replay.judges_cut_off = true;
    settings.replay.search_share = 0.4f;
    settings.replay.window = 4000;
    settings.run.ratio = 1.5f;
    settings.run.rollout_games = 1000;
    const bool chess = settings.game == "chess";
    settings.actors.move_limit = chess ? 160 : 200;
    settings.actors.scattered_share = chess ? 0.4f : 0;
}

// What each recipe's fields are by themselves, and in Go what the network of a small machine need
// not find out alone. On 5x5 after ten minutes of a thread each (networks of 3 blocks, 32 channels;
// 100 games at 64 simulations, Elo): 16 simulations at every turn against 32 at a quarter of the
// turns and 8 at the others +123 [63, 185], against 8 at every turn +81 [33, 131]; these inputs and
// pooling against none +56 [4, 109], though they cost two thirds of the evaluations.
void take_laptop(Settings& settings) {
    if (settings.game != "go") return take_laptop_of_men(settings);
    // Boards so small need no more than a small network, which sees plain stones at a fifth of the
    // cost: 15 minutes of two busy cores solve 5x5 (README).
    constexpr int small_board = 6;
    if (settings.actors.size <= small_board) {
        settings.network.blocks = 3;
        settings.network.channels = 24;
        return;
    }
    settings.network.encoding = EncodingName::katago_v7;
    settings.network.attention = AttentionName::pooling;
    // Nearly three times as fast as the usual one (README says what an hour comes to).
    if (settings.actors.size == 7) {
        settings.network.blocks = 4;
        settings.network.channels = 32;
    }
}

// Silver et al. 2017.
void take_alphagozero(Settings& settings) {
    take_papers(settings);
    if (settings.actors.size == 19) settings.actors.noise_alpha = 0.03f;
    settings.learn.batch = 2048;
    settings.learn.rate = 0.01f;
    settings.learn.first_drop = 400'000;
    settings.learn.second_drop = 600'000;
    settings.run.ratio = 1.5f;
    settings.run.gate = true;
    settings.run.gate_games = 400;
    settings.run.gate_score = 0.55f;
    settings.run.gate_simulations = 800;
}

// Silver et al. 2018.
void take_alphazero(Settings& settings) {
    take_papers(settings);
    auto& actors = settings.actors;
    if (settings.game == "chess") actors.noise_alpha = 0.3f;
    if (settings.game == "shogi") actors.noise_alpha = 0.15f;
    if (settings.game == "go" && actors.size == 19) actors.noise_alpha = 0.03f;
    actors.symmetries = settings.replay.symmetries = false;
    settings.learn.batch = 4096;
    settings.learn.rate = 0.2f;
    settings.learn.first_drop = 100'000;
    settings.learn.second_drop = 300'000;
    settings.learn.third_drop = 500'000;
    settings.run.ratio = 0.7f;
}

// Small boards are won by the first player; komi is what makes their games even.
float usual_komi(int size) {
    if (size == 5) return 24;
    return size == 7 ? 9 : 7.5f;
}

}  // namespace

Settings preset_settings(std::string_view preset, std::string_view game, int size) {
    Settings settings;
    settings.game = game;
    settings.preset = preset;
    engine::Games::visit(game, []<class G>() { return true; });
    settings.actors.size = size;
    settings.actors.komi = usual_komi(size);
    if (game != "go") settings.network.ownership = settings.network.score = false;
    if (preset == "alphagozero") return take_alphagozero(settings), settings;
    if (preset == "alphazero") return take_alphazero(settings), settings;
    if (preset != "laptop")
        engine::fail("preset must be one of {}, not {}", fmt::join(preset_names, ", "), preset);
    return take_laptop(settings), settings;
}

}  // namespace selfplay::training
