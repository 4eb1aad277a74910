#!/bin/sh
# An inline function that a kernel unit shares with the rest of the program may be the copy that the
# linker keeps for all, with instructions that an older processor does not have. So each symbol that
# the linker may merge must carry the unit's instruction set in its name.
#
# usage: symbols_test.sh OBJECT...
# Those not called *_portable, *_sse42, *_avx2, *_avx512 or *_neon are passed over.
set -eu
units=0
for object in "$@"; do
    case "$object" in
    *_portable.cpp*) tag=Portable ;;
    *_sse42.cpp*) tag=6sse4_2 ;;
    *_avx2.cpp*) tag=4fma3I ;;
    *_avx512.cpp*) tag=7avx512f ;;
    *_neon.cpp*) tag=6neon64 ;;
    *) continue ;;
    esac
    units=$((units + 1))
    shared=$(nm "$object" | awk '$(NF - 1) ~ /^[WVu]$/ { print $NF }' | grep -v -e "$tag" -e '^DW.ref.' || true)
    if [ -n "$shared" ]; then
        echo "$object shares with others:"
        echo "$shared" | c++filt
        exit 1
    fi
done
[ "$units" -ge 4 ] || { echo "expected 4 kernel units or more, got $units"; exit 1; }
