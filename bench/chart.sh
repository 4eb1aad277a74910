#!/bin/sh
# Draws speed against error from raylane-bench, in two figures:
# - chart: one panel per shape, one mark per precision and instruction set, and Embree's marks if
#   raylane-bench was built with it;
# - pictures: time of whole images against their difference from converged ones.
# With PEERS, draws the measurements of bench/peers/run.sh instead:
# - peers: rays per second of raylane and Embree against the number of spheres;
# - errors: time of whole programs against the error of their images, for raylane, POV-Ray and Tachyon.
# The small print has the processor, instruction sets, versions and date of the measurements.
#
#   bench/chart.sh [BUILD [FOLDER]]   BUILD: a Release build with raylane-bench; default
#                                     build/release. FOLDER: where chart.svg, chart.png,
#                                     pictures.svg, pictures.png and chart.json go, or peers.svg,
#                                     peers.png, errors.svg and errors.png; default build/chart
#
# Environment: ISA, one or two of avx512, avx2, sse4.2, neon and portable (default: "avx512 avx2" if both
# are available, otherwise the widest); RAYS, random or hard (random); REPETITIONS of each measurement
# (5), of which the median counts; JSON, a file to draw instead of measuring; PEERS, a peers.json, to
# draw only that and an errors.json beside it.
# Needs gnuplot and python3 (Debian's packages gnuplot-nox and python3).
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
folder=${2:-build/chart}
rays=${RAYS:-random}
repetitions=${REPETITIONS:-5}

fail() {
    echo "chart.sh: $*" >&2
    exit 2
}
for program in gnuplot python3; do
    command -v $program >/dev/null || fail "missing $program: install Debian's packages gnuplot-nox and python3"
done
mkdir -p "$folder"

draw() { # figure, size, arguments of chart.py
    figure=$1 size=$2
    shift 2
    for terminal in "svg size $size background '#ffffff' font 'sans,11'" \
        "pngcairo size $size font 'sans,11'"; do
        case $terminal in svg*) ending=svg ;; *) ending=png ;; esac
        {
            printf "set terminal %s\nset output '%s'\n" "$terminal" "$folder/$figure.$ending"
            python3 bench/chart.py "$@"
        } | gnuplot
        echo "$folder/$figure.$ending"
    done
}
if [ -n "${PEERS:-}" ]; then
    draw peers 1500,540 "$PEERS" peers
    errors=$(dirname "$PEERS")/errors.json
    [ ! -f "$errors" ] || draw errors 1100,800 "$errors" errors
    exit
fi

json=${JSON:-$folder/chart.json}
if [ -z "${JSON:-}" ]; then
    [ -x "$build/bin/raylane-bench" ] ||
        fail "missing $build/bin/raylane-bench: build it with cmake --preset release"
    available=$("$build/bin/raylane-bench" --benchmark_list_tests=true \
        --benchmark_filter='^methods/sphere/random/exact/')
    widest=
    for isa in portable neon sse4.2 avx2 avx512; do
        case $available in *"/$isa"*) widest=$isa ;; esac
    done
    isas=${ISA:-$widest}
    if [ "$isas" = avx512 ] && [ -z "${ISA:-}" ]; then
        case $available in *"/avx2"*) isas="avx512 avx2" ;; esac
    fi
    isas_pattern=$(echo "$isas" | sed 's/  */|/g')
    "$build/bin/raylane-bench" --benchmark_filter="^methods/.*/$rays/.*/($isas_pattern)\$|^picture/" \
        --benchmark_context="$(python3 bench/machine.py "$build"),isa=$widest" \
        --benchmark_repetitions="$repetitions" --benchmark_enable_random_interleaving=true \
        --benchmark_min_time=0.05 --benchmark_out="$json" --benchmark_out_format=json >/dev/null
fi

# shellcheck disable=SC2086 # a list of words
draw chart 1200,940 "$json" methods "$rays" ${ISA:-}
draw pictures 1200,800 "$json" pictures
