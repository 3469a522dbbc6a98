#!/bin/bash
# Scores both solvers in rooms of known albedo and prints tables as those of docs/guide/quality.md.
#
#   bench/quality.sh ROOMS METRICS [RELAMP [RESULTS]]
#
# ROOMS holds a folder a room, as relamp_rooms writes them (docs/dev/rooms.md); METRICS is metrics.py, which reads them;
# RELAMP is the program, by default that of build/release. Results stay in RESULTS, by default build/quality. The last table, of
# what the answer must not depend on (bench/invariance.py), takes five times as long as the others; the exit status is its own.
set -euo pipefail
if [ $# -lt 2 ]; then
    sed -n '2,/^set/{/^set/!p}' "$0" | cut -c3-
    exit 2
fi
rooms=$1
metrics=$2
repository=$(cd "$(dirname "$0")/.." && pwd)
relamp=${3:-$repository/build/release/apps/cli/relamp}
results=${4:-$repository/build/quality}
figures='psnr_rgb_unclipped psnr_unclipped leak_slope logchroma ssim relit_A_albedo relit_B_albedo scale'

# Reads lines of JSON, prints a row of the table of the one that is called $2; $1 begins the row. A room need not be relit.
row() {
    /usr/bin/python3 -c '
import json, sys
start, name, figures = sys.argv[1], sys.argv[2], sys.argv[3].split()
digits = {"leak_slope": 3, "logchroma": 3, "ssim": 3}
for line in sys.stdin:
    score = json.loads(line)
    if score["name"] != name:
        continue
    shown = [f"{score[f]:.{digits.get(f, 2)}f}" if f in score else "-" for f in figures]
    print(f"| {start} | {name} |", " | ".join(shown), "|")
' "$1" "$2" "$figures"
}

table() { # kind, folder under the room, scan
    printf '\n## %s\n\n| room | |' "$1"
    printf ' `%s` |' $figures
    printf '\n| --- | --- |'
    printf ' ---: |%.0s' $figures
    printf '\n'
    for folder in "$rooms"/*"$2"; do
        [ -e "$folder/$3" ] || continue
        local room=${folder#"$rooms"/}
        room=${room%"$2"}
        /usr/bin/python3 "$metrics" "$folder" --baselines | row "$room" input
        for solver in thesis gather; do
            local result=$results/$1/$room/$solver
            mkdir -p "$(dirname "$result")"
            "$relamp" delight "$folder/$3" -o "$result" --solver $solver -q >/dev/null
            /usr/bin/python3 "$metrics" "$folder" --name $solver --albedo "$result/albedo.exr" | row '' $solver
        done
    done
}

table Clean '' scan.glb
table Reconstructed /recon scan_recon.glb
printf '\n## Invariance\n\n'
"$repository/bench/invariance.py" "$rooms" "$relamp" "$results/Invariance"
