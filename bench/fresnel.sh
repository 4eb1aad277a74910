#!/bin/sh
# Draws Schlick's approximation beside Fresnel's equations, as the renderer computes them: the
# reflectance by angle from both sides of a surface, and the largest error by index.
#
#   bench/fresnel.sh [BUILD [OUTPUT]]   BUILD: default build/release; OUTPUT: default fresnel.svg,
#                                       a PNG if its name says so
#
# Needs gnuplot (Debian's package gnuplot-nox).
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
output=${2:-fresnel.svg}

fail() {
    echo "fresnel.sh: $*" >&2
    exit 2
}
[ -x "$build/bin/raylane-fresnel" ] || fail "no $build/bin/raylane-fresnel; build it first"
command -v gnuplot >/dev/null || fail "no gnuplot here; Debian's package gnuplot-nox has it"

data=$(mktemp)
trap 'rm -f "$data"' EXIT
"$build/bin/raylane-fresnel" >"$data"

case $output in
*.png) terminal='pngcairo size 1500,500 font "sans,11"' ;;
*) terminal='svg size 1500,500 font "sans,13" background rgb "white"' ;;
esac
gnuplot <<END
set terminal $terminal
set output '$output'
data = '$data'
indices = '1.1 1.5 2.4 4.0'
colors = '#1b6ca8 #2a9d4a #d98a00 #b5262d'
set multiplot layout 1, 3
set grid lc rgb '#dddddd' lt 1
set key at graph 0.04, 0.96 left top reverse Left samplen 2 title 'index; dashed: Schlick' left
set xrange [0:90]
set yrange [0:1]
set xtics 15
set format x '%g°'
set ylabel 'reflected share'
set title 'Into the denser side'
plot for [i = 1:4] data index 2 * (i - 1) using 1:2 with lines lw 2 lc rgb word(colors, i) \\
         title word(indices, i), \\
     for [i = 1:4] data index 2 * (i - 1) using 1:3 with lines lw 2 dt '-' lc rgb word(colors, i) \\
         notitle
set title 'Out of it, total from the critical angle on'
set key off
plot for [i = 1:4] data index 2 * (i - 1) + 1 using 1:2 with lines lw 2 lc rgb word(colors, i) \\
         title word(indices, i), \\
     for [i = 1:4] data index 2 * (i - 1) + 1 using 1:3 with lines lw 2 dt '-' \\
         lc rgb word(colors, i) notitle
set title "Schlick's largest error by index, from either side"
set xrange [1:4]
set yrange [0.02:1]
set logscale y
set xtics 0.5
set format x '%g'
set xlabel 'index'
set ylabel 'largest error of the reflected share'
plot data index 8 using 1:2 with lines lw 3 lc rgb '#1b6ca8', \\
     data index 8 using 1:3 with lines lw 1 dt '.' lc rgb '#b5262d'
END
echo "$output"
