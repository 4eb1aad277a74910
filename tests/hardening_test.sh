#!/bin/sh
# Checks that binaries are hardened as hardening.cmake requests: tests/hardening_test.sh FILE...
# They must be position-independent, with read-only relocations from the start, no executable stack,
# no memory that can be both written and executed, stack protectors, and calls of checked functions.
set -eu
failed=0
LC_ALL=C
export LC_ALL
lacks() { # file, fault
    echo "$1: $2"
    failed=1
}
for file in "$@"; do
    header=$(readelf -hW "$file")
    segments=$(readelf -lW "$file")
    dynamic=$(readelf -dW "$file")
    symbols=$(readelf --dyn-syms -W "$file")
    echo "$header" | grep -q 'Type: *DYN' || lacks "$file" "is not position-independent"
    echo "$segments" | grep -q '^ *GNU_RELRO' || lacks "$file" "has no relocations that become read-only"
    echo "$dynamic" | grep -qE 'BIND_NOW|FLAGS_1.*NOW' || lacks "$file" "relocates as it runs"
    echo "$segments" | grep -E '^ *GNU_STACK' | grep -qv 'E' || lacks "$file" "has a stack that can be executed"
    ! echo "$segments" | grep -qE '^ *LOAD .* RWE ' || lacks "$file" "has memory to be written and executed"
    paths='TEXTREL|RPATH|RUNPATH'
    case $file in *-mpi.so) paths=TEXTREL ;; esac # MPI may be anywhere, so that its module has a path
    ! echo "$dynamic" | grep -qE "$paths" || lacks "$file" "has a path of its own, or relocations of code"
    echo "$symbols" | grep -q '__stack_chk_fail' || lacks "$file" "has no stack protectors"
    case $file in *-window.so | *-mpi.so | *-annotation.so) continue ;; esac # these have no buffers
    echo "$symbols" | grep -qE ' __[a-z]+_chk(@|$)' || lacks "$file" "calls no checked functions"
done
exit $failed
