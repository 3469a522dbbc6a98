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
# What OpenImageIO reads: the program loads a library of its own for it, from where it was installed.
(printf '\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\30\0' && printf 'BGRBGRBGRBGR') >"$work/four.tga"
printf 'newmtl paint\nmap_Kd four.tga\n' >"$work/textured.mtl"
cat >"$work/textured.obj" <<'END'
mtllib textured.mtl
v 0 0 0
v 1 0 0
v 0 1 0
vt 0 0
vt 1 0
vt 0 1
usemtl paint
f 1/1 2/2 3/3
END
"$prefix/bin/relamp" info "$work/textured.obj"

cmake -S "$here/consumer" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$prefix"
cmake --build "$work/consumer"
triangles=$("$work/consumer/consumer" "$scan")
[[ $triangles == 2 ]] || {
    echo "the consumer counts $triangles triangles, not 2"
    exit 1
}

# The module finds the library by the way from where it was installed.
PYTHONPATH=$prefix/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c '
import sys, relamp
assert relamp.__file__.startswith(sys.argv[1]), relamp.__file__
assert relamp.read_scan(sys.argv[2]).triangle_count == 2' "$prefix" "$scan"

# What README shows is a program that builds as it stands, says what is wrong, and does what it is for.
readonly readme=$work/readme
mkdir "$readme"
block() { awk -v fence="\`\`\`$1" '$0 == fence { inside = 1; next } /^```/ { inside = 0 } inside' "$source/README.md"; }
block cpp >"$readme/main.cpp"
block cmake >"$readme/CMakeLists.txt"
cmake -S "$readme" -B "$readme/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix"
cmake --build "$readme/build"

cd "$readme"
said=$(build/mine 2>&1) && status=0 || status=$?
[[ $status == 1 && $said == "kitchen.glb: no such file" ]] || {
    echo "without a scan README's program ends with $status and says: $said"
    exit 1
}
cp "$source/samples/bedroom/scan.glb" kitchen.glb
build/mine
[[ -s kitchen/kitchen.glb && -s kitchen/report.json ]] || {
    echo "README's program wrote no room"
    exit 1
}
