#!/bin/sh
# Measures raylane and each other installed ray tracer, alternating: the same scenes, rays and threads,
# medians of several runs. Prints one table.
#
#   bench/peers/run.sh [BUILD [FOLDER]]   BUILD: a Release build of raylane; default build/release.
#                                         FOLDER: the folder of peers.json, errors.json and the
#                                         scenes; default build/peers
#
# Peers:
# - Embree 3 or 4, if it was installed when raylane was configured (Debian's libembree-dev): several sets
#   of rays on 10 to 10,000,000 balls and on a lattice of 1,000,000 balls and sticks; building; two
#   threads; and whole images by raylane's wavefront with Embree's calls inside.
# - POV-Ray 3.7 and Tachyon 0.99 (Debian's povray and tachyon): whole processes that render whole images;
#   and the same with several settings of anti-aliasing, against the images' errors.
# Needs python3.
#
# Environment: QUICK=1 for a trial run of some minutes; SIZE of images in pixels (1024); ERROR_SIZE of
# images that are compared with converged ones (half of SIZE); REPETITIONS (5); THREADS of whole
# processes (1).
#
# Scenes: balls, rings and tree of the Standard Procedural Databases in ../shared/scenes, if that folder
# exists; a sphereflake of 66,430 balls and a lattice of 16 x 16 x 16, written by raylane convert; and a
# protein under one light and under a sky light. Only raylane and Tachyon render the protein under the sky
# light, because POV-Ray has no sky light. All programs get the properties that NFF can express. Tachyon's
# angle of view is always 53.13 degrees. The sphereflake, the lattice and the proteins have that angle.
# The other scenes have 45 degrees, so Tachyon shows a little more of them.
#
# Exit code 1: one of raylane's answers is wrong.
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build/release}
folder=${2:-build/peers}
if [ -n "${QUICK:-}" ]; then
    size=${SIZE:-128} repetitions=${REPETITIONS:-1} counts="10 1000" many=10000 some=1000
else
    size=${SIZE:-1024} repetitions=${REPETITIONS:-5} many=1000000 some=100000
    counts="10 100 1000 10000 100000 1000000 10000000"
fi

fail() {
    echo "run.sh: $*" >&2
    exit 2
}
for program in raylane raylane-peers; do
    [ -x "$build/bin/$program" ] ||
        fail "missing $build/bin/$program: build it with cmake --preset release"
done
command -v python3 >/dev/null || fail "missing python3"
for peer in povray tachyon; do
    command -v $peer >/dev/null || echo "$peer: not installed, left out"
done
mkdir -p "$folder/parts"
rm -f "$folder"/parts/*.json

# Scenes for whole images.
surroundings='"camera": {"from": [0, 2.6, 4.4], "at": [0, 1.1, 0], "field_of_view": 53.130102},
    "background": [0.5, 0.65, 0.85],
    "lights": [{"type": "point", "position": [-7, 12, 8], "color": [0.7, 0.7, 0.7]},
               {"type": "point", "position": [9, 4, 8], "color": [0.3, 0.3, 0.3]}],
    "materials": {"table": {"color": [0.7, 0.4, 0.3]},
                  "ball": {"color": [0.3, 0.3, 0.4], "specular": 0.7, "exponent": 50,
                           "reflectivity": 0.5}}'
table='{"type": "box", "material": "table", "min": [-3, -0.2, -3],
     "max": [3, 0, 3]}'
cat >"$folder/sphereflake-5.json" <<END
{
    $surroundings,
    "objects": [$table,
    {"type": "sphereflake", "material": "ball", "center": [0, 1.25, 0], "radius": 1, "depth": 5,
     "up": [0.1, 1, 0.3]}]
}
END
cat >"$folder/lattice-16.json" <<END
{
    $surroundings,
    "objects": [$table,
    {"type": "lattice", "material": "ball", "strut_material": "table", "corner": [-1.2, 0.1, -1.2],
     "n": 16, "spacing": 0.16, "sphere_radius": 0.045, "strut_radius": 0.012}]
}
END
# The protein under one light, for all programs, and under a sky light. Both have Tachyon's angle of view.
protein() { # lights
    sed -e '/"lights": \[/,/^    \],/d' -e "s/^    \"materials\"/    \"lights\": [$1],\n&/" \
        -e 's/"from": [^]]*\]/"from": [8.4, 12.3, 46.8]/' \
        -e 's/"field_of_view": 36/"field_of_view": 53.130102/' scenes/protein.json
}
lamp='{"type": "point", "position": [-60, 90, 70], "color": '
protein "${lamp}[1, 1, 1]}" >"$folder/protein.json"
protein "{\"type\": \"sky\", \"color\": [0.9, 0.9, 0.9]}, ${lamp}[0.3, 0.3, 0.3]}" >"$folder/protein-sky.json"
"$build/bin/raylane" convert "$folder/protein-sky.json" "$folder/protein-sky.nff" 2>/dev/null
for scene in sphereflake-5 lattice-16 protein; do
    "$build/bin/raylane" convert "$folder/$scene.json" "$folder/$scene.nff" 2>/dev/null
    "$build/bin/raylane" convert "$folder/$scene.nff" "$folder/$scene.pov" 2>/dev/null
done
for file in ../shared/scenes/*.pov ../shared/scenes/*.nff; do
    [ ! -f "$file" ] || cp "$file" "$folder"
done
picture=$folder/sphereflake-5.nff
[ ! -f "$folder/balls.nff" ] || picture=$folder/balls.nff

number=10
measure() { # arguments of raylane-peers; table.py reports its exit code 1
    number=$((number + 1))
    "$build/bin/raylane-peers" "$@" --size "$size" --repetitions "$repetitions" \
        --json "$folder/parts/$number.json" || [ $? -eq 1 ]
}
scenes=
for count in $counts; do
    scenes="$scenes spheres/$count"
done
all="camera scanlines mirror diffuse diffuse-2 shadow sky ambient random occlusion"
# shellcheck disable=SC2086 # lists of words
{
    measure $scenes sticks/$many "$picture" --rays $all
    measure spheres/$some spheres/$many sticks/$many --rays build
    measure spheres/10000 spheres/$some --rays crossings
    if grep -q avx512dq /proc/cpuinfo; then
        measure spheres/$some spheres/$many sticks/$many --rays $all --isa avx2
    fi
    measure spheres/$many sticks/$many --rays $all --threads 2
    measure "$picture" --rays picture
    measure "$picture" --rays picture --threads 2
}
python3 bench/peers/pictures.py "$folder/parts/pictures.json" "$build/bin/raylane" "$folder" \
    "$size" "${THREADS:-1}" "$repetitions"
python3 bench/peers/errors.py "$folder/errors.json" "$build" "$folder" \
    "${ERROR_SIZE:-$((size / 2))}" "${THREADS:-1}" 1 lattice-16 sphereflake-5 protein protein-sky
python3 bench/peers/table.py "$folder/peers.json" "$build" "$folder"/parts/*.json
