#!/usr/bin/env python3
"""Runs the commands of the documentation's pages: those of the tool in a folder as a clone is, at small sizes.

    pages_test.py SOURCE RAYLANE

Other commands are run elsewhere, or not at all; each needs its reason below.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

source, raylane = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
PAGES = ["README.md", "CONTRIBUTING.md", "bench/README.md"] + [
    f"scenes/{folder}README.md" for folder in ("", "tool/", "gallery/", "api/cpp/", "api/c/", "api/python/", "web/")]
ELSEWHERE = {
    "./bootstrap.sh": ".ci/run",
    "cmake": ".ci/run, and packages in .ci/nightly",
    "ctest": ".ci/run",
    "doxygen": ".ci/nightly",
    "mpirun": "ranks_test.sh",
    "tests/wasm.sh": ".ci/nightly",
    "bench/": "by hand: they take minutes",
    "build/release/bin/raylane-": "by hand, or by tests of their programs",
    "git": "nothing to test",
}
TOOL = "build/release/bin/raylane "
# Files that only people have.
OWN = ("vmdscene.dat",)


def commands_of(page):
    for block in re.findall(r"^```sh\n(.*?)^```", (source / page).read_text(), re.DOTALL | re.MULTILINE):
        block = re.sub(r"\\\n", " ", block)
        # A loop is one command.
        for command in re.findall(r"^for .*?^done$|^[^\n]+$", block, re.DOTALL | re.MULTILINE):
            if not command.startswith("#"):
                yield command


def smaller(command):
    """Renders the same image with few pixels and samples, where the command does not say how many."""
    def shrink(match):
        call = match[0]
        if "--size" in call or ".rl" in call:
            return call
        return call + " --size 40x30" + ("" if re.search("--(spp|quality|draft|print)", call) else " --spp 1")
    return re.sub(re.escape(TOOL) + r"render [^#\n|&]*[^#\n|& ]", shrink, command)


def gallery_differs():
    """Reports commands of the gallery's page that are not those of its images, and figures without images."""
    folder = source / "scenes/gallery"
    with tempfile.TemporaryDirectory() as work:
        made = subprocess.run(["sh", folder / "make.sh", raylane, work], env={**os.environ, "COMMANDS": "1"},
                              stdout=subprocess.PIPE, text=True, check=True).stdout
    figures = [line.split(": ", 1) for line in made.splitlines() if line]
    shown = re.findall(r"<br>`(raylane [^`]*)` \| !\[[^\]]*\]\((\w+)\.raylane\.png\)",
                       (folder / "README.md").read_text())
    differ = [name for name, command in figures if (command, name) not in shown]
    differ += [f"{name}.{kind}.png" for name, _ in figures for kind in ("raylane", "other")
               if not (folder / f"{name}.{kind}.png").is_file()]
    if len(figures) != 12 or len(shown) != 12 or differ:
        print("gallery: the page does not show make.sh's figures:", *differ)
        return 1
    return 0


def main():
    failures = gallery_differs()
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        clone = pathlib.Path(folder)
        (clone / "build/release/bin").mkdir(parents=True)
        (clone / "build/release/bin/raylane").symlink_to(raylane)
        (clone / "scenes").symlink_to(source / "scenes")
        for page in PAGES:
            for command in commands_of(page):
                if not command.startswith((TOOL, "for ", "printf ")):
                    if not command.startswith(tuple(ELSEWHERE)):
                        print(f"{page}: no reason why this is not run: {command}")
                        failures += 1
                    continue
                if any(name in command for name in OWN):
                    continue
                done = subprocess.run(["sh", "-ec", smaller(command)], cwd=clone, stdin=subprocess.DEVNULL,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                count += 1
                wanted = 1 if "exit code 1" in command else 0
                if done.returncode != wanted:
                    print(f"{page}: {command}\nexit code {done.returncode}: {done.stdout}")
                    failures += 1
    print(f"{count} commands run, {failures} failed")
    return failures != 0 or count < 20


sys.exit(main())
