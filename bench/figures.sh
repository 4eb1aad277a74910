#!/bin/sh
# Times whole processes of raylane, PyMOL and POV-Ray, if these are installed (Debian's pymol and povray), on
# figures of molecules: each with its default and with its best setting of anti-aliasing, in turn. Prints a table
# of processor seconds, medians. Needs python3.
#
#   bench/figures.sh [BUILD [FOLDER]]   BUILD: a Release build of raylane; default build/release.
#                                       FOLDER: where structures and pictures go; default build/figures
#
# Environment: STRUCTURES, PDB files to draw as well; REPETITIONS (3); SIZE (1200x900); THREADS (2); ISA, such
# as avx2 (default: the best one available).
#
# This script makes the structures: sixteen alpha helices side by side (1,920 atoms), one of six residues, and
# 62,500 atoms of copper whose b_factor is the distance from the middle.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
folder=${2:-build/figures}
[ -x "$build/bin/raylane" ] || { echo "figures.sh: no $build/bin/raylane; cmake --preset release leads to one" >&2; exit 2; }
command -v python3 >/dev/null || { echo "figures.sh: no python3 here" >&2; exit 2; }
mkdir -p "$folder"

# Alanine along a helix of 1.5 angstrom and 100 degrees a residue: radius, degrees and height of each atom.
helices() { # a side, residues
    awk -v side="$1" -v residues="$2" 'BEGIN {
        split("N CA C O CB", name); split("1.56 2.29 1.68 2.06 3.31", radius)
        split("-27.8 0 26.6 20.6 -19.6", turn); split("-0.92 0 1.12 2.32 -0.67", up)
        degree = atan2(0, -1) / 180
        for (x = 0; x < side; ++x) for (y = 0; y < side; ++y) for (r = 0; r < residues; ++r)
            for (a = 1; a <= 5; ++a) {
                angle = (100 * r + turn[a]) * degree; height = 1.5 * r + up[a]
                printf "ATOM  %5d  %-3s ALA %s%4d    %8.3f%8.3f%8.3f  1.00 20.00           %s\n", ++n % 100000, name[a],
                    substr("ABCDEFGHIJKLMNOP", x * side + y + 1, 1), r + 1, 9.6 * x + radius[a] * cos(angle),
                    9.6 * y + radius[a] * sin(angle), height, substr(name[a], 1, 1)
            }
        print "END" }'
}
copper() { # cells a side
    awk -v cells="$1" 'BEGIN {
        for (x = 0; x < cells; ++x) for (y = 0; y < cells; ++y) for (z = 0; z < cells; ++z)
            for (k = 0; k < 4; ++k) {
                px = x + (k == 1 || k == 2) / 2; py = y + (k == 1 || k == 3) / 2; pz = z + (k == 2 || k == 3) / 2
                far = sqrt((px - cells / 2) ^ 2 + (py - cells / 2) ^ 2 + (pz - cells / 2) ^ 2)
                printf "HETATM%5d CU    CU A%4d    %8.3f%8.3f%8.3f  1.00%6.2f          CU\n", ++n % 100000, n % 10000,
                    3.615 * px, 3.615 * py, 3.615 * pz, far
            }
        print "END" }'
}
helices 4 24 >"$folder/bundle.pdb"
helices 1 6 >"$folder/helix.pdb"
copper 25 >"$folder/copper.pdb"

exec python3 - "$build/bin/raylane" "$folder" "${REPETITIONS:-3}" "${SIZE:-1200x900}" "${THREADS:-2}" ${STRUCTURES:-} <<'PY'
import os, pathlib, resource, shutil, statistics, subprocess, sys

raylane, folder, repetitions, size, threads, *structures = sys.argv[1:]
folder = pathlib.Path(folder)
width, height = size.split("x")
isa = ["--isa", os.environ["ISA"]] if os.environ.get("ISA") else []


def drawn(figure, *options):
    return [raylane, "render", figure["file"], "-o", folder / "raylane.png", "--size", size, "--threads", threads,
            "--quiet", *isa, *figure["raylane"], *options]


def by_pymol(figure, antialias):
    commands = ["set max_threads, " + threads, "bg_color white", "load %s, m" % figure["file"], "hide everything",
                *figure["pymol"], "set antialias, %d" % antialias, "orient", "ray %s, %s" % (width, height),
                "png %s" % (folder / "pymol.png")]
    return ["pymol", "-cqk", "-d", "; ".join(commands)]


def by_povray(figure, *options):
    return ["povray", "+I" + str(folder / "figure.pov"), "+O" + str(folder / "povray.png"), "+W" + width, "+H" + height,
            "-D", "-V", "+WT" + threads, *options]


def seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit("figures.sh: %s failed:\n%s" % (command, done.stdout.decode(errors="replace")[-2000:]))
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


spheres = {"raylane": ["--style", "spheres"], "pymol": ["show spheres"]}
sticks = {"raylane": ["--style", "sticks", "--color", "chain"], "pymol": ["show sticks", "util.cbc"]}
balls = {"raylane": ["--style", "balls"],
         "pymol": ["show sticks", "show spheres", "set stick_radius, 0.15", "set sphere_scale, 0.25"]}
half = {"raylane": ["--style", "balls", "--opacity", "0.5"],
        "pymol": balls["pymol"] + ["set sphere_transparency, 0.5", "set stick_transparency, 0.5"]}
by_number = {"raylane": ["--style", "spheres", "--color", "b_factor"], "pymol": ["show spheres", "spectrum b"]}
figures = [(name, str(folder / file), how) for name, file, how in (
    ("helix, balls", "helix.pdb", balls), ("helix, balls, half transparent", "helix.pdb", half),
    ("bundle, spheres", "bundle.pdb", spheres), ("bundle, sticks by chain", "bundle.pdb", sticks),
    ("copper by number", "copper.pdb", by_number))]
figures += [(pathlib.Path(file).stem + ", " + name, file, how) for file in structures
            for name, how in (("spheres", spheres), ("sticks by chain", sticks))]

print("Processor seconds, %s, %s threads, medians of %s" % (size, threads, repetitions))
for name, file, how in figures:
    figure = {"file": file, **how}
    commands = {"raylane": drawn(figure), "raylane --spp 16": drawn(figure, "--spp", "16"),
                "raylane --draft": drawn(figure, "--draft")}
    if shutil.which("pymol"):
        commands["pymol"] = by_pymol(figure, 1)
        commands["pymol antialias 2"] = by_pymol(figure, 2)
    if shutil.which("povray"):
        subprocess.run([raylane, "convert", file, folder / "figure.pov", *how["raylane"]], check=True)
        commands["povray"] = by_povray(figure, "-A")
        commands["povray +A0.1 +R3"] = by_povray(figure, "+A0.1", "+R3")
    times = {command: [] for command in commands}
    for _ in range(int(repetitions)):
        for command, words in commands.items():
            times[command].append(seconds(words))
    print("%-32s %s" % (name, "  ".join("%s %.2f" % (command, statistics.median(runs)) for command, runs in times.items())),
          flush=True)
PY
