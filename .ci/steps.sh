# Steps with time budgets, for the scripts of this folder to source.
#
# `step SECONDS NAME` begins a step and ends the previous one; `step` alone ends the last one. A step that
# fails ends the run at once. A step that took more than twice its budget fails the run at its end: budgets
# are for two idle cores without a compiler cache (in the bare root: with one), and other machines differ. A step
# that has called `skipped` is marked. After `fails`, the run goes on, and fails at its end.

cd "$(dirname "$0")/.."
steps=$(mktemp)
results=$(mktemp -d)
trap 'rm -rf "$steps" "$results"' EXIT
started=$(date +%s)
name=
step() {
    now=$(date +%s)
    if [ -n "$name" ]; then
        took=$((now - began))
        late=
        [ "$took" -le $((2 * budget)) ] || late="  more than twice its budget"
        printf '%5d s of %5d  %s%s%s\n' "$took" "$budget" "$name" "$(cat "$results/mark")" "$late" | tee -a "$steps"
    fi
    if [ $# -eq 0 ]; then
        total=$(($(date +%s) - started))
        printf '\n'
        cat "$steps"
        printf '%5d s in all\n' "$total"
        ! grep -q '  \(failed\|more than twice its budget\)$' "$steps" || exit 1
        return
    fi
    budget=$1
    name=$2
    began=$now
    : >"$results/mark"
    printf '\n== %s\n' "$name"
}
skipped() { # why
    printf '  skipped: %s' "$1" >"$results/mark"
}
fails() {
    printf '  failed' >>"$results/mark"
}
may_skip() { # command...: exit code 77 if it cannot run here
    "$@" || { [ $? -eq 77 ] && skipped "it cannot run here"; }
}
slowest() { # build: lists the slowest tests of the last run of ctest
    echo "the twenty slowest tests, in seconds:"
    awk '/^[0-9]+\/[0-9]+ Testing: / { sub(/^.* Testing: /, ""); test = $0 }
        /^Test time = / { printf "%7.2f  %s\n", $4, test }' \
        "build/$1/Testing/Temporary/LastTest.log" | sort -rn | head -n 20
}
. tests/have.sh
