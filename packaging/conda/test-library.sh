#!/usr/bin/env bash
# Uses the package libroundel: the program, and the README's example of C.
set -euo pipefail

roundel quad shape:torus:500 --quads 100 -o quads.obj
test "$(grep -c '^f ' quads.obj)" -gt 50
sed -n '/^```c$/,/^```$/p' README.md | sed '/^```/d' >example.c
# shellcheck disable=SC2046
"${CC:-cc}" example.c $(pkg-config --cflags --libs roundel) "-Wl,-rpath,$CONDA_PREFIX/lib" -o example
test "$(./example)" = "0.2 0"
