#!/bin/bash
# Races relamp against Blender's Cycles: the irradiance of one room, to the same error, on the same cores, in one run.
# Prints the tables of docs/guide/performance.md. Takes ten minutes and more; let nothing else run meanwhile.
#
#   bench/cycles.sh [SCAN [RELAMP]]
#
# SCAN is a GLB with one mesh and one page, by default the sample room; RELAMP is the program, by default that of
# build/release. Needs Debian's package blender. relamp's result and Blender's log stay in build/cycles.
set -euo pipefail
if [ $# -gt 2 ] || [ "${1:-}" = --help ]; then
    sed -n '2,/^set/{/^set/!p}' "$0" | cut -c3-
    exit 2
fi
fail() {
    echo "cycles.sh: $1" >&2
    exit 1
}
repository=$(cd "$(dirname "$0")/.." && pwd)
scan=${1:-$repository/samples/bedroom/scan.glb}
relamp=${2:-$repository/build/release/apps/cli/relamp}
results=$repository/build/cycles
command -v blender >/dev/null || fail "Blender is missing; install it with: apt-get install blender"
[ -x "$relamp" ] || fail "$relamp is no program; build it with ./relamp.sh build, or name it as second argument"
[ -f "$scan" ] || fail "$scan is no file"

mkdir -p "$results"
rm -f "$results/table.md"
blender -b --factory-startup --python-exit-code 1 --python "$repository/bench/cycles_bake.py" -- \
    "$scan" "$relamp" "$results" "$(nproc)" "$(date +%s.%N)" >"$results/log" 2>&1 && [ -f "$results/table.md" ] || {
    tail -n 5 "$results/log" >&2
    fail "Blender stopped; all it said is in $results/log"
}
cat "$results/table.md"
