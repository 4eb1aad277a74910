#!/bin/sh
# Draws a picture, or the pictures of a film, by an array of Slurm jobs on hosts that share a folder:
#
#   slurm.sh N SCENE OUTPUT [OPTIONS...]
#       one picture in N parts, which are merged at the end; with --frames 7, of one frame of atoms
#   slurm.sh N --film SCENE OUTPUT-%05d.png --frames 0:100 [OPTIONS...]
#       several pictures, by --frames, --turn or --set, of which each job draws every N-th
#
# OPTIONS are those of render. Those of sbatch are set by its variables, such as SBATCH_PARTITION and
# SBATCH_TIMELIMIT. A job that Slurm is about to end, or that the failure of a host has ended, resumes where
# it was. After a failure, all jobs can be submitted again. With the same N, they resume; another N is
# possible, too. Parts are in the folder OUTPUT.parts, which is removed after the merge. RAYLANE names the
# program if it is not in PATH. Prints the number of the last job. Submits nothing if the program is missing
# or cannot read the scene.
set -eu

raylane=${RAYLANE:-raylane}

# In a job of the array: draws its share, and requeues the job if Slurm has ended it before.
if [ -n "${SLURM_ARRAY_TASK_ID:-}" ] && [ -n "${RAYLANE_FARM:-}" ]; then
    count=$1 what=$2 scene=$3 output=$4
    shift 4
    [ "$what" = film ] || output=$output.parts/$SLURM_ARRAY_TASK_ID-of-$count.exr
    code=0
    srun --ntasks=1 --kill-on-bad-exit=0 "$raylane" render "$scene" -o "$output" \
        --part "$SLURM_ARRAY_TASK_ID/$count" "$@" || code=$?
    if [ "$code" -eq 143 ]; then # SIGTERM
        scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
    fi
    exit "$code"
fi

# After all parts. The folder may also have parts of a failed farm with another N.
if [ "${RAYLANE_FARM:-}" = merge ]; then
    count=$2 output=$3
    set --
    for number in $(seq "$count"); do
        set -- "$@" "$output.parts/$number-of-$count.exr"
    done
    "$raylane" merge "$@" -o "$output"
    rm -r "$output.parts"
    exit
fi

usage() {
    sed -n '2,18s/^# \{0,1\}//p' "$0" >&2
    exit 2
}
[ $# -ge 3 ] || usage
case $1 in
'' | *[!0-9]* | 0*) usage ;;
esac
count=$1
shift
what=parts
if [ "$1" = --film ]; then
    what=film
    shift
fi
[ $# -ge 2 ] || usage
scene=$1 output=$2
shift 2

# Checks these now, or jobs would wait only to fail.
refuse() {
    echo "slurm.sh: $*" >&2
    exit 1
}
program=$(command -v "$raylane") || refuse "no program \"$raylane\" here: RAYLANE=FILE names it"
case $program in
/*) raylane=$program ;;
*) raylane=$PWD/$program ;;
esac
if [ ! -f "$scene" ] || [ ! -r "$scene" ]; then refuse "cannot read $scene"; fi
if [ "$(wc -c <"$scene")" -lt 100000000 ]; then # larger files take long
    "$raylane" info -q "$scene" >/dev/null || exit 1
fi

[ "$what" = film ] || mkdir -p "$output.parts"
submit() {
    sbatch --parsable --job-name="raylane $output" --output=/dev/null --error="$output.%j.log" "$@"
}
jobs=$(RAYLANE_FARM=draw RAYLANE=$raylane submit --array="1-$count" --requeue --signal=TERM@60 \
    --open-mode=append "$0" "$count" "$what" "$scene" "$output" "$@")
[ "$what" = parts ] || {
    echo "${jobs%%;*}"
    exit
}
last=$(RAYLANE_FARM=merge RAYLANE=$raylane submit --dependency="afterok:${jobs%%;*}" "$0" merge \
    "$count" "$output")
echo "${last%%;*}"
