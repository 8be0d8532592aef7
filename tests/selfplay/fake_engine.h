// A scripted GTP engine for tests: a shell script in a temporary folder. As Black it fills the D
// file of a 9x9 board from below, as White the F file, one stone a move, and then passes; at its
// `at`th move it does what `mode` says. In the mode `exact` it knows KataGo's times and writes what
// it is told of them to the file `at`.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/temporary_folder.h"

namespace selfplay::testing {

inline constexpr std::string_view fake_engine_script = R"(#!/bin/bash
mode=$1 at=$2 moves=0
answer() { printf '= %s\n\n' "$1"; }
misbehave() {
    case $mode in
        crash) exit 3 ;;
        abort) kill -SEGV $$ ;;
        hang) sleep 100 ;;
        mute) exec >/dev/null; sleep 100 ;;
        illegal) answer D1 ;;
        nonsense) answer 'what?' ;;
        garbage) printf '\001\377 gibberish\n' ;;
        refuse) printf '? cannot\n\n' ;;
        endless) yes x | tr -d '\n' ;;
        resign) answer resign ;;
        slow) sleep 0.4; answer A9 ;;
        pass) answer PASS ;;
    esac
}
echo 'fake engine, at your service'
while read -r command first second; do
    case $command in
        list_commands) printf '= name\nlist_commands\nboardsize\nclear_board\nkomi\nplay\n'
                       [ "$mode" = exact ] && printf 'kata-time_settings\n'
                       printf 'genmove\nfinal_status_list\ntime_settings\ntime_left\nquit\n\n' ;;
        name) answer "fake-$mode" ;;
        clear_board) moves=0; answer ;;
        final_status_list) [ "$mode" = dead ] && answer "${at//,/ }" || answer ;;
        genmove)
            moves=$((moves + 1))
            if [ "$moves" = "$at" ]; then misbehave
            elif [ $moves -gt 9 ]; then answer pass
            elif [ "$first" = b ]; then answer D$moves
            else answer f$moves; fi ;;
        kata-time_settings|time_left) [ "$mode" = exact ] && echo "$command $first $second" >>"$at"
                       answer ;;
        quit) answer; exit ;;
        *) answer ;;
    esac
done
)";

class FakeEngine {
   public:
    FakeEngine() { std::ofstream(script()) << fake_engine_script; }
    // The command line of an engine that misbehaves at its `at`th move.
    std::string command(const std::string& mode = "play", const std::string& at = "0") const {
        return "bash '" + script().string() + "' " + mode + ' ' + at;
    }
    const std::filesystem::path& folder() const { return folder_.path(); }

   private:
    std::filesystem::path script() const { return folder_.path() / "fake engine.sh"; }
    tests::TemporaryFolder folder_;
};

}  // namespace selfplay::testing
