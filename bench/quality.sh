#!/bin/bash
# Scores both solvers in rooms of known albedo and prints the tables of docs/guide/quality.md.
#
#   bench/quality.sh ROOMS METRICS [RELAMP]
#
# ROOMS holds bedroom, living and office; METRICS is their metrics.py; RELAMP is the program, by default that of
# build/release. Results stay in build/quality.
set -euo pipefail
if [ $# -lt 2 ]; then
    sed -n '2,/^set/{/^set/!p}' "$0" | cut -c3-
    exit 2
fi
rooms=$1
metrics=$2
repository=$(cd "$(dirname "$0")/.." && pwd)
relamp=${3:-$repository/build/release/apps/cli/relamp}
results=$repository/build/quality
figures='psnr_rgb_unclipped psnr_unclipped leak_slope logchroma ssim relit_A_albedo relit_B_albedo scale'

# Reads lines of JSON, prints a row of the table of the one that is called $2; $1 begins the row.
row() {
    /usr/bin/python3 -c '
import json, sys
start, name, figures = sys.argv[1], sys.argv[2], sys.argv[3].split()
digits = {"leak_slope": 3, "logchroma": 3, "ssim": 3}
for line in sys.stdin:
    score = json.loads(line)
    if score["name"] != name:
        continue
    print(f"| {start} | {name} |", " | ".join(f"{score[f]:.{digits.get(f, 2)}f}" for f in figures), "|")
' "$1" "$2" "$figures"
}

table() { # kind, folder under the room, scan
    printf '\n## %s\n\n| room | |' "$1"
    printf ' `%s` |' $figures
    printf '\n| --- | --- |'
    printf ' ---: |%.0s' $figures
    printf '\n'
    for room in bedroom living office; do
        local folder=$rooms/$room$2
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
