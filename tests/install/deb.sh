#!/usr/bin/env bash
# The Debian packages hold the program, the library and the headers, and the Python module; they name what they load.
set -euo pipefail
readonly build=$1
readonly work=$build/tests/install/deb
rm -rf "$work"
cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work"
readonly deb=$(echo "$work"/relamp_*.deb) module=$(echo "$work"/python3-relamp_*.deb)

missing=0
expect() { # what, where
    grep --quiet --fixed-strings -- "$1" <<<"$2" && return
    echo "the package lacks $1"
    missing=1
}

depends=$(dpkg-deb --field "$deb" Depends)
echo "Depends: $depends"
for library in libassimp5 libdraco7 libembree3-3 libfmt9 libopenexr-3-1-30 libopenimageio2.4 libtbb12 libstdc++6; do
    expect "$library " "$depends "
done
[[ $depends != *python3* ]] || { echo 'the program does not need Python' && missing=1; }
contents=$(dpkg-deb --contents "$deb")
for file in bin/relamp bin/relamp-view librelamp.so. librelamp_formats.so include/relamp/scan.h relampConfig.cmake \
    man/man1/relamp.1 man/man1/relamp-delight.1 bash-completion/completions/relamp zsh/vendor-completions/_relamp \
    fish/vendor_completions.d/relamp.fish share/relamp/blender/relamp_addon/__init__.py share/relamp/blender/relamp- \
    share/relamp/workflow/Snakefile share/relamp/config/config.yaml; do
    expect "$file" "$contents"
done

depends=$(dpkg-deb --field "$module" Depends)
echo "Depends: $depends"
for package in "relamp (= " "python3 (>= 3." "python3 (<< 3." python3-numpy; do expect "$package" "$depends"; done
contents=$(dpkg-deb --contents "$module")
for file in relamp/_relamp.cpython relamp/__init__.py relamp/py.typed; do
    expect "python3/dist-packages/$file" "$contents"
done
[[ $contents != */bin/* ]] || { echo 'python3-relamp holds the program too' && missing=1; }
exit $missing
