// The folder of a run: where its files are, that no two runs use it at a time, and how far it has
// come. Its owner is the run.
#pragma once

#include <cstdint>
#include <filesystem>

namespace selfplay::training {

struct RunState {
    std::uint64_t games = 0, positions = 0;  // in all; positions that teach
    double seconds = 0;                      // that the run has lasted
};

class RunFolder {
   public:
    // Makes the folder where there is none. Fails with engine::Error when it cannot be used or
    // another process is using it.
    explicit RunFolder(std::filesystem::path path);
    RunFolder(const RunFolder&) = delete;
    RunFolder& operator=(const RunFolder&) = delete;
    ~RunFolder();

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path games() const { return path_ / "games"; }
    std::filesystem::path checkpoint() const { return path_ / "checkpoint.safetensors"; }
    std::filesystem::path old_checkpoint() const { return path_ / "checkpoint-old.safetensors"; }
    bool has_checkpoint() const {
        return std::filesystem::exists(checkpoint()) || std::filesystem::exists(old_checkpoint());
    }
    std::filesystem::path latest() const { return path_ / "latest.safetensors"; }
    std::filesystem::path candidate() const { return path_ / "candidate.safetensors"; }
    std::filesystem::path metrics() const { return path_ / "metrics.jsonl"; }
    std::filesystem::path ladder() const { return path_ / "ladder.jsonl"; }
    std::filesystem::path snapshots() const { return path_ / "snapshots"; }
    std::filesystem::path report() const { return path_ / "report.html"; }
    std::filesystem::path curve() const { return path_ / "ladder.svg"; }

    // As it was kept; zeros where nothing or nothing legible was.
    RunState state() const;
    void keep(const RunState& state) const;

   private:
    std::filesystem::path path_;
    int lock_ = -1;
};

}  // namespace selfplay::training
