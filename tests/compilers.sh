#!/bin/sh
# Checks the sources with every installed compiler from the oldest supported version on, as C++20
# and as C++23: no errors and no warnings. Makes no objects. Takes half an hour of one core for
# each, an hour with the tests.
#
#   tests/compilers.sh                        all compilers
#   tests/compilers.sh clang++-19/23 ...      these compilers, each with its standard
#   FILES='scenes/*' tests/compilers.sh       these sources only
#   TESTS=ON tests/compilers.sh               tests, too
#   STANDARDS=23 tests/compilers.sh           one standard
set -eu
cd "$(dirname "$0")/.."

if [ $# -eq 0 ]; then
    for compiler in g++-12 g++-13 g++-14 g++-15 clang++-14 clang++-15 clang++-16 clang++-17 clang++-18 clang++-19; do
        command -v "$compiler" >/dev/null || continue
        for standard in ${STANDARDS-20 23}; do
            set -- "$@" "$compiler/$standard"
        done
    done
fi
[ $# -gt 0 ] || { echo "no compiler of the list is here"; exit 1; }

look() { # compiler, standard
    folder=build/compilers/$1-$2
    mkdir -p "$folder"
    cmake --fresh --preset release -B "$folder" -DCMAKE_CXX_COMPILER="$1" -DCMAKE_CXX_STANDARD="$2" \
        -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DRAYLANE_UNITY=OFF -DRAYLANE_BENCHMARKS=OFF -DRAYLANE_TESTS="${TESTS-OFF}" \
        >"$folder/configure.log" 2>&1 || { cat "$folder/configure.log"; return 1; }
    # The compiler's command without its output.
    python3 - "$folder/compile_commands.json" "$PWD/${FILES-*}" <<'PY' |
import fnmatch, json, re, sys
for each in json.load(open(sys.argv[1])):
    if fnmatch.fnmatch(each["file"], sys.argv[2]):
        print("cd", each["directory"], "&&", re.sub(r" -o \S+ -c ", " -fsyntax-only ", each["command"]))
PY
        xargs -P "$(nproc)" -d '\n' -n 1 sh -c >"$folder/log" 2>&1 || { cat "$folder/log"; return 1; }
}
failed=
for each in "$@"; do
    started=$(date +%s)
    if look "${each%/*}" "${each#*/}"; then
        echo "${each%/*}, C++${each#*/}: nothing to say in $(($(date +%s) - started)) s"
    else
        failed="$failed $each"
    fi
done
[ -z "$failed" ] || { echo "not accepted:$failed"; exit 1; }
