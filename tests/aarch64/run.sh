#!/bin/sh
# raylane for AArch64, by Debian's cross compiler and qemu's emulation: it builds without warnings, its short tests
# pass by NEON's lanes, and its pictures have the bits that build/release draws here.
#
#   tests/aarch64/run.sh          all programs of tests, and all scenes
#   tests/aarch64/run.sh quick    simd's tests (of lanes, filters, finishers and the like), and one scene
#   tests/aarch64/run.sh lanes    tests of registers alone, which want no kernels: some minutes
#
# On Debian 12, whose libraries for arm64 it takes, and beside a build/release of here for the pictures.
#
# [native] tests compare builds or processors that there are not here, take minutes by emulation, or set limits of
# memory, which the emulator does not hold them to. The tool's look at processes, memory and signals from outside, and
# would see the emulator's.
set -eu
cd "$(dirname "$0")/../.."
form=${1-full}
case $form in
full | quick)
    [ -x build/release/bin/raylane ] || { echo "run.sh: no build/release/bin/raylane, whose pictures these are held to"; exit 2; }
    ;;
lanes) ;;
*)
    echo "usage: tests/aarch64/run.sh [quick|lanes]"
    exit 2
    ;;
esac
mkdir -p build

. tests/have.sh
have g++-aarch64-linux-gnu cmake ninja-build qemu-user
tests/aarch64/root.sh >build/aarch64-root.log 2>&1 || { cat build/aarch64-root.log; exit 1; }
emulate() { # program of build/aarch64, arguments...
    emulated=$1
    shift
    RAYLANE_TEST_ROUNDS=${RAYLANE_TEST_ROUNDS:-3} \
        qemu-aarch64 -L build/aarch64-root "build/aarch64/bin/$emulated" "$@"
}

echo "== build"
cmake --preset aarch64 >build/aarch64.log 2>&1 || { cat build/aarch64.log; exit 1; }
if [ "$form" = lanes ]; then
    cmake --build --preset aarch64 --parallel "$(nproc)" --target raylane-test-lanes
    emulate raylane-test-lanes
    exit
fi
programs="simd simd-shapes"
[ "$form" = quick ] || programs="core simd simd-shapes simd-threads simd-allocation scenes scenes-threads scenes-memory \
    scenes-library scenes-library-threads"
# shellcheck disable=SC2046,SC2086 # lists of words
cmake --build --preset aarch64 --parallel "$(nproc)" --target raylane $(printf 'raylane-test-%s ' $programs)

echo "== tests"
failed=
for program in $programs; do
    log=build/aarch64-$program.log
    emulate "raylane-test-$program" '~[long]~[native]' >"$log" 2>&1 || failed="$failed $program"
    echo "$program: $(tail -n 2 "$log" | tr '\n' ' ')"
done
for program in $failed; do
    cat "build/aarch64-$program.log"
done

echo "== pictures"
pictures=$(mktemp -d)
trap 'rm -rf "$pictures"' EXIT
draw() { # picture, scene, command and options...
    picture=$pictures/$1.pfm
    scene=$2
    shift 2
    # shellcheck disable=SC2086 # a list of options
    "$@" $options -o "$picture" "$scene"
}
same() { # what
    echo "$1:"
    build/release/bin/raylane compare "$pictures/here.pfm" "$pictures/there.pfm" || failed="$failed $1"
}
scenes=scenes/birthday.json
[ "$form" = quick ] || scenes=$(git ls-files 'scenes/*.json' ':!scenes/*/*' ':!*.schema.json')
for scene in $scenes; do
    options="--size 120x120 --spp 1"
    draw here "$scene" build/release/bin/raylane render
    draw there "$scene" emulate raylane render --isa neon
    same "$scene"
done
for options in "--engine reference" "--engine reference --precision robust" "--precision fast" "--precision double"; do
    options="--size 60x60 --spp 1 $options"
    draw here scenes/birthday.json build/release/bin/raylane render
    draw there scenes/birthday.json emulate raylane render
    same "scenes/birthday.json $options"
done

if emulate raylane render scenes/birthday.json --isa avx2 -o "$pictures/none.png" 2>"$pictures/refusal" ||
    ! grep -F "raylane: --isa: this program was built without avx2, with neon" "$pictures/refusal"; then
    cat "$pictures/refusal"
    failed="$failed refusal"
fi
[ -z "$failed" ] || { echo "failed: $failed"; exit 1; }
