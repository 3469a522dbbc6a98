#!/usr/bin/env bash
# Every source looks as clang-format would have it.
set -euo pipefail
find include src apps tests bench -name '*.cpp' -o -name '*.h' -o -name '*.comp' |
    xargs clang-format --dry-run --Werror
