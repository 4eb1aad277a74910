#!/bin/sh
# Tests that several ranks of one job render and trace the same bytes as one process, and that the
# end of one rank loses no finished tile.
#
#   ranks_test.sh RAYLANE SCENE HELD_CALL    77 without mpirun, python3 or raylane's MPI
#
# With RAYLANE_TEST_ROUNDS=full, images and rays are tested with 2 ranks and with 3, otherwise with 3.
set -eu

raylane=$1
scene=$2
held_call=$3
for program in mpirun python3; do
    command -v $program >/dev/null || exit 77
done
[ -e "$(dirname "$raylane")/raylane-mpi.so" ] || exit 77
. "$(dirname "$0")/../../wait.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# Allows root, and more ranks than processors, which only tests need.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
numbers=3
[ "${RAYLANE_TEST_ROUNDS-}" != full ] || numbers="2 3"
job() { # ranks, command...
    ranks=$1
    shift
    timeout 600 mpirun --oversubscribe -n "$ranks" "$raylane" "$@"
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
    for ranks in $numbers; do
        job $ranks render "$scene" -o "many.$ending" "$@" 2>err || fail "$ranks ranks, $*"
        same "one.$ending" "many.$ending"
    done
}
try png --size 150x90
try png --size 150x90 --threads 3 --quality 35 --crop 21,3,100x70 --alpha
try png --size 90x50 --engine reference --outline 2
try png --size 3x2 --tile 8 # fewer tiles than ranks
if "$raylane" render "$scene" -q -o one.exr --size 150x90 2>/dev/null; then
    try exr --size 150x90 --aovs
    try exr --size 150x90 --part 2/3
fi

echo "commands that ranks do each for itself"
status=0
timeout 600 mpirun --oversubscribe -n 2 sh -c '
    [ "$OMPI_COMM_WORLD_RANK" = 0 ] || exec "$0" info none.json
    exec "$0" info "$1"' "$raylane" "$scene" >out 2>err || status=$?
[ "$status" -ne 0 ] || fail "a rank that fails ends with 0"
grep -q "raylane: none.json: no such file" err || fail "a rank that fails says nothing"

echo "a scene that ranks of a host share"
"$raylane" build "$scene" -o built.rl -q
"$raylane" render "$scene" -q -o one.pfm --size 150x90
job 2 render built.rl -o many.pfm --size 150x90 2>err || fail "a built scene"
same one.pfm many.pfm
both_map() { # mapped, processes
    count=0
    for process in $(pgrep -f "$2"); do
        ! grep -qsF "$1" "/proc/$process/maps" || count=$((count + 1))
    done
    [ $count -ge 2 ]
}
# Checks that two ranks, which render for hours, map the same memory.
shares() { # mapped, scene and options...
    mapped=$1
    shift
    job 2 render "$@" -o long.png --size 4000x4000 --spp 65536 --no-resume >out 2>err &
    sharing=1
    wait_until both_map "$mapped" "^$raylane render $* -o long.png" || sharing=
    pkill -KILL -f "^$raylane render $* -o long.png" || true
    wait $! || true
    [ -n "$sharing" ] || fail "ranks do not share $*"
}
shares "memfd:raylane scene" "$scene"
shares built.rl built.rl

echo "figures of all ranks"
job 2 render "$scene" --size 150x90 -o many.png --stats many.json 2>err || fail "--stats"
"$raylane" render "$scene" --size 150x90 -q -o one.png --stats one.json
for key in primary shadow total; do
    [ "$(grep "\"$key\"" one.json)" = "$(grep "\"$key\"" many.json)" ] || fail "other $key rays"
done
grep -q '"ranks": 1,' one.json || fail "one rank is not told"
grep -q '"ranks": 2,' many.json || fail "two ranks are not told"

echo "frames, in turn"
"$raylane" render "$scene" -q --turn 360/5 -o 'one%d.png' --size 40x30
job 3 render "$scene" --turn 360/5 -o 'many%d.png' --size 40x30 2>err || fail "frames"
for frame in 0 1 2 3 4; do
    same one$frame.png many$frame.png
done

echo "one frame, by all ranks"
for frame in 0 1 2; do
    printf '3\n\nC 0 0 0\nO 0 0 %s\nN 1 0 0\n' "1.$frame"
done >film.xyz
for options in "--frames 1" "--frames -1 --camera-from all --view top --zoom 2" \
    "--frames 2 --style spheres --depth-cue 0.5"; do
    # shellcheck disable=SC2086 # a list of options
    "$raylane" render film.xyz -q $options -o one.png --size 150x90
    # shellcheck disable=SC2086
    job 3 render film.xyz $options -o many.png --size 150x90 2>err || fail "$options"
    same one.png many.png
done
# Both ranks render the frame: they share its scene.
shares "memfd:raylane scene" film.xyz --frames 1
if [ -e one.exr ]; then
    "$raylane" render film.xyz -q --frames 1 -o one.exr --bits 32 --size 150x90
    for part in 1 2; do
        job 2 render film.xyz --frames 1 -o part-$part.exr --part $part/2 --size 150x90 2>err ||
            fail "a part of a frame"
    done
    "$raylane" merge part-2.exr part-1.exr -o many.exr
    same one.exr many.exr
    "$raylane" verify -q many.exr film.xyz >out || fail "a frame's parts are not what they say"
fi

echo "standard input"
scenes=$(dirname "$scene")
for name in mirrors cutaway; do # the latter's solids are not shared in memory
    "$raylane" render "$scenes/$name.json" -q -o one.pfm --size 90x60 --spp 1
    job 3 render - -o many.pfm --size 90x60 --spp 1 <"$scenes/$name.json" 2>err || fail "$name by -"
    same one.pfm many.pfm
done
"$raylane" render film.xyz -q --frames 2 -o one.pfm --size 90x60
job 2 render - --frames 2 -o many.pfm --size 90x60 <film.xyz 2>err || fail "a frame by -"
same one.pfm many.pfm
"$raylane" render film.xyz -q --frames 0: -o 'one%d.pfm' --size 40x30
job 2 render - --frames 0: -o 'many%d.pfm' --size 40x30 <film.xyz 2>err || fail "frames by -"
for frame in 0 1 2; do
    same one$frame.pfm many$frame.pfm
done
# Longer than one message from rank to rank.
python3 -c 'print(300000)
print()
for i in range(300000): print("C %.6f %.6f %.6f" % (i % 70, i // 70 % 70, i // 4900))' >many.xyz
"$raylane" render many.xyz -q --style points -o one.pfm --size 90x60 --spp 1
job 2 render - --style points -o many.pfm --size 90x60 --spp 1 <many.xyz 2>err || fail "many by -"
same one.pfm many.pfm

echo "rays"
python3 - <<'PYTHON'
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
    for ranks in $numbers; do
        # shellcheck disable=SC2086
        job $ranks trace "$scene" rays.npy -o many.npy $options 2>err || fail "trace $options"
        same one.npy many.npy
    done
done
"$raylane" trace "$scenes/cutaway.json" rays.npy -q -o one.npy
job 2 trace - rays.npy -o many.npy <"$scenes/cutaway.json" 2>err || fail "trace -"
same one.npy many.npy
job 2 trace "$scenes/cutaway.json" - -o many.npy <rays.npy 2>err || fail "trace by -"
same one.npy many.npy

echo "more answers than memory is taken for, of whom nobody reads them yet"
python3 - <<'PYTHON'
import random, struct
random.seed(7)
count, times = 100_000, 40
block = struct.pack("<%df" % (6 * count), *(random.uniform(-3, 3) for _ in range(6 * count)))
with open("many-rays.npy", "wb") as file:
    head = "{'descr': '<f4', 'fortran_order': False, 'shape': (%d, 6), }" % (times * count)
    head += " " * (63 - (10 + len(head)) % 64) + "\n"
    file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode())
    for _ in range(times):
        file.write(block)
PYTHON
mkfifo pipe
exec 3<>pipe # does not wait for another process
job 2 trace "$scene" many-rays.npy -o pipe --threads 2 2>err 3>&- &
has_bytes() { # pipe that is open as descriptor 3
    python3 -c 'import fcntl, struct, sys, termios
count = struct.unpack("i", fcntl.ioctl(3, termios.FIONREAD, bytes(4)))[0]
sys.exit(0 if count > 0 else 1)'
}
wait_until has_bytes || fail "no answer is written"
# Waits until no thread of the two ranks has work left: until two looks find the same memory in use, and between them
# each thread has slept throughout or has woken up three times.
timeout 600 python3 - "^$raylane trace $scene many-rays.npy" <<'PYTHON' || fail "ranks that nobody reads from do not come to rest"
import pathlib, subprocess, sys, time

def status(folder):
    return dict(line.split(":", 1) for line in (folder / "status").read_text().splitlines())

def look():
    found = subprocess.run(["pgrep", "-f", sys.argv[1]], stdout=subprocess.PIPE, text=True).stdout.split()
    ranks = [pathlib.Path("/proc", process) for process in found]
    threads = {}
    for task in (task for rank in ranks for task in (rank / "task").iterdir()):
        of_task = status(task)
        threads[task] = (of_task["State"].split()[0], int(of_task["voluntary_ctxt_switches"]))
    return [status(rank)["RssAnon"] for rank in ranks], threads

def is_rest(before, now):
    return before[0] == now[0] and before[1].keys() == now[1].keys() and all(
        before[1][task] == now[1][task] == ("S", switches) or switches >= before[1][task][1] + 3
        for task, (_, switches) in now[1].items())

looks = []
while not any(is_rest(before, looks[-1]) for before in looks[:-1]):
    time.sleep(0.1)
    try:
        looks.append(look())
    except OSError:  # a thread has ended
        pass
PYTHON
found=0
for process in $(pgrep -f "^$raylane trace $scene many-rays.npy"); do
    found=$((found + 1))
    kilobytes=$(awk '/^RssAnon:/ { print $2 }' "/proc/$process/status")
    [ "$kilobytes" -lt 61440 ] || fail "a rank keeps $kilobytes kB of 88 MB of answers"
done
[ "$found" -eq 2 ] || fail "$found ranks wait for a reader"
exec 4<pipe 3>&-
cat <&4 >many.npy
exec 4<&-
wait $! || fail "trace into a pipe"
"$raylane" trace "$scene" many-rays.npy -q -o one.npy
same one.npy many.npy
rm many-rays.npy one.npy many.npy

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
refused 2 "standard input: must be a scene or atoms, got an empty file" render - </dev/null
refused 2 "none.npy: no such file" trace "$scene" none.npy
refused 2 "err: must be an array in NumPy's format" trace "$scene" err

echo "what ends a rank loses no tile that was done"
begin() { # options of mpirun and a program, options of the rendering
    : >many.png.part # an existing journal is written from the first tile on
    # shellcheck disable=SC2086 # lists of options
    timeout 600 mpirun --oversubscribe -n 2 $1 "$raylane" render "$scene" -o many.png $2 >out 2>err 5>&- &
}
end_newest() { # signal
    pkill -"$1" -n -f "^$raylane render $scene -o many.png"
    status=0
    wait $! || status=$?
    [ "$status" -ne 0 ] || fail "$1 ends a rank, and the job with 0"
}
# Rank 0 is held at the third tile that it writes.
mkfifo hold
exec 5<>hold
begin "env LD_PRELOAD=$held_call RAYLANE_HOLD=pwrite:4:$folder/hold" "--size 600x600 --spp 16"
timeout 600 head -c 1 <&5 >held || fail "no tile is written"
end_newest KILL
exec 5>&-
"$raylane" render "$scene" -q -o one.png --size 600x600 --spp 16
job 2 render "$scene" -o many.png --size 600x600 --spp 16 2>err || fail "it does not go on"
grep -q "many.png.part: resumes at" err || fail "it has begun anew"
same one.png many.png
# A rendering of hours, in tiles of a second.
has_tiles() { # bytes
    [ "$(stat -c %s many.png.part)" -ge "$1" ]
}
begin "" "--size 600x600 --tile 8 --spp 65536"
wait_until has_tiles 2000 || fail "no tile is written"
end_newest TERM
has_tiles 2000 || fail "TERM has lost a tile"
