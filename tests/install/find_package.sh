#!/usr/bin/env bash
# A program of somebody else finds relamp in the prefix that it was installed into, and reads a scan with it.
set -euo pipefail
readonly build=$1 source=$2
readonly here=$source/tests/install work=$build/tests/install/find_package
readonly prefix=$work/prefix scan=$work/square.obj
rm -rf "$work"
mkdir -p "$work"

cmake --install "$build" --prefix "$prefix"
"$prefix/bin/relamp" --version

# Two triangles with the colour at their corners.
cat >"$scan" <<'END'
v 0 0 0 1 0 0
v 1 0 0 0 1 0
v 1 1 0 0 0 1
v 0 1 0 1 1 1
f 1 2 3
f 1 3 4
END
cmake -S "$here/consumer" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$prefix"
cmake --build "$work/consumer"
triangles=$("$work/consumer/consumer" "$scan")
[[ $triangles == 2 ]] || {
    echo "the consumer counts $triangles triangles, not 2"
    exit 1
}
