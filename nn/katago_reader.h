// The token stream of KataGo's network files and the records that every part of a network is made
// of. Only the importer uses it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nn/graph.h"

namespace nn::katago {

inline constexpr int most_channels = 1 << 14;  // of any layer

class Reader {
   public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    // The next word between white space; fails at the end of the file. `what` is for the message.
    std::string_view word(std::string_view what);
    int integer(std::string_view what, int least, int most);
    float number(std::string_view what);
    // `count` floats, in binary after "@BIN@" or as words.
    std::vector<float> floats(std::string_view what, std::int64_t count);

   private:
    void skip_space();
    [[noreturn]] void refuse(std::string_view what, std::string_view found) const;

    std::string_view bytes_;
    std::size_t at_ = 0;
};

// Convolution weights in our order [out, in, k, k]. Fails unless it reads `inputs` channels.
struct Convolution {
    std::string name;
    Tensor kernel;
};
Convolution read_convolution(Reader& reader, int inputs);

// Weights in our order [out, in].
struct Matrix {
    std::string name;
    Tensor weight;
};
Matrix read_matrix(Reader& reader, int inputs);

struct Norm {
    std::string name;
    std::vector<Tensor> weights;  // as Operation::batch_norm lists them
    float epsilon = 0;
};
Norm read_norm(Reader& reader, int channels);

Tensor read_bias(Reader& reader, int channels);
Activation read_activation(Reader& reader, int version);

}  // namespace nn::katago
