#include "selfplay/records/import.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/base/error.h"
#include "engine/base/gzip.h"
#include "engine/chess/pgn.h"
#include "engine/go/sgf.h"
#include "engine/shogi/csa.h"
#include "engine/shogi/kif.h"
#include "selfplay/records/files_behind.h"

namespace selfplay::records {

namespace {

namespace fs = std::filesystem;
using engine::Move;
using engine::Outcome;

// That of the notation, whether packed or not.
std::string extension_of(const fs::path& path) {
    return path.extension() == ".gz" ? path.stem().extension().string() : path.extension().string();
}

bool is_text(const fs::path& path) {
    constexpr std::array<std::string_view, 6> known = {".pgn", ".csa", ".kif",
                                                       ".ki2", ".sgf", ".sgfs"};
    return std::ranges::find(known, extension_of(path)) != known.end();
}

template <engine::Game G>
Game record_of(const G& start, std::span<const Move> moves, Outcome outcome) {
    Game record;
    record.game = G::name;
    record.start = start.to_text();
    record.outcome = outcome;
    const float all = 1;
    G played = start;
    for (const Move move : moves) {
        record.add(move, 0, 0, {&move, 1}, {&all, 1});
        played.play(move);
    }
    const bool agreed = outcome == Outcome::draw;
    if (played.outcome() == Outcome::ongoing)
        record.ending = agreed ? Ending::agreed : Ending::resigned;
    return record;
}

class Import {
   public:
    explicit Import(const std::function<void(std::span<const Game>)>& take) : take_(take) {}

    void read(const fs::path& file) {
        const auto extension = extension_of(file);
        if (extension == ".pgn")
            read_pgn(file);
        else if (extension == ".sgf" || extension == ".sgfs")
            read_sgf(file);
        else
            read_shogi(file, extension == ".csa");
    }
    ImportCounts finish() {
        hand_on();
        return counts_;
    }

   private:
    void read_pgn(const fs::path& file) {
        const auto stream = chess::pgn::open(file);
        chess::pgn::Reader reader(*stream);
        while (try_to([&] {
            const auto record = reader.next();
            if (!record) return false;
            if (record->result == "*")
                ++counts_.unfinished;
            else
                keep(record_of(record->start, record->main_line(),
                               record->result == "1-0"   ? Outcome::first_wins
                               : record->result == "0-1" ? Outcome::second_wins
                                                         : Outcome::draw));
            return true;
        })) {
        }
    }

    void read_sgf(const fs::path& file) {
        const auto text = go::sgf::read_file(file);
        go::sgf::GameReader reader(text);
        while (try_to([&] {
            const auto tree = reader.next();
            if (!tree) return false;
            add(go::sgf::main_line(*tree));
            return true;
        })) {
        }
    }
    void add(const go::sgf::Record& record) {
        std::vector<Move> moves;
        for (const auto& turn : record.turns) moves.push_back(turn.move);
        const auto outcome = go::sgf::outcome_of(record);
        if (!go::sgf::is_even(record))
            ++counts_.uneven;
        else if (outcome != Outcome::ongoing)
            keep(record_of(record.start, moves, outcome));
        else
            ++counts_.unfinished;
    }

    void read_shogi(const fs::path& file, bool csa) {
        try_to([&] {
            const auto text = engine::read_plain_or_gzip(file);
            if (csa)
                for (const auto& record : shogi::csa::parse(text)) add(record);
            else
                add(shogi::kif::parse(text));
            return false;
        });
    }
    void add(const shogi::Record& record) {
        if (const auto outcome = record.outcome(); outcome == Outcome::ongoing)
            ++counts_.unfinished;
        else
            keep(record_of(record.start, record.main_line(), outcome));
    }

    // What it returns; true, and counted, when what was read is broken.
    template <class Read>
    bool try_to(Read read) {
        try {
            return read();
        } catch (const engine::Error&) {
            ++counts_.broken;
            return true;
        }
    }

    void keep(Game game) {
        constexpr std::size_t at_once = 1000;
        if (game.turns.empty()) {
            ++counts_.unfinished;
            return;
        }
        ++counts_.kept;
        games_.push_back(std::move(game));
        if (games_.size() == at_once) hand_on();
    }
    void hand_on() {
        if (!games_.empty()) take_(games_);
        games_.clear();
    }

    const std::function<void(std::span<const Game>)>& take_;
    ImportCounts counts_;
    std::vector<Game> games_;
};

}  // namespace

std::vector<fs::path> texts_behind(const fs::path& path) {
    if (!fs::is_directory(path)) return is_text(path) ? std::vector{path} : std::vector<fs::path>{};
    return files_behind<fs::recursive_directory_iterator>(
        std::span(&path, 1),
        [](const auto& entry) { return entry.is_regular_file() && is_text(entry.path()); });
}

ImportCounts import_games(std::span<const fs::path> files,
                          const std::function<void(std::span<const Game>)>& take) {
    Import import(take);
    for (const auto& file : files) import.read(file);
    return import.finish();
}

}  // namespace selfplay::records
