#!/bin/sh
# usage: tests/wasm.sh [RAYLANE]
# Builds the library as WebAssembly, and its page, with Debian's packages. Compares it in node with
# the bits of a native raylane (default: build/release/bin/raylane), and checks the page in a
# headless Chromium. PICTURES=FOLDER keeps screenshots of the page.
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
