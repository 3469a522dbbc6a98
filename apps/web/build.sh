#!/usr/bin/env bash
# build.sh SOURCE FOLDER: makes what a page runs in the browser, FOLDER/page. Where there is no Node.js, or npm cannot bring
# what that needs, it says so and all else is built: nothing but `relamp page` misses it.
set -euo pipefail
readonly source=$1 folder=$2

say() { printf 'relamp page: %s\n' "$*" >&2; }

# Brings node_modules to what package-lock.json says.
install() {
    cmp --quiet "$source/package-lock.json" node_modules/installed && return
    cp "$source/package.json" "$source/package-lock.json" .
    npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 --fetch-timeout=60000 >npm.log 2>&1 || return
    cp package-lock.json node_modules/installed
}

bundle() { # SOURCE TARGET OPTION ...
    NODE_PATH=$folder/node_modules node node_modules/esbuild/bin/esbuild "$source/$1" --bundle --outfile="$2" \
        --target=es2020 --legal-comments=none --loader:.h=text --log-level=warning "${@:3}"
}

if ! { command -v node && command -v npm; } >/dev/null; then
    say "not made, as it needs Node.js and npm; install them and build again"
    exit 0
fi
mkdir -p "$folder"
cd "$folder"
if ! install; then
    say "not made, as npm did not bring its libraries ($folder/npm.log); build again when it can"
    exit 0
fi
rm -rf staged
mkdir staged
bundle src/main.ts staged/viewer.js --format=iife --minify
bundle test/formulas_probe.ts formulas_probe.js --format=iife
bundle test/unit_test.ts unit_test.mjs --format=esm --platform=node
cp "$source/eslint.config.mjs" .
cp "$source/index.html" "$source/viewer.css" "$source/relamp-room.js" staged
{
    echo "The viewer of this page is relamp's, under the Apache License 2.0. It contains these libraries."
    for library in three:LICENSE meshoptimizer:LICENSE.md; do
        printf '\n%s\n\n' "${library%%:*}"
        cat "node_modules/${library/:/\/}"
    done
} >staged/licences.txt
rm -rf page
mv staged page
touch made
