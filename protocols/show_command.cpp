// `sanban show FILE`: what a weight file is, or what is wrong with it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "nn/describe.h"
#include "nn/load.h"
#include "protocols/commands.h"

namespace protocols {

int run_show(Arguments arguments) {
    std::string path;
    CLI::App app("Says what a weight file holds, or what is wrong with it", "sanban show");
    app.add_option("FILE", path, "a network of sanban, KataGo, lc0 or Leela Zero")->required();
    std::vector<std::string> words(arguments.rbegin(), arguments.rend());
    try {
        app.parse(words);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    fmt::print("{}", nn::describe(nn::load(path)));
    return 0;
}

}  // namespace protocols
