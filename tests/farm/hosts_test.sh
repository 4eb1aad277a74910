#!/bin/sh
# Ranks on two hosts that share no memory must render the image of one process, even if the wire
# between them takes 5 ms and loses a hundredth of the packets. The hosts are network namespaces.
#
#   hosts_test.sh RAYLANE SCENE    as root; exit code 77 without root or MPI
set -eu

. "$(dirname "$0")/../wait.sh"
raylane=$(realpath "$1")
scene=$(realpath "$2")
wire=$(realpath "$(dirname "$0")/wire.py")
command -v mpirun >/dev/null || exit 77
[ -e "$(dirname "$raylane")/raylane-mpi.so" ] || exit 77
if [ "$(id -u)" -ne 0 ] || [ ! -e /dev/net/tun ]; then exit 77; fi
one=raylane-one two=raylane-two
ip netns add $one 2>/dev/null && ip netns add $two 2>/dev/null || exit 77
folder=$(mktemp -d)
relay=
end() {
    [ -z "$relay" ] || kill "$relay" 2>/dev/null || true
    ip netns delete $one
    ip netns delete $two
    rm -rf "$folder"
}
trap end EXIT
cd "$folder"
# Replaces ssh: sets the host's name, which identifies a host to MPI, and runs a command.
cat >agent <<'END'
#!/bin/sh
host=raylane-two
[ "$1" != 10.77.0.1 ] || host=raylane-one
shift
exec ip netns exec $host unshare --uts sh -c "hostname $host; $*"
END
chmod +x agent
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
on_both() {
    ./agent 10.77.0.1 timeout 600 mpirun --host 10.77.0.1:2,10.77.0.2:2 \
        --mca plm_rsh_agent "$folder/agent" --mca btl_tcp_if_include 10.77.0.0/24 \
        --mca oob_tcp_if_include 10.77.0.0/24 "$raylane" "$@"
}

is_ready_or_gone() {
    grep -q ready wire.out || ! kill -0 "$relay"
}

for conditions in "0.1 0" "5 0.01"; do
    : >wire.out # without the last relay's output
    # shellcheck disable=SC2086 # milliseconds and loss
    "$wire" $one 10.77.0.1/24 $two 10.77.0.2/24 $conditions >>wire.out &
    relay=$!
    wait_until is_ready_or_gone
    grep -q ready wire.out
    rm -f ./*.png
    "$raylane" render "$scene" -q -o one.png --size 400x300
    start=$(date +%s%N)
    on_both render "$scene" -o two.png --size 400x300
    echo "milliseconds and loss $conditions: $((($(date +%s%N) - start) / 1000000)) ms"
    cmp one.png two.png
    "$raylane" render "$scene" -q -o one.pfm --size 90x60
    on_both render - -o two.pfm --size 90x60 <"$scene"
    cmp one.pfm two.pfm
    on_both render "$scene" -o 'film%d.png' --turn 360/5 --size 40x30
    [ -e film0.png ] && [ -e film4.png ]
    kill "$relay"
    wait "$relay" 2>/dev/null || true
    relay=
done
