#include "protocols/lines.h"

#include <unistd.h>

#include <csignal>

namespace protocols {

bool read_line(std::istream& in, Line& line, std::size_t most) {
    line.text.clear();
    line.too_long = false;
    constexpr auto end = std::istream::traits_type::eof();
    bool any = false;
    auto* const buffer = in.rdbuf();
    for (int c = buffer->sbumpc(); c != end; c = buffer->sbumpc()) {
        any = true;
        if (c == '\n') return true;
        if (c == '\t') c = ' ';
        if (c < ' ' || c == 127) continue;
        if (line.text.size() == most)
            line.too_long = true;
        else
            line.text += static_cast<char>(c);
    }
    in.setstate(any ? std::ios::eofbit : std::ios::eofbit | std::ios::failbit);
    return any;
}

void end_on_signals() {
    for (const int signal : {SIGTERM, SIGINT}) std::signal(signal, [](int) { ::_exit(0); });
}

}  // namespace protocols
