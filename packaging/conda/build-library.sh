#!/usr/bin/env bash
# Builds the package libroundel: libraries, headers, CMake packages, pkg-config module, the program.
set -euo pipefail

cmake -S "$SRC_DIR" -B build -DCMAKE_INSTALL_PREFIX="$PREFIX" -DCMAKE_INSTALL_LIBDIR=lib
cmake --build build
cmake --install build
# conda packages have no static libraries.
rm "$PREFIX/lib/libroundel.a"
