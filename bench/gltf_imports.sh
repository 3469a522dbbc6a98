#!/bin/bash
# Shows what other programs make of relamp's GLB and USD: imports the GLB into Blender and three.js, and the USD into
# three.js (Debian's Blender has no USD), as their users do and with their defaults, and puts the pictures beside the
# scan's. Takes minutes: Cycles has no denoiser in Debian.
#
#   bench/gltf_imports.sh [SAMPLES [RELAMP]]
#
# SAMPLES of a pixel are for Cycles, 32 if nothing is said; RELAMP is the program, by default that of build/release.
# Needs Debian's packages blender, chromium, imagemagick, npm and python3. The pictures stay in build/imports.
set -euo pipefail
if [ $# -gt 2 ] || [ "${1:-}" = --help ]; then
    sed -n '2,/^set/{/^set/!p}' "$0" | cut -c3-
    exit 2
fi
fail() {
    echo "gltf_imports.sh: $1" >&2
    exit 1
}
repository=$(cd "$(dirname "$0")/.." && pwd)
samples=${1:-32}
relamp=${2:-$repository/build/release/apps/cli/relamp}
room=$repository/samples/bedroom
results=$repository/build/imports
for program in blender chromium montage npm python3; do
    command -v $program >/dev/null || fail "$program is missing; install it with apt-get"
done
[ -x "$relamp" ] || fail "$relamp is no program; build it with ./relamp.sh build, or name it as second argument"

mkdir -p "$results"
cd "$results"
rm -f ./*.png
"$relamp" delight "$room/scan.glb" -o room --usd -q
"$relamp" relight room --show scan --camera "$room/camera.json" --size 800x450 -o scan.png -q

npm install --silent --no-audit --no-fund three@0.187.0
cp "$repository/bench/import_in_three.html" "$room/camera.json" .
cp room/scan.glb room.glb
python3 "$repository/bench/import_in_three.py" chromium room.glb three.png || fail "three.js showed nothing"
python3 "$repository/bench/import_in_three.py" chromium room/scan.usda usd.png || fail "three.js showed nothing of the USD"

blender -b --factory-startup --python-exit-code 1 -P "$repository/bench/import_in_blender.py" -- \
    room.glb camera.json "$results/blender.png" "$samples" >blender.log || fail "Blender stopped; see $results/blender.log"

montage scan.png three.png usd.png blender.png -tile 2x2 -geometry 480x270+2+2 imports.png
echo "$results/imports.png: the scan; its GLB in three.js; its USD in three.js; its GLB in Blender"
