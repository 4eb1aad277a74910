#!/bin/sh
# Every reader under libFuzzer with sanitizers, two at a time. Fails, with the input, if one of them
# finds anything. Inputs that were of use are kept in build/fuzz/corpus, for the next time.
#
#   tests/fuzz/run.sh [SECONDS [FORMAT...]]    default: ten minutes each, all of them
set -eu
cd "$(dirname "$0")/../.."
seconds=${1:-600}
[ $# -eq 0 ] || shift
formats=${*:-"cif gro json lammps_data lammps_dump nff pdb picture pov tachyon xyz"}

mkdir -p build/fuzz/findings
kernels= # no sanitizer changes them
[ ! -e build/asan/CMakeCache.txt ] || kernels=-DRAYLANE_KERNELS=$PWD/build/asan
[ -e build/fuzz/build.ninja ] || cmake --preset fuzz -GNinja $kernels >build/fuzz/configure.log || { cat build/fuzz/configure.log; exit 1; }
targets=
for format in $formats; do targets="$targets raylane-fuzz-$format"; done
# shellcheck disable=SC2086 # a list of words
cmake --build build/fuzz --target $targets

seeds() { # format, folder: what it is to begin with
    case $1 in
    json) cp scenes/*.json "$2" ;;
    pov) cp tests/scenes/pov/*.pov "$2" ;;
    tachyon) cp tests/scenes/tachyon/data/*.dat "$2" ;;
    esac
    cp tests/fuzz/seeds/"$1".* "$2" 2>/dev/null || true
}
fuzz() { # format
    folder=build/fuzz/corpus/$1
    mkdir -p "$folder" "build/fuzz/rooms/$1"
    seeds "$1" "$folder"
    root=$PWD
    (cd "build/fuzz/rooms/$1" && "$root/build/fuzz/bin/raylane-fuzz-$1" -max_total_time="$seconds" \
        -timeout=100 -rss_limit_mb=4096 -max_len=20000 -print_final_stats=1 \
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
