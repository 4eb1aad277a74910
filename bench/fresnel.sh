#!/bin/sh
# Draws Schlick's approximation and Fresnel's equations, computed by the renderer's functions: the
# reflectance by angle of incidence from both sides of a surface, and the maximum error by refractive
# index.
#
#   bench/fresnel.sh [BUILD [OUTPUT]]   BUILD: default build/release; OUTPUT: default fresnel.svg;
#                                       a name that ends in .png gives a PNG
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
[ -x "$build/bin/raylane-fresnel" ] || fail "missing $build/bin/raylane-fresnel: build it with cmake --preset release"
command -v gnuplot >/dev/null || fail "missing gnuplot: install Debian's package gnuplot-nox"

data=$(mktemp)
trap 'rm -f "$data"' EXIT
"$build/bin/raylane-fresnel" >"$data"

case $output in
*.png) terminal='pngcairo size 1500,540 font "sans,11"' ;;
*) terminal='svg size 1500,540 font "sans,13" background rgb "white"' ;;
esac
gnuplot <<END
set terminal $terminal
set output '$output'
data = '$data'
indices = '1.1 1.5 2.4 4.0'
colors = '#1b6ca8 #2a9d4a #d98a00 #b5262d'
set multiplot layout 1, 3 title "Reflectance of unpolarized light at a dielectric surface\n{/=10 solid: Fresnel's equations; dashed: Schlick's approximation}"
set grid lc rgb '#dddddd' lt 1
set key at graph 0.04, 0.96 left top reverse Left samplen 2 title 'relative refractive index' left
set xrange [0:90]
set yrange [0:1]
set xtics 15
set format x '%g°'
set xlabel 'angle of incidence'
set ylabel 'reflectance'
set title 'Entering the denser medium'
plot for [i = 1:4] data index 2 * (i - 1) using 1:2 with lines lw 2 lc rgb word(colors, i) \\
         title word(indices, i), \\
     for [i = 1:4] data index 2 * (i - 1) using 1:3 with lines lw 2 dt '-' lc rgb word(colors, i) \\
         notitle
set title 'Leaving the denser medium; total above the critical angle'
set key off
plot for [i = 1:4] data index 2 * (i - 1) + 1 using 1:2 with lines lw 2 lc rgb word(colors, i) \\
         title word(indices, i), \\
     for [i = 1:4] data index 2 * (i - 1) + 1 using 1:3 with lines lw 2 dt '-' \\
         lc rgb word(colors, i) notitle
set title "Maximum absolute error of Schlick's approximation"
set key at graph 0.96, 0.96 right top noreverse Right title ''
set xrange [1:4]
set yrange [0.02:1]
set logscale y
set xtics 0.5
set format x '%g'
set xlabel 'relative refractive index'
set ylabel 'maximum error of the reflectance'
plot data index 8 using 1:2 with lines lw 5 lc rgb '#9ecae1' title 'entering the denser medium', \\
     data index 8 using 1:3 with lines lw 1.5 dt '-' lc rgb '#b5262d' title 'leaving the denser medium'
END
echo "$output"
