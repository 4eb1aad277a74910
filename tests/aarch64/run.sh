#!/bin/sh
# Builds raylane for AArch64 with Debian's cross compiler and runs it in qemu's emulation. It must
# build without warnings, its short tests must pass with NEON's lanes, and its images must have the
# bits of build/release here.
#
#   tests/aarch64/run.sh          all test programs, and all scenes
#   tests/aarch64/run.sh quick    simd's tests (of lanes, filters, solvers and so on), and one scene
#   tests/aarch64/run.sh lanes    tests of registers only, which need no kernels: some minutes
#
# Runs on Debian 12, whose libraries for arm64 it uses. The images need a build/release of this
# machine.
#
# [native] tests are left out: they compare builds or processors that are not available here, take
# minutes in emulation, or set memory limits that the emulator ignores. So are the tool's tests:
# they observe processes, memory and signals from outside, and would see the emulator's.
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
    scenes-api scenes-api-threads"
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
same() { # name of the comparison
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
    ! grep -F "raylane: --isa: raylane was built without avx2; available: neon" "$pictures/refusal"; then
    cat "$pictures/refusal"
    failed="$failed refusal"
fi
[ -z "$failed" ] || { echo "failed: $failed"; exit 1; }
