#!/bin/sh
# Draws speed against accuracy from raylane-bench, in two figures:
# - solvers: one panel per shape, one mark per precision (and for Embree, if raylane-bench was built
#   with it);
# - whole images: seconds against their difference from converged ones.
# With PEERS, draws the measurements of bench/peers/run.sh instead: rays per second against the number
# of shapes, beside Embree's; and seconds for images against their errors, beside POV-Ray's and
# Tachyon's.
#
#   bench/chart.sh [BUILD [FOLDER]]   BUILD: a Release build with raylane-bench; default
#                                     build/release. FOLDER: where chart.svg, chart.png,
#                                     pictures.svg, pictures.png and chart.json go, or peers.svg,
#                                     peers.png, errors.svg and errors.png; default build/chart
#
# Environment: ISA (default: the first of avx512, avx2 and sse4.2 that the processor has); RAYS, random
# or hard (random); REPETITIONS of each measurement (5), of which the median counts; JSON, a file to
# draw instead of measuring; PEERS, a peers.json, to draw only that and an errors.json beside it.
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
    command -v $program >/dev/null || fail "no $program here; see Debian's gnuplot-nox and python3"
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
    draw peers 1200,480 "$PEERS" peers
    errors=$(dirname "$PEERS")/errors.json
    [ ! -f "$errors" ] || draw errors 1100,760 "$errors" errors
    exit
fi

if [ -z "${ISA:-}" ]; then
    ISA=sse4.2
    for flag in avx2:avx2 avx512dq:avx512; do
        if grep -q "${flag%:*}" /proc/cpuinfo; then ISA=${flag#*:}; fi
    done
fi
json=${JSON:-$folder/chart.json}
if [ -z "${JSON:-}" ]; then
    [ -x "$build/bin/raylane-bench" ] ||
        fail "no $build/bin/raylane-bench; cmake --preset release leads to one"
    "$build/bin/raylane-bench" --benchmark_filter="^methods/.*/$rays/.*/$ISA\$|^picture/" \
        --benchmark_repetitions="$repetitions" --benchmark_enable_random_interleaving=true \
        --benchmark_min_time=0.05 --benchmark_out="$json" --benchmark_out_format=json >/dev/null
fi

draw chart 1200,860 "$json" methods "$rays" "$ISA"
draw pictures 1200,760 "$json" pictures
