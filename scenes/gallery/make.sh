#!/bin/sh
# Makes the images of the gallery and those of the same subjects by other programs, and prints a line of times for each
# pair: medians of three runs of whole programs in alternation, and their processor seconds. Requires Debian's pymol,
# python3-ase, python3-matplotlib, lammps, lammps-examples, povray, povray-includes, tachyon,
# python-biopython-doc, pdb2pqr-doc, time and ImageMagick.
#
# usage: scenes/gallery/make.sh RAYLANE [FOLDER [FIGURE...]]    files and large images are left in FOLDER
# RUNS=1 runs each program once; COMMANDS=1 prints raylane's commands alone, without other programs.
set -eu
raylane=$(realpath "$1")
pages=$(realpath "$(dirname "$0")")
scenes=$(dirname "$pages")
work=${2:-$(mktemp -d)}
wanted=" $(echo "$*" | cut -s -d' ' -f3-) "
mkdir -p "$work"
cd "$work"

fail() {
    echo "$*" >&2
    exit 1
}
quietly() { # command...
    "$@" >log 2>&1 || { cat log >&2; fail "$* failed"; }
}
python_does() { # program
    quietly /usr/bin/python3 -c "$1"
}

# Makes the input files: those of Debian's packages, or of the programs that users have them from.
make_inputs() {
cp "$scenes/perovskite.cif" "$scenes/birthday.json" "$scenes/cutaway.json" "$scenes/protease.pdb.gz" /usr/share/pymol/data/tut/1hpv.pdb \
    /usr/share/pymol/test/dat/3al1.pdb .
zcat /usr/share/doc/python-biopython-doc/Tests/PDB/1LCD.pdb.gz | sed '/^ENDMDL/q' >1lcd.pdb # the first of three models
cp /usr/share/doc/pdb2pqr/examples/ligands/LIG_1HPV.mol2 amprenavir.mol2

[ -e platinum.xyz ] || python_does "
from ase.build import add_adsorbate, fcc111, molecule
from ase.io import write
slab = fcc111('Pt', (6, 6, 3), vacuum=4, orthogonal=True)
for site, place in ('ontop', (1, 1)), ('ontop', (4, 3)), ('bridge', (2, 4)), ('hcp', (3, 0)):
    add_adsorbate(slab, molecule('CO'), 1.85 if site == 'ontop' else 1.4, site, offset=place, mol_index=1)
write('platinum.xyz', slab, format='extxyz')"
if [ ! -e pour.lammpstrj ]; then # LAMMPS' example of poured grains, up to step 13,000
    sed '/^run/,$d' /usr/share/lammps/examples/pour/in.pour >in.pour
    cat >>in.pour <<'LAMMPS'
run 13000
write_dump all custom pour.lammpstrj id type x y z radius vz
LAMMPS
    quietly lmp -in in.pour
fi
if [ ! -e copper.lammpstrj ]; then # hot copper around a spherical hole
    cat >in.copper <<'LAMMPS'
units metal
lattice fcc 3.615
region box block 0 30 0 30 0 30
create_box 1 box
create_atoms 1 box
region hole sphere 15 15 15 7
delete_atoms region hole
pair_style eam
pair_coeff 1 1 /usr/share/lammps/potentials/Cu_u3.eam
velocity all create 1200 1
fix move all nve
compute energy all pe/atom
compute total all reduce sum c_energy
thermo_style custom step c_total
thermo 100
timestep 0.002
run 100
write_dump all custom copper.lammpstrj id element x y z c_energy modify element Cu
LAMMPS
    quietly lmp -in in.copper
fi
# The scene as VMD and OVITO write it for Tachyon, with ambient occlusion. Tachyon's axes are left-handed.
[ -e copper.dat ] || python_does "
import numpy
from matplotlib import colormaps
atoms = numpy.loadtxt('copper.lammpstrj', skiprows=9, usecols=(2, 3, 4, 5))
x, y, z, energy = atoms[~((atoms[:, 0] > 54) & (atoms[:, 1] < 54) & (atoms[:, 2] > 54))].T
way = numpy.array([-1, 1.4, -0.8]) / numpy.linalg.norm([-1, 1.4, -0.8])
eye, colors = 54 - 215 * way, colormaps['viridis']((energy + 3.6) / 0.6)[:, :3]
with open('copper.dat', 'w') as file:
    print(f'''Begin_Scene
Resolution 800 600
Shader_Mode Full
Ambient_Occlusion
Ambient_Color 0.7 0.7 0.7
Rescale_Direct 0.5
Samples 12
End_Shader_Mode
Camera
Zoom 1.05
AspectRatio 1
Antialiasing 8
RayDepth 2
Center {eye[0]} {eye[1]} {-eye[2]}
ViewDir {way[0]} {way[1]} {-way[2]}
UpDir 0 0 -1
End_Camera
Directional_Light Direction -0.7 0.5 0.5 Color 1 1 1
Background 1 1 1''', file=file)
    for place, color in zip(zip(x, y, -z), colors):
        print('Sphere Center %g %g %g Rad 1.4 Texture Ambient 0 Diffuse 0.8 Specular 0 Opacity 1 Phong Plastic 0.1'
              ' Phong_size 20 Color %g %g %g TexFunc 0' % (*place, *color), file=file)
    print('End_Scene', file=file)"
}
[ -n "${COMMANDS:-}" ] || make_inputs

# Commands. Both programs of a pair have two threads, and write 800 x 600 pixels.

size='--size 800x600'
pymol_draws() { # image, file: antialias 2, as in figures of papers
    { cat <<'PYMOL'
set max_threads, 2
viewport 800, 600
set antialias, 2
bg_color white
set ray_opaque_background, 1
hide all
PYMOL
        cat
        echo "ray 800, 600
png $1.other.png"
    } | sed "s/^hide all/load $2\nhide all/" >"$1.pml"
    echo "PATH=/usr/bin:\$PATH pymol -cq $1.pml"
}
povray_draws() { # scene, or an .ini file that also sets the size, and name
    pixels='+W800 +H600'
    [ "${1%.ini}" = "$1" ] || pixels=
    echo "povray $1 +O$2.other.png $pixels +WT2 -D +A0.0 +AM1 +R3"
}

median_of() { # file: the median of each column
    for column in 1 2; do
        cut -d' ' -f$column "$1" | sort -n | awk '{ row[NR] = $1 } END { printf " %.2f", row[int((NR + 1) / 2)] }'
    done
}
timed() { # file for seconds and processor seconds, command
    quietly /usr/bin/time -o seconds -f '%e %U %S' sh -c "$2"
    awk '{ print $1, $2 + $3 }' seconds >>"$1"
}
figure() { # name, arguments of raylane, the other's name and command
    name=$1 ours=$2 rival=$3 theirs=$4
    if [ -n "${COMMANDS:-}" ]; then
        echo "$name: raylane $ours" | tr -s ' \n' ' ' | sed 's/ -o .*//; s/$/\n/'
        return 0
    fi
    case $wanted in "  " | *" $name "*) ;; *) return 0 ;; esac
    rm -f "$name".raylane.* "$name".other.*
    for _ in $(seq "${RUNS:-3}"); do
        timed "$name.raylane.times" "$raylane $ours"
        timed "$name.other.times" "$theirs"
    done
    for kind in raylane other; do
        from=$name.$kind.png
        [ -e "$from" ] || from=$name.$kind.tga
        [ -e "$from" ] || fail "$name: no image by $kind"
        convert "$from" -auto-orient -resize 400x300 -background white -gravity center -extent 400x300 -strip \
            -colors 256 "$pages/$name.$kind.png"
    done
    echo "$name: raylane$(median_of "$name.raylane.times"); $rival$(median_of "$name.other.times")"
}

figure envelope "render 1hpv.pdb --show 'protein: cartoon lightgray' --show 'byres protein within 4 of ligand: \
    cartoon lightgray + licorice carbons wheat radius 0.15' --show 'ligand: licorice carbons orange + envelope orange \
    opacity 0.3' --max-transparent 1 --transparent-shadows off --view best --quality 42 -o envelope.raylane.png $size" \
    PyMOL "$(pymol_draws envelope 1hpv.pdb <<'PYMOL'
select pocket, byres polymer within 4 of organic
create envelope, organic
hide all, envelope
show cartoon, 1hpv
show sticks, 1hpv and (pocket or organic)
color gray80
color wheat, pocket and elem C
color orange, organic and elem C
util.cnc
color orange, envelope
show surface, envelope
set surface_solvent, 1
set transparency, 0.7
orient polymer
zoom polymer, -3
PYMOL
)"

figure cartoon "render protease.pdb.gz --show 'protein: cartoon secondary' --show 'ligand: licorice carbons orange' \
    --view best -o cartoon.raylane.png $size" \
    PyMOL "$(pymol_draws cartoon protease.pdb.gz <<'PYMOL'
show cartoon
show sticks, organic
color gray80
color firebrick, ss h
color skyblue, ss s
color orange, organic and elem C
util.cnc organic
orient polymer
zoom polymer, -3
PYMOL
)"

figure lac "render 1lcd.pdb --show 'protein: cartoon secondary' --show 'nucleic: cartoon chain' --view best \
    --quality 42 -o lac.raylane.png $size" \
    PyMOL "$(pymol_draws lac 1lcd.pdb <<'PYMOL'
show cartoon
color gray80
color firebrick, ss h
color orange, chain B
color forest, chain C
set cartoon_ring_mode, 3
orient
zoom all, -3
PYMOL
)"

perovskite="perovskite.cif --polyhedra 'Ti steelblue opacity 0.7' --cell --axes --repeat 2x2x1"
figure perovskite "render $perovskite -o perovskite.raylane.png $size" \
    POV-Ray "$raylane convert -q $perovskite perovskite.pov
    echo 'light_source { <200, -100, 300> rgb 0.9 }' >>perovskite.pov
    $(povray_draws perovskite.pov perovskite)"

figure ellipsoids "render 3al1.pdb --ellipses --select 'chain A and residue 100-106 and not hydrogen' --view best \
    -o ellipsoids.raylane.png $size" \
    PyMOL "$(pymol_draws ellipsoids 3al1.pdb <<'PYMOL'
select shown, chain A and resi 100-106 and not hydro
show ellipsoids, shown
show sticks, shown
set stick_radius, 0.1
color gray60, elem C
orient shown
zoom shown, 0
PYMOL
)"

figure platinum "render platinum.xyz --style touching --color Pt=lightsteelblue --view 1,-2,-1.2 --up z --boundary off \
    --quality 46 -o platinum.raylane.png $size" \
    'ASE and POV-Ray' "/usr/bin/python3 -c \"
from ase.io import read, write
write('platinum.pov', read('platinum.xyz'), rotation='25z,-60x',
      show_unit_cell=0, povray_settings=dict(transparent=False, canvas_width=800))\"
    $(povray_draws platinum.ini platinum)"

figure grains "render pour.lammpstrj --color vz --range -5 1 --legend --legend-title 'vertical speed' \
    --view 1,1,-0.7 --up z --quality 44 -o grains.raylane.png $size" \
    'ASE and POV-Ray' "/usr/bin/python3 -c \"
import numpy
from ase.io import read, write
from matplotlib import colormaps
grains = read('pour.lammpstrj', format='lammps-dump-text')
speeds = numpy.loadtxt('pour.lammpstrj', skiprows=9)
speeds = speeds[numpy.argsort(speeds[:, 0]), -1]
write('pour.pov', grains, rotation='-90x,45y,25x', radii=numpy.full(len(grains), 0.5),
      colors=colormaps['viridis']((speeds + 5) / 6)[:, :3],
      show_unit_cell=0, povray_settings=dict(transparent=False, canvas_width=800))\"
    $(povray_draws pour.ini grains)"

camera='{"from": [9, 7.5, 12], "at": [0.1, -0.3, 0], "field_of_view": 33}'
figure cutaway "render cutaway.json --camera '$camera' -o cutaway.raylane.png $size" \
    POV-Ray "$raylane convert -q cutaway.json --camera '$camera' cutaway.pov
    sed -i 's/right <[-0-9.]*/&*0.9333/' cutaway.pov
    echo 'light_source { <9, 7.5, 12> rgb 0.45 shadowless }' >>cutaway.pov
    $(povray_draws cutaway.pov cutaway)"

site='byres protein within 3.7 of ligand'
figure site "render 1hpv.pdb --show '$site: licorice carbons lightgray radius 0.12' \
    --show 'ligand: licorice carbons orange radius 0.16' --hydrogen-bonds --label '$site: {resn} {resi}' --view best \
    -o site.raylane.png $size" \
    PyMOL "$(pymol_draws site 1hpv.pdb <<'PYMOL'
select site, byres polymer within 3.7 of organic
show sticks, site or organic
set stick_radius, 0.12
color gray80
color orange, organic and elem C
util.cnc
label site and name CA, resn + resi
distance bonds, organic, site, mode=2
hide labels, bonds
orient site or organic
zoom site or organic, -1
PYMOL
)"

figure amprenavir "render amprenavir.mol2 --view best -o amprenavir.raylane.png $size" \
    PyMOL "$(pymol_draws amprenavir amprenavir.mol2 <<'PYMOL'
show sticks
show spheres
set stick_radius, 0.1
set sphere_scale, 0.22
set valence, 1
color gray60, elem C
orient
zoom all, -2
PYMOL
)"

cat >wall.pov <<'POVRAY'
#declare Sky = function { x * x + y * y - 150 }
#declare m0 = material { texture { finish { ambient 0.95 diffuse 0 } pigment { average pigment_map {
[1 function { 0.999 * select(Sky(x, y, z), select(-y, 1, 0.7), select(y, 0, abs(cos(x)))) }
   color_map { [0 rgb 0] [1 rgb <3, 0, 0>] }]
[1 function { 0.999 * select(Sky(x, y, z), 0.2, select(y, 0, abs(sin(sqrt(abs(y)))))) }
   color_map { [0 rgb 0] [1 rgb <0, 3, 0>] }]
[1 function { 0.999 * select(Sky(x, y, z), 0, abs(cos(select(y, y, sqrt(abs(y)))))) }
   color_map { [0 rgb 0] [1 rgb <0, 0, 3>] }] } } } }
POVRAY
figure birthday "render birthday.json --spp 9 -o birthday.raylane.png $size" \
    POV-Ray "$raylane convert -q birthday.json birthday.pov
    sed -i -e '/^#declare m0 /{r wall.pov' -e 'd}' -e 's/right <[-0-9.]*/&*4\/3/' birthday.pov
    echo 'fog { fog_type 2 up z fog_offset 4 fog_alt 0.01 distance 78 rgb 1 }' >>birthday.pov
    $(povray_draws birthday.pov birthday)"

figure copper "render copper.lammpstrj --color c_energy --range -3.6 -3 --legend --legend-title 'energy (eV)' \
    --select 'not (x > 54 and y < 54 and z > 54)' --view -1,1.4,-0.8 --up z -o copper.raylane.png $size" \
    Tachyon 'tachyon -numthreads 2 copper.dat -o copper.other.tga'
