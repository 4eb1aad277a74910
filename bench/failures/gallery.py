#!/usr/bin/python3
"""Renders the images of the README.md beside this file, and writes that file.

    bench/failures/gallery.py [BUILD]    a Release build with the Python module; default build/release

Needs NumPy and Pillow.
"""

import pathlib
import re
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
TILE = 128  # pixels
GAP = 4
CAPTION = 14

HEAD = """# Numerical failures of ray tracers

{summary}

Each image shows five methods from left to right. Each table has the same columns:

1. **textbook**: textbook formulas in float, with a remedy against rays that hit the surface that they leave
   ([textbook.py](textbook.py)). In double and with an epsilon of 1e-9 of the scene's scale, this tracer differs from
   the exact image in at most 0.1 % of the pixels of the reported failures.
2. **fast**: the textbook formulas in raylane, in float (`--precision fast`). raylane needs no epsilon, here and below.
3. **robust**: the best float formulas (`--precision robust`).
4. **double**: the robust formulas in double (`--precision double`).
5. **exact**: raylane's default.

The rows of a table are:

- **differing pixels**: pixels of {pixels:,} that differ from the exact image by more than 1 of 255 in a channel, in sRGB.
- **misclassified rays**: rays through pixel centres with a miss for a hit, a hit for a miss, or another shape.
- **error of t**: the distance from the exact t in ulps of float, both rounded to float, over rays that hit the same
  shape. The rows are the median, the 99th percentile and the maximum.

Tests check the exact images. `tests/report` compares hits of these spheres with rational arithmetic.
`tests/simd/render/field_failures_test.cpp` and `tests/simd/render/field_epsilons_test.cpp` compare similar scenes of
all shapes with an oracle.

`bench/report.py` makes a page that compares any two of these images by a slider. `gallery.py` generates
this page.
"""
SUMMARY = """For readers who choose a precision, and for authors of ray tracers: reported failures, rendered again by five
methods. Users of other renderers have reported {reported} failures. Robust float formulas without a ray epsilon cure all of
them to a pixel: per scene, at most {robust} of {pixels:,} pixels differs from the exact image, and at most {robust_rays} ray
is misclassified. Two scenes of raylane's need exact arithmetic: {two}. In each of them, even `double` misclassifies at least
{double:,} rays."""
ULPS = ["error of t [ulp]: median", "99th percentile", "maximum"]


def is_reported(failure):
    return not failure["name"].startswith("double-")


def link(title):
    """Returns a link to a heading, with the anchor that GitHub gives it."""
    return f"[{title}](#{re.sub(r'[^a-z0-9 -]', '', title.lower()).replace(' ', '-')})"


def wrapped(paragraph):
    return textwrap.fill(" ".join(paragraph.split()), 120, break_long_words=False, break_on_hyphens=False)


def head_of(failures, sets):
    numbers = [{picture.name: picture.numbers for picture in each.pictures} for each in sets]
    height, width = sets[0].pictures[0].srgb.shape[:2]
    robust = [each["robust"] for failure, each in zip(failures, numbers) if is_reported(failure)]
    double = [each["double"] for failure, each in zip(failures, numbers) if not is_reported(failure)]
    pixels = height * width
    summary = SUMMARY.format(
        reported=len(robust),
        robust=max(each["off"] for each in robust),
        robust_rays=max(each["wrong"] for each in robust),
        double=min(each["wrong"] for each in double),
        pixels=pixels,
        two=" and ".join(link(failure["title"]) for failure in failures if not is_reported(failure)),
    )
    return HEAD.format(summary=wrapped(summary), pixels=pixels)


def table_of(pictures):
    numbers = [picture.numbers for picture in pictures]
    rows = [
        ["", *(picture.name for picture in pictures)],
        ["---", *("---:" for _ in pictures)],
        ["differing pixels", *(f"{each['off']:,}" for each in numbers)],
        ["misclassified rays", *(f"{each['wrong']:,}" for each in numbers)],
    ]
    for i, name in enumerate(ULPS):
        ulps = [each["ulps"][i] for each in numbers]
        rows.append([name, *(f"{each:,.3g}" if each < 1000 else f"{each:,.0f}" for each in ulps)])
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def text_of(failures, sets):
    parts = [head_of(failures, sets)]
    for failure, drawn in zip(failures, sets):
        name, title = failure["name"], failure["title"]
        names = ", ".join(picture.name for picture in drawn.pictures)
        paragraph = (
            f"{failure['reference']}, [{name}.json]({name}.json). {failure['failure']} "
            f"Remedy in the textbook tracer: {failure['remedy']}."
        )
        parts.append(
            f"## {title}\n\n{wrapped(paragraph)}\n\n"
            f"![{title}: {names}]({name}.png)\n\n{table_of(drawn.pictures)}"
        )
    return "\n".join(parts)


def montage(pictures):
    """Returns the pictures side by side, each under its name."""
    from PIL import Image, ImageDraw, ImageFont

    count = len(pictures)
    result = Image.new("RGB", (count * TILE + (count - 1) * GAP, CAPTION + TILE), "white")
    pen = ImageDraw.Draw(result)
    for number, picture in enumerate(pictures):
        left = number * (TILE + GAP)
        pen.text((left + 1, 1), picture.name, "black", ImageFont.load_default())
        tile = Image.fromarray(picture.srgb).resize((TILE, TILE), Image.Resampling.BOX)
        result.paste(tile, (left, CAPTION))
    return result.quantize(96, dither=Image.Dither.NONE)


def main(build):
    sys.path[:0] = [str(build / "python"), str(HERE.parent / "report"), str(HERE)]
    import drawings

    failures, sets = drawings.draw_failures()
    for drawn in sets:
        montage(drawn.pictures).save(HERE / f"{drawn.name}.png", optimize=True)
    (HERE / "README.md").write_text(text_of(failures, sets))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else HERE.parents[1] / "build/release").resolve())
