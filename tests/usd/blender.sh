#!/usr/bin/env bash
# The lights and materials of a USD scene give the light of the scan, by a renderer that is not relamp: blender.sh RELAMP
# BLENDER SAMPLES
set -euo pipefail
readonly relamp=$1 blender=$2 room=$3/bedroom
here=$(cd "$(dirname "$0")" && pwd)
cd "$(mktemp -d)"
trap 'rm -rf "$PWD"' EXIT
"$relamp" delight "$room/scan.glb" --usd -o out -q
"$relamp" relight out --show scan --camera "$room/camera.json" --size 80x45 -o scan.exr -q
PYTHONDONTWRITEBYTECODE=1 "$blender" --background --factory-startup --python-exit-code 1 -P "$here/render_in_blender.py" -- \
    out/scan.usda "$room/camera.json" "$PWD/scan.exr" 64 >log 2>&1 || { cat log; exit 1; }
grep RESULT log
