# Sourced by ./run, ./test and .ci/run, from the top of the checkout: installs what is missing and builds.

build_packages=(g++ cmake ninja-build libfmt-dev libspdlog-dev libcli11-dev nlohmann-json3-dev zlib1g-dev
    libeigen3-dev libdnnl-dev protobuf-compiler libprotobuf-dev libzstd-dev libminizip-dev)
test_packages=(libgtest-dev gnugo python3-numpy)
check_packages=(clang-14 clang-format-14 clang-tidy-14 libclang-rt-14-dev)

# Debian keeps opponents there, and root has it not in its path.
PATH=$PATH:/usr/games

say() { echo "$*" >&2; }

missing_packages() {
    # One call for all: dpkg-query costs more to start than to ask.
    local installed
    installed=$(dpkg-query -W -f '${db:Status-Abbrev}${Package}\n' "$@" 2>/dev/null | sed -n 's/^ii //p')
    local name
    for name in "$@"; do
        grep -qx -- "$name" <<<"$installed" || echo "$name"
    done
}

install_packages() {
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        say "No apt-get here. If the build fails, install what Debian calls: $*"
        return 0
    fi
    local missing as_root=()
    mapfile -t missing < <(missing_packages "$@")
    [ ${#missing[@]} -eq 0 ] && return 0
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            say "Not root and no sudo. If the build fails, install: ${missing[*]}"
            return 0
        fi
        as_root=(sudo)
    fi
    say "Installing ${missing[*]}"
    {
        "${as_root[@]}" apt-get update -q &&
            "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
                apt-get install -q -y --no-install-recommends "${missing[@]}"
    } >&2 || say "apt-get failed; going on with what is here"
}

# configure PRESET [CMAKE ARGUMENTS]: quiet unless it fails.
configure() {
    local log
    if ! log=$(cmake --preset "$@" 2>&1); then
        say "$log"
        return 1
    fi
}

# build PRESET TARGET...: progress on a terminal, elsewhere quiet unless it fails.
build() {
    local folder=build/$1 log
    shift
    if [ -t 2 ]; then
        cmake --build "$folder" --target "$@" >&2
    else
        log=$(cmake --build "$folder" --target "$@" 2>&1) || {
            say "$log"
            return 1
        }
    fi
}
