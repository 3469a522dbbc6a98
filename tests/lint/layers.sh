#!/usr/bin/env bash
# A file in src includes its own layer and those before it. Apps see the public headers, those of src/inside and
# bench/stage_times.h alone, but for the viewer, which draws by way of src/gpu; Python sees the public ones. A public header names no type of the
# libraries that relamp works with.
set -euo pipefail

readonly layers='inside base gpu image scan lights shading fit albedo solve thesis decomposition_state.h relight output
                 delight.cpp delighter.cpp verify.cpp'

includes() { grep -rnE '^ *# *include' --include='*.'{h,cpp,comp} "$@" || true; }

found=$(
    includes src | awk -F: -v layers="$layers" '
        # "shading/gather.h" lies in layer shading, "delight_test.cpp" in delight.cpp
        function layerOf(path) { sub("/.*", "", path); sub("_test", "", path); return path }

        BEGIN { for (n = split(layers, order, /[ \n]+/); n > 0; --n) height[order[n]] = n }
        split($3, quoted, "\"") < 3 || quoted[2] ~ /^relamp\// { next }
        $1 ~ /_test[.]cpp$/ && quoted[2] ~ /^scenes\// { next }
        {
            from = layerOf(substr($1, length("src/") + 1))
            to = layerOf(quoted[2])
            if (!(from in height)) print $0 ": layer " from " is not named in tests/lint/layers.sh"
            else if (!(to in height)) print $0 ": no layer " to
            else if (height[to] > height[from]) print $0 ": upward, from " from " to " to
        }'
    includes apps | grep -E '"[^"]*/' | grep -vE '"(relamp|inside)/|"bench/stage_times.h"|^apps/viewer/.*"gpu/' |
        sed 's/$/: neither public nor in src\/inside/' || true
    includes python | grep -E '"[^"]*/' | grep -v '"relamp/' | sed 's/$/: not a public header/' || true
    includes include/relamp | grep -vE '"relamp/|<glm/|<[a-z_]+>' | sed 's/$/: not for a public header/' || true
    for header in include/relamp/*.h; do
        name=relamp/${header##*/}
        [[ $name == relamp/relamp.h ]] || grep -q "\"$name\"" include/relamp/relamp.h || echo "$header: relamp.h lacks it"
    done
    grep -rnE '\b(RTC|Vk|vk::|Eigen::|tinygltf::|OIIO::|tbb::|ai(Scene|Mesh))' include/relamp |
        sed 's/$/: not for a public header/' || true
)
[[ -z $found ]] || { echo "$found" && exit 1; }
