#!/usr/bin/python3
"""Draws the images of the README.md beside this file, and writes that file: where methods fail.

    bench/failures/gallery.py [BUILD]    a Release build with Python's module; default build/release

Needs NumPy and Pillow.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
SIDE = 128

HEAD = """# Where methods fail

Failures that users of other renderers have reported, drawn again from what the reports say, and two of our own where double
fails as well. From left to right:

1. the **textbook's** formulas in float, with the remedy that is told with each against rays that hit what they leave
   (`textbook.py`; in double, and by a tiny epsilon, it draws all but a thousandth of the pixels of the others as they should be);
2. raylane's textbook formulas in float, `--precision fast`, which need no epsilon;
3. the best formulas in float, `--precision robust`;
4. these in double, `--precision double`;
5. **exact**, as raylane draws unless it is told otherwise.

*Off* are pixels of 36,864 that differ from the exact ones by more than one step of 255; *wrong* are rays through the middle of
a pixel that miss for a hit, hit for a miss, or hit another shape; *ulps* are those of `t` as a float: median, 99th percentile and
maximum, of rays that hit the same shape. That exact ones are exact is for tests to say: of spheres here, which rays hit them is
held to rationals (`tests/report`), and scenes like these, of all shapes, to an oracle
(`tests/simd/field_failures_test.cpp`, `tests/simd/field_epsilons_test.cpp`).

`bench/report.py` makes a page of them, on which any two can be laid over each other, down to the pixel. `gallery.py` has
written this one.
"""


def cell(numbers):
    ulps = ", ".join(f"{each:,.3g}" if each < 1000 else f"{each:,.0f}" for each in numbers["ulps"])
    return f"{numbers['off']:,} off, {numbers['wrong']:,} wrong; {ulps} ulps"


def text_of(told, sets):
    parts = [HEAD]
    for failure, drawn in zip(told, sets):
        name = failure["name"]
        titles = [picture.name for picture in drawn.pictures]
        parts.append(
            f"## {failure['title']}\n\n{failure['reference']}, [{name}.json]({name}.json). {failure['failure']} "
            f"The textbook's remedy: {failure['remedy']}.\n\n"
            f"![{failure['title']}: by the textbook, and as it should be]({name}.png)\n\n"
            f"| {' | '.join(titles)} |\n|{' --- |' * len(titles)}\n"
            f"| {' | '.join(cell(picture.numbers) for picture in drawn.pictures)} |\n"
        )
    return "\n".join(parts)


def main(build):
    sys.path[:0] = [str(build / "python"), str(HERE.parent / "report"), str(HERE)]
    import drawings
    import numpy as np
    import pictures
    from PIL import Image

    told, sets = drawings.draw_failures(build)
    for drawn in sets:
        strip = Image.fromarray(np.concatenate([pictures.encoded(picture.rgb) for picture in drawn.pictures], 1))
        strip = strip.resize((SIDE * len(drawn.pictures), SIDE), Image.Resampling.BOX)
        strip.quantize(96, dither=Image.Dither.NONE).save(HERE / f"{drawn.name}.png", optimize=True)
    (HERE / "README.md").write_text(text_of(told, sets))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else HERE.parents[1] / "build/release").resolve())
