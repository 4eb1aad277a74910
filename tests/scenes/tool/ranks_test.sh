#!/bin/sh
# Several ranks of one job draw and trace what one process does, to the byte; what ends one of them
# loses no tile that was done.
#
#   ranks_test.sh RAYLANE SCENE    77 where there is no mpirun, or raylane was built without MPI
set -eu

raylane=$1
scene=$2
command -v mpirun >/dev/null || exit 77
[ -e "$(dirname "$raylane")/raylane-mpi.so" ] || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# As root, and with more ranks than processors, which is for tests.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
job() { # ranks, command...
    ranks=$1
    shift
    timeout 300 mpirun --oversubscribe -n "$ranks" "$raylane" "$@"
}
fail() {
    echo "$*"
    [ ! -e err ] || cat err
    exit 1
}
same() {
    cmp "$1" "$2" || fail "$2 is another file than $1"
}

echo "pictures"
try() { # ending, options...
    ending=$1
    shift
    "$raylane" render "$scene" -q -o "one.$ending" "$@"
    for ranks in 2 3; do
        job $ranks render "$scene" -o "many.$ending" "$@" 2>err || fail "$ranks ranks, $*"
        same "one.$ending" "many.$ending"
    done
}
try png --size 150x90
try png --size 150x90 --threads 3 --quality 35 --crop 21,3,100x70 --alpha
try png --size 90x50 --engine reference --outline 2
try png --size 3x2 --tile 8 # fewer tiles than ranks
if "$raylane" render "$scene" -q -o one.exr --size 150x90 2>/dev/null; then
    try exr --size 150x90 --layers
    try exr --size 150x90 --part 2/3
fi

echo "a scene that ranks of a host share"
"$raylane" build "$scene" -o built.rl -q
"$raylane" render "$scene" -q -o one.pfm --size 150x90
job 2 render built.rl -o many.pfm --size 150x90 2>err || fail "a built scene"
same one.pfm many.pfm
for name in "$scene" built.rl; do
    mapped="memfd:raylane scene"
    [ "$name" = "$scene" ] || mapped=built.rl
    job 2 render "$name" -o long.png --size 4000x4000 --spp 65536 --no-resume >out 2>err &
    sharing=
    tries=0
    while [ -z "$sharing" ] && [ $tries -lt 300 ]; do
        sleep 0.2
        tries=$((tries + 1))
        count=0
        for process in $(pgrep -f "^$raylane render $name -o long.png"); do
            ! grep -qsF "$mapped" "/proc/$process/maps" || count=$((count + 1))
        done
        [ $count -lt 2 ] || sharing=1
    done
    pkill -KILL -f "^$raylane render $name -o long.png" || true
    wait $! || true
    [ -n "$sharing" ] || fail "ranks do not share $name"
done

echo "figures of all ranks"
job 2 render "$scene" --size 150x90 -o many.png --stats many.json 2>err || fail "--stats"
"$raylane" render "$scene" --size 150x90 -q -o one.png --stats one.json
for key in primary shadow total; do
    [ "$(grep "\"$key\"" one.json)" = "$(grep "\"$key\"" many.json)" ] || fail "other $key rays"
done

echo "frames, in turn"
"$raylane" render "$scene" -q --turn 360/5 -o 'one%d.png' --size 40x30
job 3 render "$scene" --turn 360/5 -o 'many%d.png' --size 40x30 2>err || fail "frames"
for frame in 0 1 2 3 4; do
    same one$frame.png many$frame.png
done

echo "rays"
python3 - <<'PYTHON' || exit 77
import random, struct
random.seed(7)
count = 200_000
with open("rays.npy", "wb") as file:
    head = "{'descr': '<f8', 'fortran_order': False, 'shape': (%d, 6), }" % count
    head += " " * (63 - (10 + len(head)) % 64) + "\n"
    file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode())
    file.write(struct.pack("<%dd" % (6 * count), *(random.uniform(-3, 3) for _ in range(6 * count))))
PYTHON
for options in "" --occluded; do
    # shellcheck disable=SC2086 # a list of options
    "$raylane" trace "$scene" rays.npy -o one.npy $options
    for ranks in 2 3; do
        # shellcheck disable=SC2086
        job $ranks trace "$scene" rays.npy -o many.npy $options 2>err || fail "trace $options"
        same one.npy many.npy
    done
done

echo "mistakes are said once"
refused() { # code, line, command...
    code=$1
    line=$2
    shift 2
    status=0
    job 3 "$@" 2>err || status=$?
    [ "$status" -eq "$code" ] || fail "$* ended with $status"
    [ "$(grep -c '^raylane: ' err)" -eq 1 ] || fail "$* has not one line"
    grep -qF "raylane: $line" err || fail "$* said something else"
}
refused 2 "--spp: must be a square number" render "$scene" --spp 3
refused 2 "none.json: no such file" render none.json
refused 3 "none/a.png: cannot write" render "$scene" -o none/a.png
refused 2 "none.npy: no such file" trace "$scene" none.npy
refused 2 "err: must be an array in NumPy's format" trace "$scene" err

echo "what ends a rank loses no tile that was done"
long="--size 600x600 --spp 484"
# shellcheck disable=SC2086 # a list of options
"$raylane" render "$scene" -q -o one.png $long
for signal in KILL TERM; do
    for seconds in 3 4 6 9; do # until it is ended in the midst of it, however fast this machine is
        rm -f many.png many.png.part
        # shellcheck disable=SC2086
        job 2 render "$scene" -o many.png $long >out 2>err &
        sleep "$seconds"
        # The rank that was started last.
        pkill -"$signal" -n -f "^$raylane render $scene -o many.png" || true
        status=0
        wait $! || status=$?
        [ ! -e many.png.part ] || break
    done
    [ "$status" -ne 0 ] || continue # too fast
    [ -e many.png.part ] || fail "$signal left nothing to go on with"
    # shellcheck disable=SC2086
    job 2 render "$scene" -o many.png $long 2>err || fail "it does not go on"
    grep -q "many.png.part: goes on at" err || fail "it has begun anew"
    same one.png many.png
done
