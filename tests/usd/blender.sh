#!/usr/bin/env bash
# The lights and materials of a USD scene give the light of the scan, by a renderer that is not relamp.
#
#   blender.sh RELAMP SAMPLES     77, and a sentence, where there is no Blender
set -euo pipefail
readonly relamp=$1 room=$2/bedroom
if ! command -v blender >/dev/null; then
    echo "there is no blender on this machine, so nothing was tested; apt-get install blender"
    exit 77
fi
here=$(cd "$(dirname "$0")" && pwd)
cd "$(mktemp -d)"
trap 'rm -rf "$PWD"' EXIT
"$relamp" delight "$room/scan.glb" --usd -o out -q
"$relamp" relight out --show scan --camera "$room/camera.json" --size 80x45 -o scan.exr -q
PYTHONDONTWRITEBYTECODE=1 blender --background --factory-startup --python-exit-code 1 -P "$here/render_in_blender.py" -- \
    out/scan.usda "$room/camera.json" "$PWD/scan.exr" 64 >log 2>&1 || { cat log; exit 1; }
grep RESULT log
