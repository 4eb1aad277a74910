#!/usr/bin/python3
"""Makes one page, a file without network, of what has been measured and of pictures to compare.

    bench/report.py FOLDER [-o FILE] [--build BUILD]

FOLDER has any of these: chart.json (by bench/chart.sh), peers.json and errors.json (by bench/peers/run.sh), and
pictures/SET/*.pfm or *.png, of one size in each SET. The page, FOLDER/report.html unless -o says otherwise, has
charts of the former, and the latter to be compared; and, drawn by the Python module of BUILD (build/release),
where methods fail (bench/failures) and some of the shipped scenes.

Needs NumPy, node and npm, which fetches the libraries that bench/report/package-lock.json names into build/report;
Pillow for PNG.
"""

import argparse
import datetime
import json
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path[:0] = [str(HERE), str(HERE / "report"), str(HERE / "failures")]

import measurements  # noqa: E402
import pictures  # noqa: E402


def fail(message):
    sys.exit(f"report.py: {message}")


def bundle(room):
    """The page's script and style sheet."""
    for program in ("node", "npm"):
        if not shutil.which(program):
            fail(f"no {program} here; see Debian's nodejs and npm")
    room.mkdir(parents=True, exist_ok=True)
    lock = (HERE / "report/package-lock.json").read_text()
    installed = room / "node_modules/.lock"
    if not installed.exists() or installed.read_text() != lock:
        for name in ("package.json", "package-lock.json"):
            shutil.copy(HERE / "report" / name, room)
        # Nothing of what is fetched is run at this.
        command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--silent"]
        if subprocess.run(command, cwd=room).returncode != 0:
            fail(f"npm could not fetch the libraries of {HERE / 'report/package-lock.json'}")
        installed.write_text(lock)
    subprocess.run(["node", str(HERE / "report/build.mjs"), str(room / "node_modules"), str(room)], check=True)
    return (room / "main.js").read_text(), (room / "main.css" if (room / "main.css").exists() else room / "style.css").read_text()


def in_html(text):
    """Neither ends a script element nor begins a comment in one."""
    return text.replace("</", "<\\/").replace("<!--", "<\\!--")


def page_of(data, script, style):
    page = (HERE / "report/page.html").read_text()
    parts = {"/*STYLE*/": style, "/*DATA*/": in_html(json.dumps(data, separators=(",", ":"), allow_nan=False)), "/*SCRIPT*/": in_html(script)}
    for mark, text in parts.items():
        before, after = page.split(mark)
        page = before + text + after
    return page


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="FILE")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    arguments = parser.parse_args()
    folder, build = arguments.folder, arguments.build.resolve()
    if not folder.is_dir():
        fail(f"{folder} is no folder")
    try:
        charts = measurements.of_folder(folder)
        sets = pictures.of_folder(folder / "pictures")
    except (ValueError, OSError) as error:
        fail(error)
    failures = []
    if (build / "python/raylane").is_dir():
        sys.path.insert(0, str(build / "python"))
        import drawings

        failures, drawn = drawings.draw_failures(build)
        sets = drawings.draw_scenes(build) + drawn + sets
    else:
        print(f"report.py: no Python module in {build}, so no failures and no scenes are drawn", file=sys.stderr)
    if not sets and not any(charts.values()):
        fail(f"nothing to show in {folder}: no chart.json, peers.json, errors.json or pictures/SET")
    made = f"Made on {datetime.date.today().isoformat()}."
    data = {"made": made, "charts": charts, "failures": failures, "sets": [each.packed() for each in sets]}
    output = arguments.output or folder / "report.html"
    output.write_text(page_of(data, *bundle(ROOT / "build/report")))
    print(f"{output} ({output.stat().st_size / 1e6:.1f} MB)")


if __name__ == "__main__":
    main()
