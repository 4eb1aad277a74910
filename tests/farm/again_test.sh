#!/bin/sh
# Tests scenes/farm/slurm.sh with stand-ins for Slurm's programs, which run a job when it is
# submitted. After a job has failed, all can be submitted again, with the same number of parts or
# another. A scene that cannot be rendered is not submitted.
#
#   again_test.sh RAYLANE SCENE
set -eu

raylane=$(realpath "$1")
scene=$(realpath "$2")
script=$(realpath "$(dirname "$0")/../../scenes/farm/slurm.sh")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() {
    echo "$*"
    cat jobs.log
    exit 1
}

mkdir bin
# If a job of an array fails, jobs that wait for the array do not begin. FAILS is the number of the
# job that fails.
cat >bin/sbatch <<'END'
#!/bin/sh
tasks= waits=
while :; do
    case $1 in
    --array=1-*) tasks=${1#--array=1-} ;;
    --dependency=afterok:*) waits=1 ;;
    --*) ;;
    *) break ;;
    esac
    shift
done
echo 7
exec >>jobs.log 2>&1
if [ -z "$tasks" ]; then
    if [ -n "$waits" ] && [ -e failed ]; then exit 0; fi
    exec "$@"
fi
rm -f failed
for task in $(seq "$tasks"); do
    if [ "$task" = "$FAILS" ]; then
        touch failed
    else
        SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=$task "$@" || touch failed
    fi
done
END
cat >bin/srun <<'END'
#!/bin/sh
while :; do
    case $1 in
    --*) shift ;;
    *) exec "$@" ;;
    esac
done
END
chmod +x bin/sbatch bin/srun
export PATH="$folder/bin:$PATH" RAYLANE="$raylane"
submit() { # the number of the job that fails or 0, arguments...
    export FAILS="$1"
    shift
    [ "$("$script" "$@")" = 7 ] || fail "slurm.sh $* has submitted nothing"
}

echo "with another number of parts"
"$raylane" render "$scene" -q -o one.png --size 150x90
submit 2 3 "$scene" many.png --size 150x90
if [ -e many.png ] || [ ! -e many.png.parts ]; then fail "no part has failed"; fi
submit 0 2 "$scene" many.png --size 150x90
cmp one.png many.png || fail "it is another picture"
[ ! -e many.png.parts ] || fail "parts are left"

echo "with the same, for another picture"
submit 1 3 "$scene" many.png --size 150x90
"$raylane" render "$scene" -q -o one.png --size 90x60
submit 0 3 "$scene" many.png --size 90x60
cmp one.png many.png || fail "it is another picture"

echo "one frame of several"
for frame in 0 1 2; do
    printf '2\n\nC 0 0 0\nO 0 0 %s\n' "1.$frame"
done >film.xyz
"$raylane" render film.xyz -q --frames 2 -o one.png --size 90x60
submit 0 3 film.xyz frame.png --frames 2 --size 90x60
cmp one.png frame.png || fail "it is another frame"

echo "frames, by several jobs"
"$raylane" render film.xyz -q --frames : -o 'one%d.png' --size 90x60
submit 0 2 --film film.xyz 'frame%d.png' --frames : --size 90x60
for frame in 0 1 2; do
    cmp one$frame.png frame$frame.png || fail "it is another frame"
done

echo "what could not be drawn is not submitted"
export FAILS=0
refused() { # expected message, RAYLANE, arguments...
    said=$1 program=$2
    shift 2
    if RAYLANE=$program "$script" "$@" >told 2>&1; then fail "slurm.sh $* has submitted something"; fi
    if [ "$(wc -l <told)" -ne 1 ] || ! grep -qF "$said" told; then fail "it says $(cat told), not $said"; fi
    [ ! -e none.png.parts ] || fail "there are parts of what is not drawn"
}
echo '{' >bad.json
refused 'no program "raylane-elsewhere"' raylane-elsewhere 2 "$scene" none.png
refused 'no program "./raylane"' ./raylane 2 "$scene" none.png
refused 'cannot read missing.json' "$raylane" 2 missing.json none.png
refused 'bad.json:2:1' "$raylane" 2 bad.json none.png
refused 'bad.json:2:1' "$raylane" 2 --film bad.json 'none%d.png' --set x=0:1

echo "a program beside, and one in PATH"
ln -s "$raylane" raylane
ln -s "$raylane" bin/raylane
for program in ./raylane raylane; do
    rm -f one.png
    [ "$(RAYLANE=$program "$script" 2 "$scene" one.png --size 90x60)" = 7 ] || fail "$program is not found"
    cmp one.png many.png || fail "it is another picture"
done
