#!/bin/sh
# peers_test.sh RAYLANE-PEERS FOLDER: tests short measurements and exit codes.
set -eu
peers=$1
cd "$2"

fail() {
    echo "peers_test.sh: $*" >&2
    exit 1
}

"$peers" spheres/100 sticks/100 --size 32 --repetitions 1 --threads 2 --json peers.json \
    --rays camera scanlines mirror shadow diffuse random occlusion crossings build picture ||
    fail "raylane is wrong, or fails: $?"
for row in camera scanlines mirror shadow diffuse random occlusion crossings build picture; do
    grep -q "\"what\": \"$row\"" peers.json || fail "no $row in peers.json"
done

refuses() { # code, arguments: must fail in one line
    code=$1
    shift
    "$peers" "$@" >/dev/null 2>message && fail "accepts $*"
    [ $? -eq "$code" ] || fail "not exit code $code: $*"
    [ "$(wc -l <message)" -eq 1 ] || fail "not one line: $(cat message)"
}
refuses 2 spheres/0
refuses 2 no-such-scene.json
refuses 2 spheres/10 --rays sideways
refuses 2 spheres/10 --isa z80
refuses 2 spheres/10 --size 0
refuses 2 spheres/10 --threads none
refuses 2 --nonsense
refuses 3 spheres/10 --size 8 --repetitions 1 --json no-such-folder/peers.json
