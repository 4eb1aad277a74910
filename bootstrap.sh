#!/bin/sh
# Sets a fresh Debian or Ubuntu machine up, builds raylane, and renders a picture or runs the tests.
set -eu

usage() {
    echo "usage: ./bootstrap.sh render    build, and render scenes/birthday.json to birthday.png"
    echo "       ./bootstrap.sh test      build, and run the test suite"
}

# Processor seconds of compiling and megabytes of build/release, by g++ 12 on Debian 12 without a compiler cache.
render_seconds=660
render_megabytes=40
test_seconds=2100
test_megabytes=500

# Packages with their purposes. gemmi, OpenEXR and libtiff are optional, and cost 4.8 MB to download and 35 processor
# seconds.
render_packages='
g++                 the C++20 compiler
cmake               configures the build
ninja-build         runs it
libglm-dev          vectors
libxsimd-dev        SIMD registers
libtbb-dev          threads
nlohmann-json3-dev  reads JSON scenes
libcli11-dev        reads the command line
libstb-dev          writes HDR
zlib1g-dev          reads files that gzip compressed
libpng-dev          writes and reads PNG
libxxhash-dev       checksums of built scenes and of unfinished pictures
libopenexr-dev      writes and reads OpenEXR
libtiff-dev         writes TIFF
gemmi-dev           reads PDB and mmCIF,
tao-pegtl-dev       which needs this
'
test_packages='
catch2              runs the tests
libboost-dev        their 100-digit oracle
libsdl2-dev         opens windows
libpango1.0-dev     writes texts on images
xvfb                the test of these
libbenchmark-dev    measures speed
pkgconf             the test of the installed library
pybind11-dev        the Python module,
python3-dev         its headers
python3-numpy       and its arrays
python3-pytest      the tests of it
python3-jsonschema  the test of the JSON Schema
gappa               proves the kernels'"'"' error bounds
'

fail() { # exit code, message
    echo "bootstrap.sh: $2" >&2
    exit "$1"
}

is_installed() {
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# Prints the purposes of packages, one line each.
purposes() { # packages...
    for name in "$@"; do
        echo "$packages" | awk -v name="$name" '$1 == name { print "  " $0 }'
    done
}

# Prints the two sizes that apt-get reports, without installing.
sizes() { # packages...
    LC_ALL=C apt-get install --assume-no --no-install-recommends -o Debug::NoLocking=1 "$@" 2>/dev/null |
        sed -n 's/^Need to get \(.*\) of archives\.$/Packages: \1 to download./p
            s/^After this operation, \(.*\) of additional disk space will be used\.$/Packages: \1 on the disk./p' || true
}

# Estimates the compiler's time from the number of processors.
say_costs() {
    minutes=$(((seconds / $(nproc) + 59) / 60))
    if [ -e "build/release/bin/$last_built" ]; then
        echo "Compiling: only changed files, of $minutes minutes for all on $(nproc) processor(s)."
    else
        echo "Compiling: about $minutes minutes on $(nproc) processor(s); $megabytes MB on the disk, in build/release."
    fi
}

install_missing() {
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        echo "raylane needs these packages, but apt is missing:" >&2
        echo "$packages" | sed '/^$/d; s/^/  /' >&2
        fail 3 "install them by this system's package manager, then build: see CONTRIBUTING.md"
    fi
    wanted=
    for name in $(echo "$packages" | awk 'NF { print $1 }'); do
        is_installed "$name" || wanted="$wanted $name"
    done
    if [ -z "$wanted" ]; then
        say_costs
        return 0
    fi

    root=
    echo "raylane needs these packages and will now install them with apt-get:"
    # shellcheck disable=SC2086 # a list of words
    purposes $wanted
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null ||
            fail 3 "only root may install them, and there is no sudo. As root, run: apt-get install$wanted"
        root=sudo
    fi
    $root apt-get update || fail 3 "apt-get update failed; see above"
    # shellcheck disable=SC2086 # a list of words
    sizes $wanted
    say_costs
    # shellcheck disable=SC2086 # a list of words
    $root env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends $wanted ||
        fail 3 "apt-get install failed; see above"
}

build() { # target, options of cmake
    target=$1
    shift
    # Other compilers than the tested one may give more warnings.
    # shellcheck disable=SC2086 # a command that may have options
    case $(${CXX:-c++} -dumpversion 2>/dev/null) in
    12 | 12.*) ;;
    *) set -- "$@" -DRAYLANE_DEVELOPER=OFF ;;
    esac
    log=build/bootstrap.log
    mkdir -p build
    [ -e build/release/build.ninja ] || set -- "$@" --fresh # an earlier configuration may have failed
    # RAYLANE_ISAS=all ./bootstrap.sh test builds kernels for all instruction sets, not only for this
    # machine's.
    if ! cmake --preset release "-DRAYLANE_ISAS=${RAYLANE_ISAS:-native}" "$@" >"$log" 2>&1; then
        cat "$log" >&2
        fail 1 "configuring failed; see above, or $log"
    fi
    sed -n '/^-- Optional parts:/s/^-- //p; s/^--   /  /p' "$log"
    cmake --build --preset release --parallel "$(nproc)" --target "$target" || fail 1 "compiling failed; see above"
}

cd "$(dirname "$0")"
case "${1-}" in
render)
    packages=$render_packages
    seconds=$render_seconds
    megabytes=$render_megabytes
    last_built=raylane
    ;;
test)
    packages=$render_packages$test_packages
    seconds=$test_seconds
    megabytes=$test_megabytes
    last_built=raylane-test-core
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
[ $# -eq 1 ] || { usage >&2; exit 2; }

install_missing
if [ "$1" = render ]; then
    build raylane -DRAYLANE_TESTS=OFF -DRAYLANE_BENCHMARKS=OFF -DRAYLANE_PYTHON=OFF
    start=$(date +%s%N)
    build/release/bin/raylane render scenes/birthday.json -o birthday.png || fail $? "rendering failed; see above"
    milliseconds=$((($(date +%s%N) - start) / 1000000))
    echo "Rendered $(pwd)/birthday.png in $((milliseconds / 1000)).$(printf %03d $((milliseconds % 1000))) s."
else
    build raylane-tests -DRAYLANE_TESTS=REQUIRED -DRAYLANE_BENCHMARKS=REQUIRED
    ctest --preset release --parallel "$(nproc)" --label-exclude bench || # these are not built here
        fail $? "tests failed; see above"
fi
