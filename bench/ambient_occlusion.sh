#!/bin/bash
# Compares relamp's albedo with the usual way to take light out by hand: the texture divided by baked ambient occlusion.
# Prints a table as in docs/guide/performance.md. Takes four minutes and more a room; let nothing else run meanwhile.
#
#   bench/ambient_occlusion.sh ROOM METRICS [RELAMP]
#
# ROOM is a folder as relamp_rooms writes them (docs/dev/rooms.md), its recon, or samples/bedroom; METRICS is metrics.py, which reads
# it; RELAMP is the program, by default that of build/release. Needs Debian's package blender. What is compared stays in
# build/ambient_occlusion.
set -euo pipefail
if [ $# -lt 2 ] || [ $# -gt 3 ]; then
    sed -n '2,/^set/{/^set/!p}' "$0" | cut -c3-
    exit 2
fi
. "$(dirname "$0")/blender.sh"
room=$1
metrics=$2
relamp=${3:-$repository/build/release/apps/cli/relamp}
results=$repository/build/ambient_occlusion
scan=$room/scan.glb
[ -f "$scan" ] || scan=$room/scan_recon.glb
check_inputs "$relamp" "$scan"

rm -rf "$results"
mkdir -p "$results"
in_blender "$results/log" ambient_occlusion.py "$scan" "$results" "$(nproc)"
start=$(date +%s.%N)
"$relamp" delight "$scan" -o "$results/relamp" -q
printf '%s\trelamp delight\t%s\n' "$results/relamp/albedo.exr" "$(awk "BEGIN {printf \"%.1f\", $(date +%s.%N) - $start}")" \
    >>"$results/divided"

echo '| albedo | s | `psnr_rgb` | `psnr_rgb_unclipped` | `leak_slope` |'
echo '| --- | ---: | ---: | ---: | ---: |'
score() {
    /usr/bin/python3 "$metrics" "$room" "$@" | /usr/bin/python3 -c '
import json, sys
name, seconds = sys.argv[1:]
for line in sys.stdin:
    score = json.loads(line)
    if score["name"] in ("input", "estimate"):
        figures = [score[f] for f in ("psnr_rgb", "psnr_rgb_unclipped", "leak_slope")]
        print("| {} | {} | {:.2f} | {:.2f} | {:.3f} |".format(name, seconds, *figures))
' "$name" "$seconds"
}
name='the texture itself' seconds='' score --baselines
while IFS=$'\t' read -r file name seconds; do
    score --albedo "$file"
done <"$results/divided"
