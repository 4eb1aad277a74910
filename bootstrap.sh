#!/bin/sh
# Sets a fresh Debian or Ubuntu machine up, builds raylane, and renders a picture or runs the tests.
set -eu

usage() {
    echo "usage: ./bootstrap.sh render    build, and render scenes/birthday.json to birthday.png"
    echo "       ./bootstrap.sh test      build, and run the test suite"
}

# Each with what it is for.
packages='
g++                 the C++20 compiler
cmake               configures the build
ninja-build         runs it
libglm-dev          vectors
libxsimd-dev        SIMD registers
libtbb-dev          threads
nlohmann-json3-dev  reads JSON scenes
libcli11-dev        reads the command line
libstb-dev          writes HDR
zlib1g-dev          reads what gzip compressed
libpng-dev          writes and reads PNG
libopenexr-dev      writes and reads OpenEXR
libsdl2-dev         opens windows
libxxhash-dev       checksums of what is kept of a picture, and of built scenes
xvfb                the test of these
gemmi-dev           reads PDB and mmCIF,
tao-pegtl-dev       which needs this
libbenchmark-dev    measures speed
catch2              runs the tests
libboost-dev        the tests'"'"' 100-digit oracle
pkgconf             the test of what is installed
pybind11-dev        Python'"'"'s module,
python3-dev         its headers
python3-numpy       and its arrays
python3-pytest      the tests of it
python3-jsonschema  the test of the JSON Schema
gappa               proves the kernels'"'"' error bounds
'

names() {
    echo "$packages" | awk 'NF { print $1 }'
}

is_installed() {
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

missing() {
    for name in $(names); do
        is_installed "$name" || echo "$name"
    done
}

install_missing() {
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        echo "raylane needs these packages, and there is no apt here to install them:" >&2
        echo "$packages" | sed '/^$/d; s/^/  /' >&2
        echo "Install what they are called on this system, then build: see README.md." >&2
        exit 3
    fi
    wanted=$(missing)
    [ -n "$wanted" ] || return 0

    echo "raylane needs these packages and will now install them with apt-get:"
    for name in $wanted; do
        echo "$packages" | awk -v name="$name" '$1 == name { print "  " $0 }'
    done
    root=
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "Only root may install them, and there is no sudo. As root, run:" >&2
            echo "  apt-get install" $wanted >&2
            exit 3
        fi
        root=sudo
    fi
    # shellcheck disable=SC2086 # a list of words
    if ! { $root apt-get update &&
        $root env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends $wanted; }; then
        echo "apt-get failed; see above" >&2
        exit 3
    fi
}

build() { # options of cmake --build
    # A tree that another generator configured keeps it.
    generator=-GNinja
    [ ! -f build/release/CMakeCache.txt ] || generator=
    log=build/bootstrap.log
    mkdir -p build
    if ! cmake --preset release $generator >"$log" 2>&1; then
        cat "$log" >&2
        exit 1
    fi
    cmake --build --preset release --parallel "$(nproc)" "$@"
}

cd "$(dirname "$0")"
case "${1-}" in
render | test)
    [ $# -eq 1 ] || { usage >&2; exit 2; }
    ;;
-h | --help)
    usage
    exit 0
    ;;
*)
    usage >&2
    exit 2
    ;;
esac

install_missing
if [ "$1" = render ]; then build --target raylane; else build --target raylane-tests; fi
start=$(date +%s%N)
if [ "$1" = render ]; then
    build/release/bin/raylane render scenes/birthday.json -o birthday.png
    milliseconds=$((($(date +%s%N) - start) / 1000000))
    echo "Rendered $(pwd)/birthday.png in $((milliseconds / 1000)).$(printf %03d $((milliseconds % 1000))) s."
else
    ctest --preset release --parallel "$(nproc)" --label-exclude bench # which are not built
fi
