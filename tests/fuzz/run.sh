#!/bin/sh
# Runs the fuzzers with sanitizers, two at a time: each reader by its format, "formula" for patterns,
# "picture" for images, "calls", "solids" and "engines" for the library's answers, "c" for its
# interface for C. Fails and keeps the input if a fuzzer finds anything. Useful inputs stay in
# build/fuzz/corpus for the next run.
#
#   tests/fuzz/run.sh [SECONDS [FUZZER...]]    default: ten minutes each, all of them
#   BUILD=build/asan tests/fuzz/run.sh 30      fuzzers of another build, which has RAYLANE_FUZZERS
set -eu
cd "$(dirname "$0")/../.."
seconds=${1:-600}
[ $# -eq 0 ] || shift
formats=${*:-"built cif formula gro json lammps_data lammps_dump mol mol2 nff pdb picture pov pqr tachyon xyz calls solids engines c"}
build=${BUILD:-build/fuzz}

mkdir -p build/fuzz/findings
kernels= # no sanitizer changes them
[ ! -e build/asan/CMakeCache.txt ] || kernels=-DRAYLANE_KERNELS=$PWD/build/asan
[ -e "$build/build.ninja" ] || cmake --preset fuzz $kernels >build/fuzz/configure.log || { cat build/fuzz/configure.log; exit 1; }
targets=
for format in $formats; do targets="$targets raylane-fuzz-$format"; done
# shellcheck disable=SC2086 # a list of words
cmake --build "$build" --target $targets

seeds() { # format, folder: copies the first inputs
    case $1 in
    json) cp scenes/*.json "$2" ;;
    pov) cp tests/scenes/formats/pov/*.pov "$2" ;;
    tachyon) cp tests/scenes/formats/tachyon/data/*.dat "$2" ;;
    esac
    [ -e "tests/fuzz/seeds/$1.hex" ] || cp tests/fuzz/seeds/"$1".* "$2" 2>/dev/null || true
    [ ! -e "tests/fuzz/seeds/$1.hex" ] || # lines of bytes
        perl -ne 'BEGIN { $to = shift } chomp; open(F, ">", "$to/seed.$.") or die; print F pack("H*", $_)' \
            "$2" <"tests/fuzz/seeds/$1.hex"
}
fuzz() { # format
    folder=build/fuzz/corpus/$1
    mkdir -p "$folder" "build/fuzz/rooms/$1"
    seeds "$1" "$folder"
    root=$PWD
    length=20000
    case $1 in calls | solids | engines | c) length=1000 ;; esac
    # SECURITY.md's budgets, several times as large under sanitizers. Loops and instances reach theirs.
    timeout=10 megabytes=1024
    case $1 in pov | json | picture | calls | solids | engines | c) timeout=100 megabytes=4096 ;; esac
    (cd "build/fuzz/rooms/$1" && "$root/$build/bin/raylane-fuzz-$1" -max_total_time="$seconds" \
        -timeout=$timeout -rss_limit_mb=$megabytes -max_len=$length -print_final_stats=1 \
        -artifact_prefix="$root/build/fuzz/findings/$1-" "$root/$folder" >"$root/build/fuzz/$1.log" 2>&1)
}
report() { # format
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "build/fuzz/$1.log")
    echo "$1: ${runs:-?} inputs, $(find build/fuzz/corpus/"$1" -type f | wc -l) kept"
}

failed=
# shellcheck disable=SC2086 # a list of words
set -- $formats
while [ $# -gt 0 ]; do
    first=$1 second=${2-}
    shift
    [ $# -eq 0 ] || shift
    fuzz "$first" &
    process=$!
    if [ -n "$second" ] && ! fuzz "$second"; then failed="$failed $second"; fi
    wait $process || failed="$failed $first"
    report "$first"
    [ -z "$second" ] || report "$second"
done
for format in $failed; do
    tail -n 40 "build/fuzz/$format.log"
done
[ -z "$failed" ] || { echo "found:$failed"; exit 1; }
