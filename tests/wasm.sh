#!/bin/sh
# usage: tests/wasm.sh [RAYLANE]
# The library as WebAssembly and the page that has it, by what Debian has: built; held in node to the bits
# of a native raylane (default: build/release/bin/raylane); and looked at in a headless Chromium.
# PICTURES=FOLDER leaves there what that shows.
set -eu
cd "$(dirname "$0")/.."
raylane=${1:-build/release/bin/raylane}

. tests/have.sh
have cmake ninja-build emscripten nodejs libglm-dev libxsimd-dev nlohmann-json3-dev libstb-dev libxxhash-dev chromium chromium-driver \
    python3-selenium

cmake --preset wasm
cmake --build --preset wasm --parallel "$(nproc)"
ls -l build/wasm/bin/raylane.html
node tests/wasm/hashes.js "$PWD/build/wasm/bin" "$raylane"
# shellcheck disable=SC2086 # none or one
/usr/bin/python3 tests/wasm/browser_check.py build/wasm/bin/raylane.html "$raylane" ${PICTURES:+"$PICTURES"}
