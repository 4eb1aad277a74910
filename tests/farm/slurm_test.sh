#!/bin/sh
# Tests scenes/farm/slurm.sh on a Slurm of one node that it starts. Parts of an image give the whole
# image; frames by jobs are those of one process; a job that Slurm ends is resumed. Before that,
# tests the script with stand-ins (again_test.sh).
#
#   slurm_test.sh RAYLANE SCENE    as root; exit code 77 without Slurm (Debian: slurm-wlm, munge)
set -eu

. "$(dirname "$0")/../wait.sh"
raylane=$(realpath "$1")
scene=$(realpath "$2")
script=$(realpath "$(dirname "$0")/../../scenes/farm/slurm.sh")
"$(dirname "$0")/again_test.sh" "$raylane" "$scene"
for program in slurmctld slurmd munged sbatch; do
    command -v $program >/dev/null || exit 77
done
[ "$(id -u)" -eq 0 ] || exit 77
folder=$(mktemp -d)
started=
end() {
    # shellcheck disable=SC2086 # a list of words
    [ -z "$started" ] || kill $started 2>/dev/null || true
    wait
    rm -rf "$folder"
}
trap end EXIT
cd "$folder"
chmod 755 .
fail() {
    echo "$*"
    cat ./*.log 2>/dev/null | tail -n 60
    exit 1
}

host=$(hostname -s)
head -c 1024 /dev/urandom >munge.key
chown munge: munge.key . && chmod 400 munge.key
mkdir munge && chown munge: munge
setpriv --reuid=munge --regid=munge --clear-groups munged --foreground --force \
    --key-file="$folder/munge.key" --socket="$folder/munge/socket" --pid-file="$folder/munge/pid" \
    --seed-file="$folder/munge/seed" --log-file="$folder/munge/log" >munged.log 2>&1 &
started="$!"
chown root: . && mkdir state spool
cat >slurm.conf <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
AuthInfo=socket=$folder/munge/socket
AuthType=auth/munge
CryptoType=crypto/munge
SlurmUser=root
SlurmctldPort=6917
SlurmdPort=6918
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,requeue_setup_env_fail
MinJobAge=300
KillWait=10
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=60 State=UP
END
export SLURM_CONF="$folder/slurm.conf"
wait_until [ -S munge/socket ] || fail "munge does not start"
slurmctld -D -i >ctld.out 2>&1 &
started="$started $!"
slurmd -D -N "$host" >slurmd.out 2>&1 &
started="$started $!"
is_idle() {
    [ "$(sinfo -h -o %t 2>/dev/null)" = idle ]
}
wait_until is_idle || fail "Slurm does not start"

export RAYLANE="$raylane"
has_ended() { # job
    state=$(scontrol show job "$1" | sed -n 's/.*JobState=\([A-Z]*\).*/\1/p' | sort -u | tr '\n' ' ')
    case $state in
    'COMPLETED ') return 0 ;;
    *FAILED* | *CANCELLED* | *TIMEOUT*) fail "job $1: $state" ;;
    esac
    return 1
}
wait_for() { # job
    wait_until has_ended "$1" || wait_until has_ended "$1" || fail "job $1 does not end: $state"
}

echo "a picture in four parts"
"$raylane" render "$scene" -q -o one.png --size 150x90
wait_for "$("$script" 4 "$scene" many.png --size 150x90)"
cmp one.png many.png
[ ! -e many.png.parts ] || fail "parts are left"

echo "frames by three jobs"
for frame in 0 1 2 3 4; do
    printf '2\n\nC 0 0 0\nO 0 0 %s\n' "1.$frame"
done >film.xyz
"$raylane" render film.xyz -q --frames 0:5 -o 'one%d.png' --size 40x30
wait_for "$("$script" 3 --film film.xyz 'many%d.png' --frames 0:5 --size 40x30)"
for frame in 0 1 2 3 4; do
    cmp one$frame.png many$frame.png
done

echo "a job that is ended goes on"
has_begun_or_ended() {
    [ -e many.png.parts/1-of-2.exr.part ] || [ -e many.png ]
}
for samples in 484 1936 7744 30976; do # more on a machine where the job ends before its first checkpoint
    rm -rf many.png many.png.*
    big="--size 400x400 --spp $samples"
    # shellcheck disable=SC2086 # a list of options
    last=$("$script" 2 "$scene" many.png $big)
    wait_until has_begun_or_ended || fail "no journal is begun"
    [ ! -e many.png.parts/1-of-2.exr.part ] || break
done
[ -e many.png.parts/1-of-2.exr.part ] || fail "it was too fast to be ended"
task=$(squeue -h -r -t RUNNING -o '%K %i' | sed -n 's/^1 //p')
scancel --signal=TERM "$task"
says_how_to_go_on() {
    grep -qhs "the same command resumes" many.png.*.log
}
wait_until says_how_to_go_on || fail "the job does not end"
# Slurm itself starts a requeued job only after two minutes.
begins_again() {
    scontrol show job "$task" | grep -q JobState=PENDING && scontrol update "JobId=$task" StartTime=now
}
wait_until begins_again || fail "the job is not put back"
wait_for "$last"
# shellcheck disable=SC2086 # a list of options
"$raylane" render "$scene" -q -o one.png $big
cmp one.png many.png
grep -qh "resumes at" many.png.*.log || fail "it has begun anew"
