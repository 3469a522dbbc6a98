#!/usr/bin/env bash
# Runs a test module of this folder inside Blender, with the add-on installed from its archive as people do it.
#
#   run.sh ARCHIVE RELAMP MODULE     77, and a sentence, where there is no Blender
#
# The module test_window wants a window, which Xvfb gives it.
set -euo pipefail
module=$3
blender=(blender --factory-startup --threads 1 --python-exit-code 1)
if [[ $module == test_window ]]; then
    blender=(xvfb-run --auto-servernum --server-args '-screen 0 800x600x24' "${blender[@]}"
        --enable-event-simulate --window-geometry 0 0 800 600)
else
    blender+=(--background)
fi
for program in "${blender[0]}" blender; do
    if ! command -v "$program" >/dev/null; then
        echo "there is no $program on this machine, so nothing was tested; apt-get install blender xvfb"
        exit 77
    fi
done
scripts=$(mktemp -d)
trap 'rm -rf "$scripts"' EXIT
mkdir "$scripts/bin"
ln -s "$2" "$scripts/bin/relamp"
here=$(dirname "$(readlink -f "$0")")
PATH=$scripts/bin:$PATH BLENDER_USER_SCRIPTS=$scripts PYTHONDONTWRITEBYTECODE=1 \
    "${blender[@]}" -P "$here/run.py" -- "$1" "$module"
