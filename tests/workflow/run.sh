#!/usr/bin/env bash
# Runs the tests of this folder; 77, and a sentence, where there is no Snakemake.
set -euo pipefail
RELAMP_SNAKEMAKE=$(command -v snakemake) || {
    echo "there is no snakemake on this machine, so nothing was tested; apt-get install snakemake"
    exit 77
}
export RELAMP_SNAKEMAKE
exec /usr/bin/python3 -m unittest discover -s "$(dirname "$(readlink -f "$0")")" -p "*_test.py"
