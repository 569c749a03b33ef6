#!/usr/bin/env bash
# Builds the package roundel: Python's, with a link to the library of libroundel.
set -euo pipefail

library=$(find "$PREFIX/lib" -maxdepth 1 -name 'libroundel.so' -o -name 'libroundel.dylib')
ROUNDEL_LIBRARY=$library "$PYTHON" -m pip install --no-deps --no-build-isolation -v "$SRC_DIR/bindings/python"
name=$(basename "$library")
# From lib/python3.N/site-packages/roundel.
ln -sf "../../../$name" "$SP_DIR/roundel/$name"
