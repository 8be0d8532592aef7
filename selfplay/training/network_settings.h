// What the network of a run is built as. It cannot change once the run has begun.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>
#include <tuple>

#include "engine/base/option.h"
#include "engine/base/random.h"
#include "engine/encoding.h"
#include "nn/graph.h"

namespace selfplay::training {

enum class EncodingName : std::uint8_t { alphazero, katago_v7, attacks };
inline constexpr std::array<std::string_view, 3> encoding_names = {"alphazero", "katago-v7",
                                                                   "attacks"};

enum class HeadKind : std::uint8_t { pooled, flat };
inline constexpr std::array<std::string_view, 2> head_names = {"pooled", "flat"};

inline constexpr std::array<std::string_view, 3> attention_names = {"none", "squeeze", "pooling"};
enum class AttentionName : std::uint8_t { none, squeeze, pooling };

struct NetworkSettings {
    int blocks = 5, channels = 64;
    EncodingName encoding = EncodingName::alphazero;
    HeadKind heads = HeadKind::pooled;
    AttentionName attention = AttentionName::none;
    int value_width = 64;
    bool wdl = true;
    bool ownership = true, score = true;  // Go
    bool moves_left = false;

    std::string_view encoding_name() const {
        return encoding_names[static_cast<std::size_t>(encoding)];
    }

    static constexpr auto options() {
        using engine::Choice;
        using engine::Flag;
        using engine::Option;
        using P = NetworkSettings;
        return std::tuple{
            Option<P, int>{"blocks", &P::blocks, 0, 80, "residual blocks of the network"},
            Option<P, int>{"channels", &P::channels, 1, 1024, "its width"},
            Choice<P, EncodingName>{"encoding", &P::encoding, encoding_names,
                                    "what it sees: alphazero: stones or men and their past; "
                                    "katago-v7 (Go): liberties, ladders, komi and rules too; "
                                    "attacks (chess, shogi): men, and the squares they attack"},
            Choice<P, HeadKind>{"heads", &P::heads, head_names,
                                "pooled: any board size in Go; flat: dense over one board"},
            Choice<P, AttentionName>{"attention", &P::attention, attention_names,
                                     "what a block sees of the whole board"},
            Option<P, int>{"value-width", &P::value_width, 1, 4096, "of the value's hidden layer"},
            Flag<P>{"wdl", &P::wdl, "value as win, draw and loss"},
            Flag<P>{"ownership", &P::ownership, "Go: learn who owns each point"},
            Flag<P>{"score", &P::score, "Go: learn the final lead"},
            Flag<P>{"moves-left", &P::moves_left, "learn how long the game still lasts"},
        };
    }
};

// A network with random weights for positions of such a shape. Fails with engine::Error on what
// cannot be built.
nn::Graph new_network(const NetworkSettings& settings, std::string_view game,
                      const engine::EncodingShape& shape, engine::Random& random);
// Likewise, for games that begin like `start`.
template <engine::Encoded G>
nn::Graph new_network(const NetworkSettings& settings, const G& start, std::uint64_t seed) {
    engine::Random random(seed);
    const auto shape = engine::find_encoding<G>(settings.encoding_name()).shape(start);
    return new_network(settings, G::name, shape, random);
}

// The network of a file, to learn on from where it stands. `fresh` is what the run would begin with
// otherwise; a file's that has fewer blocks or channels grows to its size (nn/growth.h). Fails with
// engine::Error when the file's is not built as that.
nn::Graph network_like(const nn::Graph& fresh, const std::filesystem::path& file);

}  // namespace selfplay::training
