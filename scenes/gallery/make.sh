#!/bin/sh
# Makes the gallery's pictures and those of the same files by POV-Ray and Tachyon, and prints the table of
# times. Requires Debian's pymol, python3-ase, lammps, lammps-examples, povray, povray-includes, tachyon,
# tachyon-doc and ImageMagick.
#
# usage: scenes/gallery/make.sh RAYLANE [FOLDER]    files and large pictures are left in FOLDER
set -eu
raylane=$(realpath "$1")
pages=$(realpath "$(dirname "$0")")
work=${2:-$(mktemp -d)}
mkdir -p "$work"
cd "$work"

fail() {
    echo "$*" >&2
    exit 1
}
quietly() { # command...
    "$@" >log 2>&1 || { cat log >&2; fail "$* failed"; }
}

# Input files, made by the programs that users have them from.

pymol_does() { # commands
    PATH=/usr/bin:$PATH quietly pymol -cq -d "viewport 800, 600; $1"
}
pymol_shows() { # scene for POV-Ray, commands: adds the white background that PyMOL omits
    pymol_does "$2; save $1"
    echo 'background { color rgb <1, 1, 1> }' >>"$1"
}
ase_does() { # commands of Python
    quietly /usr/bin/python3 -c "
import numpy
from ase.build import nanotube
from ase.io import read, write
from ase.io.pov import get_bondpairs
$1"
}

[ -e 1hpv.pdb ] || cp /usr/share/pymol/data/tut/1hpv.pdb .
[ -e 1hpv.cif ] || pymol_does 'load 1hpv.pdb; save 1hpv.cif, all'
[ -e tube.xyz ] || ase_does "write('tube.xyz', nanotube(6, 3, length=4, vacuum=2), format='extxyz')"
if [ ! -e pour.lammpstrj ]; then # LAMMPS' example of poured grains, up to step 13,000
    sed '/^run/,$d' /usr/share/lammps/examples/pour/in.pour >in.pour
    cat >>in.pour <<'LAMMPS'
run 13000
write_dump all custom pour.lammpstrj id type x y z radius vz
LAMMPS
    quietly lmp -in in.pour
fi
[ -e dna.dat ] || cp /usr/share/doc/tachyon/examples/scenes/dna.dat . # written by VMD, distributed with Tachyon
[ -e surface.pov ] || pymol_shows surface.pov "load /usr/share/pymol/data/demo/pept.pdb; hide all
show surface; show sticks; set transparency, 0.5; orient"

# The scenes that these programs write for POV-Ray.
[ -e 1hpv-spheres.pov ] || pymol_shows 1hpv-spheres.pov 'load 1hpv.pdb; hide all; show spheres'
[ -e 1hpv-sticks.pov ] ||
    pymol_shows 1hpv-sticks.pov 'load 1hpv.cif; hide all; show sticks, not solvent; util.cbc'
[ -e tube.pov ] || ase_does "
tube = read('tube.xyz')
write('tube.pov', tube, rotation='60x,30y',
      povray_settings=dict(transparent=False, canvas_width=450, bondatoms=get_bondpairs(tube, 1.1)))"
[ -e pour.pov ] || ase_does "
grains = read('pour.lammpstrj', format='lammps-dump-text')
write('pour.pov', grains, rotation='-90x,45y,25x', radii=numpy.full(len(grains), 0.5),
      povray_settings=dict(transparent=False, canvas_width=800))"

# Pictures, drawn three times each. Times are medians, in seconds, of whole programs with two threads.

seconds() { # command
    for _ in 1 2 3; do
        start=$(date +%s%N)
        quietly sh -c "$1"
        echo $((($(date +%s%N) - start) / 1000000))
    done | sort -n | sed -n 2p | awk '{ printf "%.2f", $1 / 1000 }'
}
row() { # name, arguments of raylane, the other's name and command
    name=$1 ours=$2 rival=$3 theirs=$4
    rm -f "$name".raylane.* "$name".other.*
    our_seconds=$(seconds "$raylane $ours")
    their_seconds=$(seconds "$theirs")
    for kind in raylane other; do
        from=$name.$kind.png
        [ -e "$from" ] || from=$name.$kind.tga
        [ -e "$from" ] || fail "$name: no image by $kind"
        convert "$from" -auto-orient -resize 400x300 -background white -gravity center -extent 400x300 -strip \
            -colors 256 "$pages/$name.$kind.png"
    done
    printf "%s: raylane %s s; %s %s s\n" "$name" "$our_seconds" "$rival" "$their_seconds"
}
povray_draws() { # scene, or an .ini file that also sets the size, and picture
    size='+W800 +H600'
    [ "${1%.ini}" = "$1" ] || size=
    echo "povray $1 +O$2 $size +WT2 -D +A0.0 +AM1 +R3"
}

row pdb 'render 1hpv.pdb -o pdb.raylane.png --size 800x600' \
    'PyMOL, POV-Ray' "$(povray_draws 1hpv-spheres.pov pdb.other.png)"
row cif 'render 1hpv.cif --style licorice --color chain --select "not water" -o cif.raylane.png --size 800x600' \
    'PyMOL, POV-Ray' "$(povray_draws 1hpv-sticks.pov cif.other.png)"
row xyz 'render tube.xyz --style balls --view corner -o xyz.raylane.png --size 800x600' \
    'ASE, POV-Ray' "$(povray_draws tube.ini xyz.other.png)"
row lammps 'render pour.lammpstrj --color vz --view 1,1,-0.7 --up z -o lammps.raylane.png --size 800x600' \
    'ASE, POV-Ray' "$(povray_draws pour.ini lammps.other.png)"
row dat 'tachyon -aasamples 4 -numthreads 2 dna.dat -o dat.raylane.tga' \
    'Tachyon' 'tachyon -aasamples 4 -numthreads 2 dna.dat -o dat.other.tga'
row pov 'render surface.pov --spp 9 -o pov.raylane.png --size 800x600' \
    'POV-Ray' "$(povray_draws surface.pov pov.other.png)"
