// `sanban convert IN OUT`: foreign weights to our own format.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "nn/load.h"
#include "protocols/commands.h"

namespace protocols {

int run_convert(Arguments arguments) {
    std::string in, out;
    CLI::App app("Writes a network of any known format as safetensors", "sanban convert");
    app.add_option("IN", in, "a network of sanban, KataGo, lc0 or Leela Zero")->required();
    app.add_option("OUT", out, "where our own format goes")->required();
    std::vector<std::string> words(arguments.rbegin(), arguments.rend());
    try {
        app.parse(words);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    const auto graph = nn::load(in);
    nn::save(graph, out);
    fmt::print("{}: {} parameters for {} ({})\n", out, nn::parameter_count(graph), graph.facts.game,
               graph.facts.encoding);
    return 0;
}

}  // namespace protocols
