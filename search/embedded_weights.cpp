#include "search/embedded_weights.h"

#include <cstddef>

namespace search {

struct EmbeddedFile {
    const char *name, *begin, *end;
};

// From weights/embed.S.in.
extern "C" const EmbeddedFile sanban_weights[];

std::string_view embedded_weights(std::string_view name) {
    for (const EmbeddedFile* file = sanban_weights; file->name; ++file)
        if (name == file->name)
            return {file->begin, static_cast<std::size_t>(file->end - file->begin)};
    return {};
}

}  // namespace search
