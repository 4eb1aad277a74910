"""Times whole images against their errors, for raylane and the installed peers.

    errors.py JSON BUILD FOLDER SIZE THREADS REPETITIONS SCENES...

FOLDER holds SCENE.nff and SCENE.pov. A scene under a sky light has SCENE.json and SCENE.nff instead: Tachyon gets
the sky light by options, and POV-Ray is left out because it has no sky light. Each program's 8-bit images are
compared with that program's converged image, because programs shade differently. raylane runs with its widest
instruction set and, if that is AVX-512, with AVX2 as well. Rows of JSON: {"scene", "by", "setting", "seconds", "psnr"}.
"""

import functools
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
import machine  # noqa: E402

output, build, folder, size, threads, repetitions = sys.argv[1:7]
raylane, folder = build + "/bin/raylane", pathlib.Path(folder)


class Program:
    """A renderer. `command` returns the command line for a scene, options and the image's name."""

    def __init__(self, name, command, settings, truth):
        self.name, self.command, self.settings, self.truth = name, command, settings, truth

    def draw(self, scene, options, picture):
        start = time.perf_counter()
        done = subprocess.run(self.command(scene, options, str(picture)), stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, env={**os.environ, "HOME": str(folder)})
        passed = time.perf_counter() - start
        if done.returncode != 0:
            sys.exit("run.sh: %s failed:\n%s" %
                     (self.name, done.stdout.decode(errors="replace")[-2000:]))
        return passed


def file_of(scene, ending):
    return str(folder / (scene + ending))


@functools.lru_cache()
def isas():
    """Returns raylane's widest instruction set, and AVX2 if that is AVX-512."""
    small = [raylane, "render", file_of(sys.argv[7], ".nff"), "-o", str(folder / "picture.png"), "--size", "1x1",
             "--quiet", "--stats", "-"]
    widest = json.loads(subprocess.run(small, stdout=subprocess.PIPE, check=True).stdout)["isa"]
    return [widest, "avx2"] if widest == "avx512" else [widest]


def by_raylane(isa, under_sky):
    """Returns the `command` of a Program."""
    source = ".json" if under_sky else ".nff"
    return lambda scene, options, picture: [
        raylane, "render", file_of(scene, source), "-o", picture, "--size", size + "x" + size, "--threads", threads,
        "--isa", isa] + options


def programs(scene):
    under_sky = not pathlib.Path(file_of(scene, ".pov")).exists()
    every = []
    for number, isa in enumerate(isas()):
        for name, settings in (
                ("raylane", [(str(n * n), ["--spp", str(n * n)]) for n in (1, 2, 3, 4, 6, 8)]),
                ("raylane --quality", [(str(q), ["--quality", str(q)]) for q in (30, 36, 42, 48)])):
            every.append(Program(name + (" --isa " + isa if number else ""), by_raylane(isa, under_sky), settings,
                                 ["--spp", "1024"]))
    if shutil.which("povray") and not under_sky:
        every.append(Program(
            "povray", lambda scene, options, picture: [
                "povray", "+I" + file_of(scene, ".pov"), "+O" + picture, "+FN", "+W" + size,
                "+H" + size, "-J", "-D", "-V", "+WT" + threads] + options,
            [("+A" + a + " +AM2 +R" + r, ["+A" + a, "+AM2", "+R" + r])
             for a, r in (("0.3", "2"), ("0.1", "2"), ("0.1", "3"), ("0.03", "3"), ("0.01", "3"))],
            ["+A0.0", "+AM2", "+R4"]))
    if shutil.which("tachyon"):
        sky = ["-add_skylight", "0.9", "-skylight_samples", "16"] if under_sky else []
        every.append(Program(
            "tachyon", lambda scene, options, picture: [
                "tachyon", file_of(scene, ".nff"), "-res", size, size, "-numthreads", threads,
                "-fullshade", "-raydepth", "5", "-format", "PNG", "-o", picture] + sky + options,
            [(str(n), ["-aasamples", str(n)]) for n in (0, 3, 8, 15, 35)],
            ["-aasamples", "400"]))
    return every


def psnr(picture, truth):
    """Returns decibels, or None for equal images. raylane compare exits with 1 if images differ."""
    compared = subprocess.run([raylane, "compare", str(picture), str(truth)], stdout=subprocess.PIPE)
    for line in compared.stdout.decode().splitlines():
        if line.startswith("PSNR"):
            return float(line.split()[1])
    return None  # equal images


def measure(scene):
    rows, truths = [], {}
    for program in programs(scene):
        truth = folder / ("%s.%s.truth.png" % (scene, program.name.split()[0]))
        if truth not in truths:
            truths[truth] = program.draw(scene, program.truth, truth)
        picture = folder / "picture.png"
        for setting, options in program.settings:
            program.draw(scene, options, picture)
            seconds = statistics.median(
                program.draw(scene, options, picture) for _ in range(int(repetitions)))
            rows.append({"scene": scene, "by": program.name, "setting": setting,
                         "seconds": seconds, "psnr": psnr(picture, truth)})
            print("  %-14s %-18s %-18s %8.3f s %6.2f dB" %
                  (scene, program.name, setting, seconds, rows[-1]["psnr"] or 0), flush=True)
    return rows


def main():
    print("Time and PSNR of whole images: %s x %s pixels, %s thread(s)" % (size, size, threads))
    rows = [row for scene in sys.argv[7:] for row in measure(scene)]
    with open(output, "w") as file:
        json.dump({"machine": {**machine.described(build), **machine.versions_of_peers(), "isa": " ".join(isas())},
                   "size": int(size), "threads": int(threads), "rows": rows}, file, indent=2)


main()
