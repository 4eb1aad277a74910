#!/bin/sh
# Measures raylane beside each other ray tracer that is found here, in turn: whole pictures of the
# same scenes, whole processes, medians of several runs.
#
#   bench/peers/run.sh [BUILD [FOLDER]]   BUILD: a Release build of raylane; default build/release.
#                                         FOLDER: where peers.json and the scenes go; default
#                                         build/peers
#
# Environment: SIZE, pixels a side (1024); THREADS (1); REPETITIONS (5). Peers: POV-Ray 3.7 and
# Tachyon 0.99 (Debian's packages povray and tachyon). It wants python3.
#
# The scenes are those of the Standard Procedural Databases in ../shared/scenes, where that is, and
# raylane's own sphereflake and lattice, as raylane convert writes them.
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build/release}
folder=${2:-build/peers}

fail() {
    echo "run.sh: $*" >&2
    exit 2
}
[ -x "$build/bin/raylane" ] || fail "no $build/bin/raylane; cmake --preset release leads to one"
command -v python3 >/dev/null || fail "no python3 here"
mkdir -p "$folder"
for scene in sphereflake lattice; do
    for format in pov nff; do
        "$build/bin/raylane" convert scenes/$scene.json "$folder/$scene.$format" 2>/dev/null
    done
done
for file in ../shared/scenes/*.pov ../shared/scenes/*.nff; do
    [ ! -f "$file" ] || cp "$file" "$folder"
done
exec python3 bench/peers/pictures.py "$build/bin/raylane" "$folder" "${SIZE:-1024}" \
    "${THREADS:-1}" "${REPETITIONS:-5}"
