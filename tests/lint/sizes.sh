#!/usr/bin/env bash
# No file is longer than 600 lines, and none puts anything off.
set -euo pipefail
readonly later='TO''DO|FIX''ME|XX''X'
found=$(
    find CMakeLists.txt relamp.sh cmake include src apps tests bench -type f ! -name '*.glb' ! -name package-lock.json -exec wc -l {} \; |
        awk '$1 > 600 { print $2 ": " $1 " lines, more than 600" }'
    grep -rnIwE "$later" CMakeLists.txt relamp.sh cmake include src apps tests bench || true
)
[[ -z $found ]] || { echo "$found" && exit 1; }
