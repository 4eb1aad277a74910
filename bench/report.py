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
import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path[:0] = [str(HERE), str(HERE / "report"), str(HERE / "failures")]

import measurements  # noqa: E402
import pictures  # noqa: E402


def fail(message):
    print(f"report.py: {message}", file=sys.stderr)
    sys.exit(2)


def bundle(room):
    """Returns the page's script and style sheet."""
    for program in ("node", "npm"):
        if not shutil.which(program):
            fail(f"no {program} here; see Debian's nodejs and npm")
    room.mkdir(parents=True, exist_ok=True)
    lock = (HERE / "report/package-lock.json").read_text()
    installed = room / "node_modules/.lock"
    if not installed.exists() or installed.read_text() != lock:
        for name in ("package.json", "package-lock.json"):
            shutil.copy(HERE / "report" / name, room)
        # No script of the fetched packages runs here.
        command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--silent"]
        if subprocess.run(command, cwd=room).returncode != 0:
            fail(f"npm could not fetch the libraries of {HERE / 'report/package-lock.json'}")
        installed.write_text(lock)
    subprocess.run(["node", str(HERE / "report/build.mjs"), str(room / "node_modules"), str(room)], check=True)
    return (room / "main.js").read_text(), (room / "style.css").read_text()


def licences(modules):
    """Returns the licences of the libraries in the page."""
    files = ["tslib/LICENSE.txt", "zrender/LICENSE", "echarts/LICENSE", "echarts/NOTICE"]
    files += sorted(str(each.relative_to(modules)) for each in modules.glob("echarts/licenses/*"))
    return "\n\n".join(f"{name}\n\n{(modules / name).read_text()}" for name in files)


def page_of(data, script, style, licence):
    parts = {
        "STYLE": style,
        # The escapes keep data and script from ending their elements, and from beginning comments.
        "DATA": json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c"),
        "SCRIPT": script.replace("</", "<\\/").replace("<!--", "<\\!--"),
        "LICENCES": html.escape(licence),
    }
    return re.sub(r"/\*([A-Z]+)\*/", lambda mark: parts[mark[1]], (HERE / "report/page.html").read_text())


def write_whole(path, text):
    """Writes the whole file or nothing."""
    unfinished = path.with_name(path.name + ".part")
    unfinished.write_text(text)
    unfinished.replace(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="FILE")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    arguments = parser.parse_args()
    folder, build = arguments.folder, arguments.build.resolve()
    output = arguments.output or folder / "report.html"
    for each in (folder, output.parent):
        if not each.is_dir():
            fail(f"{each} is no folder")
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
        if not drawings.has_tiers(build):
            print(f"report.py: no raylane-tiers in {build}/bin, so no maps of tiers (RAYLANE_BENCHMARKS)", file=sys.stderr)
    else:
        print(f"report.py: no Python module in {build}, so no failures and no scenes are drawn", file=sys.stderr)
    if not sets and not any(charts.values()):
        fail(f"nothing to show in {folder}: no chart.json, peers.json, errors.json or pictures/SET")
    day = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())), datetime.timezone.utc)
    data = {
        "made": f"Made on {day:%Y-%m-%d}.",
        "charts": charts,
        "failures": failures,
        "sets": [each.packed() for each in sets],
    }
    room = ROOT / "build/report"
    script, style = bundle(room)
    write_whole(output, page_of(data, script, style, licences(room / "node_modules")))
    print(f"{output} ({output.stat().st_size / 1e6:.1f} MB)")


if __name__ == "__main__":
    main()
