#!/bin/sh
# An inline function that a kernel unit shares with the rest of the program may be the copy that the
# linker keeps for all, with instructions that an older processor does not have. So each symbol that
# the linker may merge must carry the unit's instruction set in its name.
#
# usage: symbols_test.sh OBJECT...
set -eu
units=0
for object in "$@"; do
    case "$object" in
    *-portable.dir/*) tag='Portable\|3IsaE0E' ;;
    *-sse42.dir/*) tag='6sse4_2\|3IsaE1E' ;;
    *-avx2.dir/*) tag='4fma3I\|3IsaE2E' ;;
    *-avx512.dir/*) tag='7avx512f\|3IsaE3E' ;;
    *-neon.dir/*) tag='6neon64\|3IsaE4E' ;;
    *) echo "$object: no unit of an instruction set"; exit 1 ;;
    esac
    units=$((units + 1))
    shared=$(nm "$object" | awk '$(NF - 1) ~ /^[WVu]$/ { print $NF }' | grep -v -e "$tag" -e '^DW.ref.' || true)
    if [ -n "$shared" ]; then
        echo "$object shares with others:"
        echo "$shared" | c++filt
        exit 1
    fi
done
[ "$units" -ge 2 ] || { echo "expected 2 kernel units or more, got $units"; exit 1; }
