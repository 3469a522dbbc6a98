#!/usr/bin/env bash
# Constants of what decides which surfaces shine, whether the sun does, what lies in shade and what the geometry misses, and, counted
# apart, of what a camera did to that light. Prints
# each with its value and what its comment says; a constant without a comment, trailing or in the line above, stands for nothing that a
# reader knows. Units of surfels or texels are none: they change with the texture's resolution.
#
# What stands under a comment "Numerics" decides nothing: samples, steps and sizes for time and precision; it is printed apart and not
# limited. It ends with an empty line.
#
# Each count may fall and not rise; lower the limit when it has.
set -euo pipefail
readonly mostOfLight=59
readonly mostOfCamera=18
readonly mostWithoutWord=0
readonly mostOfGrid=1 # to be 0

find src/fit src/lights/candidates.{h,cpp} -type f \( -name '*.cpp' -o -name '*.h' \) \
    ! -name '*_test.*' | LC_ALL=C sort | xargs awk -v light="$mostOfLight" -v camera="$mostOfCamera" -v wordless="$mostWithoutWord" -v grid="$mostOfGrid" '
    function flush(    value, said) {
        if (line == "") return
        match(line, /k[A-Z][A-Za-z0-9]*/)
        name = substr(line, RSTART, RLENGTH)
        said = line ~ /\/\// ? line : above
        sub(/^[^\/]*\/\/ */, "", said)
        value = line
        sub(/ *\/\/.*/, "", value)
        sub(/^[^=]*= */, "", value)
        sub(/;.*/, "", value)
        isCamera = file ~ /camera_|white_balance/
        ++counts[numerics ? "numerics" : isCamera ? "camera" : "light"]
        mark = numerics ? "  (numerics)" : ""
        if (said == "") { ++counts["wordless"]; mark = "  <- says nothing" }
        if (said ~ /[Ss]urfel|[Tt]exel/) { ++counts["grid"]; mark = "  <- of the grid" }
        printf "%-32s %-28s %-16s %s%s\n", file, name, value, said, mark
        line = ""
    }
    FNR == 1 { above = ""; numerics = 0 }
    /^ *$/ { numerics = 0 }
    /^ *\/\/ Numerics/ { numerics = 1 }
    line != "" { sub(/^ */, " "); line = line $0; if (/;/) flush(); next } # went on
    /^ *((static|inline) )*constexpr [^(]*k[A-Z][A-Za-z0-9]*(\[[^]]*\])? *=/ {
        line = $0
        file = FILENAME
        sub(/^src\//, "", file)
        if (/;/) flush()
        next
    }
    { above = /^ *\/\// ? $0 : "" }
    END {
        printf "\n%d constants of the light (at most %d), %d of the camera (%d); %d without a word (%d), %d in units of surfels or texels (%d); %d of numerics\n",
            counts["light"], light, counts["camera"], camera, counts["wordless"], wordless, counts["grid"], grid, counts["numerics"]
        exit counts["light"] > light || counts["camera"] > camera || counts["wordless"] > wordless || counts["grid"] > grid
    }'
