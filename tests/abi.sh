#!/bin/sh
# What binaries see of the shared library, symbols and the layout of types, beside what they saw of the last
# version (scenes/library/abi.txt): fails if that has changed and the version has not as it should.
# Wants g++ and abidw (Debian's abigail-tools); takes a minute.
#
#   tests/abi.sh             compare
#   tests/abi.sh --update    write it anew: with each release, and where what is not out yet changes
set -eu
cd "$(dirname "$0")/.."
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
version=$(sed -n 's/^#define RAYLANE_VERSION "\(.*\)"/\1/p' scenes/library/raylane/version.h)

# The calls alone, whatever they call: no kernel takes part.
for source in scenes/library/*.cpp scenes/c/*.cpp scenes/errors.cpp; do
    echo "$source"
done | xargs -P "$(nproc)" -I '{}' sh -c 'g++ -std=c++20 -g -O0 -fPIC -fvisibility=hidden \
    -fvisibility-inlines-hidden -DGLM_FORCE_EXPLICIT_CTOR -DGLM_FORCE_XYZW_ONLY -I. -Iscenes/library \
    -c "$1" -o "$0/$(printf %s "$1" | tr / -).o"' "$room" '{}'
g++ -shared -Wl,--version-script=scenes/library/exports.map -o "$room/libraylane.so" "$room"/*.o
nm -DC --defined-only "$room/libraylane.so" >"$room/symbols"
{
    echo "# $version"
    abidw --headers-dir scenes/library/raylane --drop-private-types --no-show-locs --no-corpus-path \
        --no-comp-dir-path "$room/libraylane.so" | python3 tests/abi.py "$room/symbols"
} >"$room/abi.txt"
[ "$(wc -l <"$room/abi.txt")" -gt 100 ] || { echo "abidw tells of nothing"; exit 1; }
if [ "${1-}" = --update ]; then
    cp "$room/abi.txt" scenes/library/abi.txt
else
    tests/abi_compare.sh scenes/library/abi.txt "$room/abi.txt" "$version"
fi
