#include "selfplay/training/folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>

#include "engine/base/error.h"
#include "engine/base/files.h"

namespace selfplay::training {

namespace {

using engine::fail;

std::filesystem::path state_file(const std::filesystem::path& folder) {
    return folder / "state.json";
}

}  // namespace

RunFolder::RunFolder(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code error;
    std::filesystem::create_directories(path_, error);
    if (error) fail("{}: cannot make the folder: {}", path_.string(), error.message());
    const auto file = path_ / "lock";
    lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (lock_ < 0) fail("{}: {}", file.string(), std::strerror(errno));
    if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
    ::close(lock_);
    fail("{} is in use by another run; stop that one or name another folder", path_.string());
}

RunFolder::~RunFolder() { ::close(lock_); }

RunState RunFolder::state() const {
    RunState state;
    if (!std::filesystem::exists(state_file(path_))) return state;
    const auto json = nlohmann::json::parse(engine::read_file(state_file(path_)), nullptr, false);
    if (!json.is_object()) return state;
    const auto number = [&](const char* name, auto& to) {
        if (const auto found = json.find(name); found != json.end() && found->is_number())
            found->get_to(to);
    };
    number("games", state.games);
    number("positions", state.positions);
    number("seconds", state.seconds);
    return state;
}

void RunFolder::keep(const RunState& state) const {
    const nlohmann::ordered_json json{
        {"games", state.games}, {"positions", state.positions}, {"seconds", state.seconds}};
    engine::write_file(state_file(path_), json.dump() + '\n');
}

}  // namespace selfplay::training
