#!/bin/sh
# Draws speed against accuracy, one panel per shape and one mark per precision, from raylane-bench.
#
#   bench/chart.sh [BUILD [FOLDER]]   BUILD: a Release build with raylane-bench; default
#                                     build/release. FOLDER: where chart.svg, chart.png and
#                                     chart.json go; default build/chart
#
# Environment: ISA (avx512 where the processor has it, else avx2, else sse4.2); RAYS, random or hard
# (random); REPETITIONS of each measurement (5), of which the median counts; JSON, a file to draw
# instead of measuring. It wants gnuplot and python3
# (Debian's packages gnuplot-nox and python3).
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
if [ -z "${ISA:-}" ]; then
    ISA=sse4.2
    for flag in avx2:avx2 avx512dq:avx512; do
        if grep -q "${flag%:*}" /proc/cpuinfo; then ISA=${flag#*:}; fi
    done
fi
mkdir -p "$folder"
json=${JSON:-$folder/chart.json}
if [ -z "${JSON:-}" ]; then
    [ -x "$build/bin/raylane-bench" ] ||
        fail "no $build/bin/raylane-bench; cmake --preset release leads to one"
    "$build/bin/raylane-bench" --benchmark_filter="methods/.*/$rays/.*/$ISA\$" \
        --benchmark_repetitions="$repetitions" --benchmark_enable_random_interleaving=true \
        --benchmark_min_time=0.05 --benchmark_out="$json" --benchmark_out_format=json >/dev/null
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 - "$json" "$rays" "$ISA" "$work" <<'PYTHON'
import json, statistics, sys

source, rays, isa, work = sys.argv[1:]
runs = {}
for run in json.load(open(source))["benchmarks"]:
    parts = run.get("run_name", run["name"]).split("/")
    if run.get("run_type") != "iteration" or parts[0] != "methods": continue
    if parts[2] == rays and parts[4] == isa:
        runs.setdefault(parts[1], {}).setdefault(parts[3], []).append(run)
if not runs: sys.exit("chart.sh: no measurements of %s rays by %s in %s" % (rays, isa, source))

colors = {"fast": "#d7301f", "robust": "#e69f00", "exact": "#0072b2", "double": "#666666"}
floor = 0.1  # ulps: what is drawn at the bottom
plot = open(work + "/plot", "w")
order = ["sphere", "plane", "disc", "triangle", "smooth_triangle", "box"]
for shape, methods in sorted(runs.items(), key=lambda run: (
        order.index(run[0]) if run[0] in order else len(order), run[0])):
    marks = []
    for method in colors:
        of = methods[method]
        speed = statistics.median(run["items_per_second"] for run in of) / 1e6
        marks.append((speed, max(of[0]["ulps_p99"], floor), method, of[0]["wrong"]))
    front, best = [], float("inf")
    for mark in sorted(marks, key=lambda m: (-m[0], m[1])):
        if mark[1] < best:
            front.append(mark)
            best = mark[1]
    with open("%s/%s.front" % (work, shape), "w") as out:
        for mark in front: out.write("%g %g\n" % mark[:2])
    fastest = max(mark[0] for mark in marks)
    highest = max(mark[1] for mark in marks)
    plot.write("set title '%s' offset 0,-0.6\nset xrange [0:%g]\nset yrange [%g:%g]\n" %
               (shape.replace("_", " "), 1.2 * fastest, floor, 5 * highest))
    curves = ["'%s/%s.front' with lines lc '#999999' dt 2 notitle" % (work, shape)]
    for index, (speed, error, method, wrong) in enumerate(marks):
        name = "%s/%s.%s" % (work, shape, method)
        share = "" if wrong == 0 else " %.2g %% wrong" % (100 * wrong)
        open(name, "w").write('%g %g "%s"\n' % (speed, error, share))
        curves.append("'%s' with points pt 7 ps 1.1 lc '%s' notitle" % (name, colors[method]))
        curves.append("'%s' using 1:2:3 with labels center offset 0,0.8 font ',9' tc '%s' notitle" % (name, colors[method]))
    plot.write("plot " + ", ".join(curves) + "\n")
plot.write("unset title\nunset border\nunset tics\nunset grid\nunset logscale\nset xrange [0:1]\nset yrange [0:1]\nunset xlabel\nunset ylabel\n")
plot.write("set key at 0.95,0.85 samplen 0.5 spacing 1.6 font ',12'\nplot " + ", ".join(
    "NaN with points pt 7 ps 1.4 lc '%s' title '%s'" % (color, method) for method, color in colors.items()) +
    ", NaN with lines lc '#999999' dt 2 title 'the best there is'\n")
PYTHON

draw() { # terminal, file
    gnuplot <<GNUPLOT
set terminal $1
set output '$folder/$2'
set multiplot layout 3,4 title "Nearest of 12 shapes, normals included: $rays rays, one thread, $ISA" font ',14'
set logscale y
set format y '10^{%L}'
set ylabel 'ulps of t, 99th percentile' offset 1.5 font ',9'
set xlabel 'million rays/s' offset 0,0.6 font ',9'
set tics font ',9'
set grid ytics lc '#dddddd'
load '$work/plot'
unset multiplot
GNUPLOT
}
draw "svg size 1200,860 background '#ffffff' font 'sans,11'" chart.svg
draw "pngcairo size 1200,860 font 'sans,11'" chart.png
echo "$folder/chart.svg and $folder/chart.png"
