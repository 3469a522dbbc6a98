#!/usr/bin/env bash
# clang-tidy has nothing to say about src, apps and what relamp bench measures; .clang-tidy names what it looks at.
set -euo pipefail
readonly commands=$1/tests/lint
mkdir -p "$commands"
# clang cannot read what g++ has precompiled. Sources that are compiled as one have no command of their own:
# clang-tidy takes that of a neighbour.
sed 's/ -Winvalid-pch -include [^ ]*//' "$1/compile_commands.json" >"$commands/compile_commands.json"
find src apps bench/stage_times.cpp -name '*.cpp' ! -name '*_test.cpp' ! -name tinygltf.cpp | sort |
    xargs --delimiter='\n' --max-procs=2 --max-args=4 clang-tidy -p "$commands" --quiet --warnings-as-errors='*'
