#!/usr/bin/env bash
# What the program says goes through printOut and printProblem, which keep a terminal from obeying the names of a file;
# JSON and help, and these alone, through printExactly.
set -euo pipefail
found=$(
    grep -nE 'fmt::print|\b(printf|fprintf|puts|fputs|putchar)\(|std::(cout|cerr)' apps/cli/*.cpp apps/cli/*.h |
        grep -v '^apps/cli/terminal[.]' | sed 's/$/: say it with printOut or printProblem/' || true
    grep -n 'printExactly' apps/cli/*.cpp | grep -v '^apps/cli/terminal[.]' |
        grep -vE 'asJson|report|help' | sed 's/$/: printExactly is for JSON and help/' || true
)
[[ -z $found ]] || { echo "$found" && exit 1; }
