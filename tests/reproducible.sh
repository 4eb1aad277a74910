#!/bin/sh
# Builds the project in two folders and checks that both give the same bytes: libraries, the tool,
# its manual, and packages. Takes an hour of one core.
#
#   tests/reproducible.sh                  everything
#   KERNELS=BUILD tests/reproducible.sh    everything but the kernels, which are those of that build
#   tests/reproducible.sh kernels          the kernels only
#   tests/reproducible.sh quick            a few objects, with debugging information, which has paths
set -eu
cd "$(dirname "$0")/.."
project=$PWD
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
first=$room/first
second="$room/a longer path/second"
quietly() { # command...: prints its output if it fails
    "$@" >"$room/log" 2>&1 || {
        cat "$room/log"
        exit 1
    }
}
lay() { # folder: copies the source as it is here, with new times
    mkdir -p "$1"
    git ls-files --cached --others --exclude-standard | while read -r file; do
        [ ! -e "$file" ] || echo "$file"
    done | tar -cf - -T - | tar -xmf - -C "$1"
    [ ! -d build/pages ] || { mkdir -p "$1/build" && cp -r build/pages "$1/build/"; }
}
# The time of the commit, which a folder without git does not know.
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
export SOURCE_DATE_EPOCH
lay "$first"
sleep 2 # archives round times to two seconds; load changes nothing
lay "$second"
# A cache would give the first folder's objects to the second.
options="-GNinja -DRAYLANE_CCACHE=OFF -DRAYLANE_TESTS=OFF -DRAYLANE_BENCHMARKS=OFF -DCMAKE_INSTALL_PREFIX=/usr"
[ -z "${KERNELS-}" ] || options="$options -DRAYLANE_KERNELS=$(realpath "$KERNELS")"

if [ "${1-}" = quick ]; then
    options="$options -DCMAKE_BUILD_TYPE=RelWithDebInfo -DRAYLANE_UNITY=OFF"
    # Objects of each floor of the library.
    set -- core/CMakeFiles/raylane_core.dir/numbers/dyadic.cpp.o \
        core/CMakeFiles/raylane_core.dir/scene/glass.cpp.o \
        scenes/CMakeFiles/raylane_scenes.dir/formats/format.cpp.o \
        scenes/api/cpp/CMakeFiles/raylane_api.dir/version.cpp.o
    build() { quietly cmake --build build/own --target "$@"; }
elif [ "${1-}" = kernels ]; then
    set --
    for isa in sse42 avx2 avx512; do
        for unit in "$project"/simd/units/*.cpp; do
            name=$(basename "$unit" .cpp)
            [ "$name" != kernels ] || continue # no kernel: chooses among them
            set -- "$@" "simd/CMakeFiles/raylane_simd-$name-$isa.dir/units/$name.cpp.o"
        done
    done
    build() { quietly cmake --build build/own --target "$@"; }
else
    set -- bin/raylane bin/raylane-window.so scenes/api/cpp/libraylane.a scenes/api/cpp/libraylane_trace.a \
        scenes/tool/manual/raylane-render.1 scenes/tool/completions/raylane
    build() {
        quietly cmake --build build/own
        quietly sh -c "cd build/own && cpack -G DEB"
    }
fi
for folder in "$first" "$second"; do
    cd "$folder"
    # shellcheck disable=SC2086 # a list of words
    quietly cmake -S . -B build/own $options
    build "$@"
done
failed=0
compare() { # files of build/own...
    for file in "$@"; do
        if ! cmp "$first/build/own/$file" "$second/build/own/$file"; then
            failed=1
        elif grep -qF "$room" "$first/build/own/$file"; then
            echo "$file: tells where it was built"
            failed=1
        else
            echo "$file: $(sha256sum <"$first/build/own/$file" | cut -c1-16)"
        fi
    done
}
compare "$@"
if [ -d "$first/build/own/packages" ]; then
    cd "$first/build/own"
    compare packages/*.deb
fi
cd "$project"
exit $failed
