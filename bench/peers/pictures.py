"""Times whole processes that render whole images, for raylane and the installed peers. run.sh calls it.

    pictures.py JSON RAYLANE FOLDER SIZE THREADS REPETITIONS

FOLDER holds SCENE.nff and SCENE.pov. JSON gets rows in the format of raylane-peers.
"""

import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import time

output, raylane, folder, size, threads, repetitions = sys.argv[1:]
folder = pathlib.Path(folder)


def commands(scene):
    """Returns the commands that render a scene, by the program's name. All trace four reflections."""
    nff, pov, out = (str(folder / (scene + end)) for end in (".nff", ".pov", ""))
    every = {
        "raylane": [raylane, "render", nff, "-o", out + ".raylane.png", "--size",
                    size + "x" + size, "--spp", "1", "--threads", threads],
        "povray": ["povray", "+I" + pov, "+O" + out + ".povray.png", "+W" + size, "+H" + size,
                   "-A", "-D", "-V", "+WT" + threads],
        "tachyon": ["tachyon", nff, "-res", size, size, "-numthreads", threads, "-fullshade",
                    "-raydepth", "5", "-o", out + ".tachyon.tga"],
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


def measure(scene):
    """Measures one row: the programs in turn. The first round warms up."""
    times = {name: [] for name in commands(scene)}
    for _ in range(1 + int(repetitions)):
        for name, command in commands(scene).items():
            times[name].append(seconds(command))
    by = [{"name": name, "median": statistics.median(runs[1:]), "least": min(runs[1:]),
           "most": max(runs[1:])} for name, runs in times.items()]
    row = {"scene": scene, "what": "process", "count": int(size) ** 2, "unit": "s", "by": by,
           "threads": int(threads)}
    if len(by) > 1:
        row["ratio"] = min(other["median"] for other in by[1:]) / by[0]["median"]
    print("  %-14s" % scene + "  ".join(
        "%s %.3f s" % (result["name"], result["median"]) for result in by), flush=True)
    return row


def main():
    scenes = sorted(path.stem for path in folder.glob("*.nff") if path.with_suffix(".pov").exists())
    print("Whole processes that render images: %s x %s pixels, %s thread(s)" % (size, size, threads))
    rows = [measure(scene) for scene in scenes]
    with open(output, "w") as file:
        json.dump({"rows": rows}, file, indent=2)


main()
