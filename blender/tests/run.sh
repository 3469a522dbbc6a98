#!/usr/bin/env bash
# Runs a test module of this folder inside Blender, with the add-on installed from its archive as people do it.
#
#   run.sh ARCHIVE RELAMP MODULE     77, and a sentence, where there is no Blender
set -euo pipefail
if ! command -v blender >/dev/null; then
    echo "there is no Blender on this machine, so nothing was tested; apt-get install blender"
    exit 77
fi
scripts=$(mktemp -d)
trap 'rm -rf "$scripts"' EXIT
mkdir "$scripts/bin"
ln -s "$2" "$scripts/bin/relamp"
here=$(dirname "$(readlink -f "$0")")
PATH=$scripts/bin:$PATH BLENDER_USER_SCRIPTS=$scripts PYTHONDONTWRITEBYTECODE=1 \
    blender --background --factory-startup --threads "${BLENDER_THREADS:-1}" --python-exit-code 1 -P "$here/run.py" -- "$1" "$3"
