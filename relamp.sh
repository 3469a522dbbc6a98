#!/usr/bin/env bash
# Installs what the machine lacks, builds what has changed, runs. `./relamp.sh help` says how.
set -euo pipefail

root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
build=$root/build

usage() {
    cat <<'END'
./relamp.sh delight SCAN -o FOLDER   take the light out of a scan; any command of relamp goes here
./relamp.sh build                    build everything in Release: build/release
./relamp.sh test [CTEST OPTION ...]  build and run every test, some of them under sanitizers
./relamp.sh help                     this; `./relamp.sh delight --help` tells of a command

Missing Debian packages (packages.txt) are installed first, as root or by sudo.
END
}

say() { printf 'relamp.sh: %s\n' "$*" >&2; }

die() {
    say "$@"
    exit 1
}

# Runs a command whose words matter only when it fails.
quietly() {
    "$@" >"$build/log" 2>&1 </dev/null && return
    cat "$build/log" >&2
    die "this failed: $*"
}

# The lines of packages.txt that a build folder needs: all for asan, else those above [test].
packages_for() {
    local -r until=$([[ $1 == asan ]] || echo '/^# \[test\]/,$d;')
    sed "$until s/ *#.*//; /^\$/d" "$root/packages.txt" | sort -u
}

install_packages_for() {
    local -a missing as_root=()
    mapfile -t missing < <(comm -23 <(packages_for "$1") \
        <(dpkg-query --show --showformat='${db:Status-Abbrev}${Package}, ${Provides}\n' |
            sed -n 's/^ii *//p' | sed 's/ ([^)]*)//g; s/, */\n/g' | sort -u)) # npm may be in another's nodejs
    ((${#missing[@]})) || return 0
    if ((EUID != 0)); then
        command -v sudo >/dev/null || die "as root, please: apt-get install ${missing[*]}"
        as_root=(sudo)
    fi
    say "installing ${missing[*]}"
    # Where the update fails for some other source of the machine, the install may still be possible.
    # shellcheck disable=SC2016
    quietly "${as_root[@]}" sh -c 'apt-get update
        DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 \
            install --yes --no-install-recommends "$@"' sh "${missing[@]}"
}

# Brings the build folder and its targets up to date; says nothing where they are.
build() {
    local -r folder=$build/$1 preset=${1/release/ci}
    if [[ ! ($folder/ready -nt $root/packages.txt && $folder/ready -nt $root/CMakePresets.json) ]]; then
        install_packages_for "$1"
        say "configuring $folder"
        quietly cmake -S "$root" --preset "$preset"
        touch "$folder/ready"
    fi
    [[ $(ninja -C "$folder" -n "${@:2}" 2>/dev/null) == *'no work to do.' ]] && return
    say "building in $folder; the first time takes minutes"
    if [[ -t 2 ]]; then
        ninja -C "$folder" "${@:2}" >&2
    else
        ninja -C "$folder" --quiet "${@:2}" >&2
    fi
}

# One build at a time; the lock ends with this process, or where the program takes its place.
begin() {
    mkdir -p "$build"
    exec 9>"$build/lock"
    flock --nonblock 9 && return
    say "waiting for another ./relamp.sh to build"
    flock 9
}

case ${1-help} in
    help | -h | --help) usage ;;
    build)
        begin
        build release
        ;;
    test)
        begin
        install_packages_for asan # of which the release build needs some for its tests
        build release
        build asan
        echo 'subdirs(release asan)' >"$build/CTestTestfile.cmake"
        exec ctest --test-dir "$build" -j2 --output-on-failure "${@:2}" 9>&-
        ;;
    *)
        begin
        targets=(relamp_cli)
        [[ $1 == view ]] && targets+=(relamp_view)
        [[ $1 == page ]] && targets+=(relamp_page)
        build release "${targets[@]}"
        exec "$build/release/apps/cli/relamp" "$@" 9>&-
        ;;
esac
