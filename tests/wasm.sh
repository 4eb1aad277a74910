#!/bin/sh
# usage: tests/wasm.sh [RAYLANE]
# The library as WebAssembly and the page that has it, by what Debian has: built; held in node to the bits
# of a native raylane (default: build/release/bin/raylane); and looked at in a headless Chromium.
# PICTURES=FOLDER leaves there what that shows.
set -eu
cd "$(dirname "$0")/.."
raylane=${1:-build/release/bin/raylane}

missing=
for package in cmake make emscripten nodejs libglm-dev libxsimd-dev nlohmann-json3-dev libstb-dev \
    chromium chromium-driver python3-selenium; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
        missing="$missing $package"
done
if [ -n "$missing" ]; then
    root=
    [ "$(id -u)" -eq 0 ] || root=sudo
    $root apt-get update
    # shellcheck disable=SC2086 # a list of words
    $root env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends $missing
fi

cmake --preset wasm
cmake --build --preset wasm --parallel "$(nproc)"
ls -l build/wasm/bin/raylane.html
node tests/wasm/hashes.js "$PWD/build/wasm/bin" "$raylane"
# shellcheck disable=SC2086 # none or one
/usr/bin/python3 tests/wasm/browser_check.py build/wasm/bin/raylane.html "$raylane" ${PICTURES:+"$PICTURES"}
