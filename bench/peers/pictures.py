"""Times whole pictures by raylane and by the peers that are found: see run.sh.

    pictures.py RAYLANE FOLDER SIZE THREADS REPETITIONS

FOLDER holds SCENE.nff and SCENE.pov; peers.json goes there: seconds of each run, by scene and
program.
"""

import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import time

raylane, folder, size, threads, repetitions = sys.argv[1:]
folder = pathlib.Path(folder)


def commands(scene):
    """What draws a scene, by the program's name."""
    nff, pov, out = (str(folder / (scene + end)) for end in (".nff", ".pov", ""))
    every = {
        "raylane": [raylane, "render", nff, "-o", out + ".raylane.png", "--size",
                    size + "x" + size, "--spp", "1", "--threads", threads],
        "povray": ["povray", "+I" + pov, "+O" + out + ".povray.png", "+W" + size, "+H" + size,
                   "-A", "-D", "-V", "+WT" + threads],
        "tachyon": ["tachyon", nff, "-res", size, size, "-numthreads", threads, "-fullshade",
                    "-o", out + ".tachyon.tga"],
    }
    return {name: command for name, command in every.items() if shutil.which(command[0])}


def seconds(command):
    start = time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          env={**os.environ, "HOME": str(folder)})
    passed = time.perf_counter() - start
    if done.returncode != 0:
        sys.exit("run.sh: %s failed:\n%s" %
                 (" ".join(command), done.stdout.decode(errors="replace")[-2000:]))
    return passed


def main():
    scenes = sorted(path.stem for path in folder.glob("*.nff") if path.with_suffix(".pov").exists())
    times = {}
    print("%s x %s pixels, %s thread(s), medians of %s runs, in seconds" %
          (size, size, threads, repetitions))
    for scene in scenes:
        by_program = {name: [] for name in commands(scene)}
        for _ in range(1 + int(repetitions)):  # the first warms up
            for name, command in commands(scene).items():
                by_program[name].append(seconds(command))
        times[scene] = {name: runs[1:] for name, runs in by_program.items()}
        medians = {name: statistics.median(runs) for name, runs in times[scene].items()}
        own = medians["raylane"]
        print("%-12s" % scene + "  ".join(
            "%s %.3f (%.3f to %.3f%s)" %
            (name, median, min(times[scene][name]), max(times[scene][name]),
             "" if name == "raylane" else ", %.1f times raylane's" % (median / own))
            for name, median in medians.items()), flush=True)
    with open(folder / "peers.json", "w") as file:
        json.dump({"size": int(size), "threads": int(threads), "seconds": times}, file, indent=2)
    print(folder / "peers.json")


main()
