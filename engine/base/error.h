// The one exception type: input from outside (a file, a flag, a protocol line) was bad.
// Programmer mistakes are asserts; "no such move" is an empty optional.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace engine {

class Error : public std::runtime_error {
   public:
    using std::runtime_error::runtime_error;
};

// The message says what is wrong and where, in one line, without a full stop.
template <class... Parts>
[[noreturn]] void fail(fmt::format_string<Parts...> text, Parts&&... parts) {
    throw Error(fmt::format(text, std::forward<Parts>(parts)...));
}

}  // namespace engine
