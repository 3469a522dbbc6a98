#!/usr/bin/env bash
# The Debian package holds the program, the library and the headers, and names the libraries that they load.
set -euo pipefail
readonly build=$1
readonly work=$build/tests/install/deb
rm -rf "$work"
cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work"
readonly deb=$(echo "$work"/relamp_*.deb)

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
contents=$(dpkg-deb --contents "$deb")
for file in bin/relamp bin/relamp-view librelamp.so. librelamp_formats.so include/relamp/scan.h relampConfig.cmake \
    man/man1/relamp.1 man/man1/relamp-delight.1 bash-completion/completions/relamp zsh/vendor-completions/_relamp \
    fish/vendor_completions.d/relamp.fish python3/dist-packages/relamp/_relamp. python3/dist-packages/relamp/__init__.py \
    share/relamp/blender/relamp_addon/__init__.py share/relamp/blender/relamp-; do
    expect "$file" "$contents"
done
exit $missing
