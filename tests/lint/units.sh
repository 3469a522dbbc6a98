#!/usr/bin/env bash
# The sources of a folder are compiled as one (cmake/headers.cmake): a constant of one source that has the name of a
# header's would be taken for that in the next, without a word.
set -euo pipefail
constants() { grep -hoP '^(inline )?constexpr [^=({]*\Kk[A-Z]\w*(?=( = |\(|\{))' "$@" | sort -u; }
found=$(comm -12 <(constants $(find src tests -name '*.h')) <(constants $(find src tests -name '*.cpp')))
[[ -z $found ]] || { echo "a source has a constant that is called as one of a header: $found" && exit 1; }
