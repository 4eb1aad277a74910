#!/usr/bin/python3
"""Makes one HTML page of measurements and of images to compare. The page needs no network.

    bench/report.py FOLDER [-o FILE] [--build BUILD]

FOLDER has any of these: chart.json (from bench/chart.sh), peers.json and errors.json (from bench/peers/run.sh), and
pictures/SET/*.png, of one size in each SET. The page shows charts of the measurements and compares the images of a set.
The Python module of BUILD (default: build/release) adds the numerical failures of bench/failures and some of the shipped
scenes. FILE defaults to FOLDER/report.html.

Needs NumPy, Pillow, node and npm. npm fetches the libraries of bench/report/package-lock.json into build/report.
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
            fail(f"missing {program}: install Debian's packages nodejs and npm")
    room.mkdir(parents=True, exist_ok=True)
    lock = (HERE / "report/package-lock.json").read_text()
    installed = room / "node_modules/.lock"
    if not installed.exists() or installed.read_text() != lock:
        for name in ("package.json", "package-lock.json"):
            shutil.copy(HERE / "report" / name, room)
        # Scripts of the fetched packages do not run.
        command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--silent"]
        if subprocess.run(command, cwd=room).returncode != 0:
            fail(f"npm failed to fetch the libraries of {HERE / 'report/package-lock.json'}")
        installed.write_text(lock)
    subprocess.run(["node", str(HERE / "report/build.mjs"), str(room / "node_modules"), str(room)], check=True)
    return (room / "main.js").read_text(), (room / "style.css").read_text()


def licences(modules):
    """Returns the licences of the libraries in the page."""
    files = ["tslib/LICENSE.txt", "zrender/LICENSE", "echarts/LICENSE", "echarts/NOTICE"]
    files += sorted(str(each.relative_to(modules)) for each in modules.glob("echarts/licenses/*"))
    texts = [f"{name}\n\n{(modules / name).read_text()}" for name in files]
    # The package of img-comparison-slider omits its licence.
    slider = HERE / "report/img-comparison-slider.LICENSE"
    return "\n\n".join([*texts, f"{slider.name}\n\n{slider.read_text()}"])


def page_of(data, script, style, licence):
    parts = {
        "STYLE": style,
        # The escapes keep data and script from closing their elements and from opening comments.
        "DATA": json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c"),
        "SCRIPT": script.replace("</", "<\\/").replace("<!--", "<\\!--"),
        "LICENCES": html.escape(licence),
    }
    return re.sub(r"/\*([A-Z]+)\*/", lambda mark: parts[mark[1]], (HERE / "report/page.html").read_text())


def write_whole(path, text):
    """Writes the file completely or not at all."""
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
            fail(f"{each}: expected a folder")
    try:
        charts = measurements.of_folder(folder)
        sets = pictures.of_folder(folder / "pictures")
    except (ValueError, OSError) as error:
        fail(error)
    failures = []
    if (build / "python/raylane").is_dir():
        sys.path.insert(0, str(build / "python"))
        import drawings

        failures, drawn = drawings.draw_failures()
        sets = drawings.draw_scenes() + drawn + sets
    else:
        print(f"report.py: no Python module in {build}, so the page has no failures and no scenes", file=sys.stderr)
    if not sets and not any(charts.values()):
        fail(f"nothing to show in {folder}: no chart.json, peers.json, errors.json or pictures/SET")
    day = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())), datetime.timezone.utc)
    data = {
        "made": f"Made on {day:%Y-%m-%d}.",
        "charts": charts,
        "machines": measurements.small_prints_of(folder),
        "failures": failures,
        "sets": [each.packed() for each in sets],
    }
    room = ROOT / "build/report"
    script, style = bundle(room)
    write_whole(output, page_of(data, script, style, licences(room / "node_modules")))
    print(f"{output} ({output.stat().st_size / 1e6:.1f} MB)")


if __name__ == "__main__":
    main()
