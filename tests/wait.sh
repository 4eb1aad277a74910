# shellcheck shell=sh
# For scripts to source: a way to wait for an event.

# Waits until a command succeeds, which is tried ten times a second. Returns 1 after ten minutes: that ends a
# test that hangs, and decides nothing else.
wait_until() { # command...
    tries=0
    until "$@"; do
        tries=$((tries + 1))
        [ "$tries" -lt 6000 ] || return 1
        sleep 0.1
    done
}
