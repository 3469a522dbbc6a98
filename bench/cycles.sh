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
. "$(dirname "$0")/blender.sh"
scan=${1:-$repository/samples/bedroom/scan.glb}
relamp=${2:-$repository/build/release/apps/cli/relamp}
results=$repository/build/cycles
check_inputs "$relamp" "$scan"

mkdir -p "$results"
rm -f "$results/table.md"
in_blender "$results/log" cycles_bake.py "$scan" "$relamp" "$results" "$(nproc)" "$(date +%s.%N)"
[ -f "$results/table.md" ] || fail "Blender wrote no table; all it said is in $results/log"
cat "$results/table.md"
