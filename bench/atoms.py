#!/usr/bin/env python3
"""Reads and draws a LAMMPS dump of so many atoms, ten million by default, which it makes: MB/s of
reading on one thread, and bytes of memory an atom at the peak of a whole rendering.

usage: bench/atoms.py RAYLANE [COUNT [FOLDER]]"""

import os
import random
import subprocess
import sys
import tempfile
import time


def write_dump(path, count):
    """Writes a cubic crystal of two types whose atoms are a little off their places, as LAMMPS dumps it."""
    side = 1
    while side**3 < count:
        side += 1
    shuffle = random.Random(1)
    off = [shuffle.gauss(0.0, 0.1) for _ in range(4096)]
    spacing = 2.5
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{count}\nITEM: BOX BOUNDS pp pp pp\n")
        file.write(f"0 {side * spacing}\n" * 3 + "ITEM: ATOMS id type x y z\n")
        for first in range(0, count, side):
            z, y = divmod(first // side, side)
            lines = []
            for x in range(min(side, count - first)):
                atom = first + x
                at = (spacing * x + off[atom * 7 % 4096], spacing * y + off[atom * 5 % 4093],
                      spacing * z + off[atom * 3 % 4091])
                lines.append("%d %d %g %g %g\n" % (atom + 1, 1 + (x + y + z) % 2, *at))
            file.write("".join(lines))


def run(command):
    """Runs a command. Returns processor seconds, seconds, and bytes of memory at the peak."""
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(command)} failed")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - start, usage.ru_maxrss * 1024


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    raylane, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 10_000_000
    with tempfile.TemporaryDirectory(dir=sys.argv[3] if len(sys.argv) > 3 else None) as folder:
        dump, picture = f"{folder}/atoms.lammpstrj", f"{folder}/atoms.png"
        write_dump(dump, count)
        size = os.path.getsize(dump)
        # A single selected atom needs no tree, so this is the time of reading, and little else.
        reading, _, _ = min(run([raylane, "render", dump, "-o", picture, "--select", "index 1",
                                 "--style", "points",
                                 "--size", "16x16", "--spp", "1", "--threads", "1", "--quiet"])
                            for _ in range(3))
        print(f"{count} atoms, {size / 1e6:.0f} MB: read in {reading:.2f} s of one processor, "
              f"{size / 1e6 / reading:.0f} MB/s")
        busy, seconds, peak = run([raylane, "render", dump, "-o", picture, "--quiet"])
        print(f"drawn as a picture without options in {seconds:.1f} s ({busy:.1f} s of processors), "
              f"{peak / count:.1f} bytes an atom at the peak")


if __name__ == "__main__":
    main()
