#!/usr/bin/env bash
# clang-tidy has nothing to say about src and apps; .clang-tidy names what it looks at.
set -euo pipefail
readonly build=$1
sed -n 's/^ *"file": "\(.*\)",*$/\1/p' "$build/compile_commands.json" |
    grep -E '/(src|apps)/' | grep -vE '_test\.cpp$|/tinygltf\.cpp$' | sort -u |
    xargs --delimiter='\n' --max-procs=2 --max-args=4 clang-tidy -p "$build" --quiet --warnings-as-errors='*'
