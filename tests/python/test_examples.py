"""Examples run, and each checks its results against known ones."""

import os
import pathlib
import subprocess
import sys

import pytest

EXAMPLES = sorted((pathlib.Path(__file__).parents[2] / "scenes" / "api" / "python" / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example(example, tmp_path):
    pytest.importorskip("matplotlib")
    arguments = [] if example.stem == "view_factors" else ["a.png"]
    done = subprocess.run([sys.executable, example, *arguments], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout, done.stderr
    folder = os.environ.get("RAYLANE_TEST_PICTURES")  # to look at the images
    for picture in tmp_path.glob("*.png"):
        assert picture.stat().st_size > 3000
        if folder:
            picture.rename(pathlib.Path(folder) / f"{example.stem}.png")
    assert bool(arguments) or not list(tmp_path.glob("*"))
