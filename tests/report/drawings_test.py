#!/usr/bin/env python3
"""Tests bench/drawings: the committed drawings, the script that makes them, and the pages that show them.

    drawings_test.py    needs NumPy
"""

import importlib.util
import pathlib
import sys
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "bench/drawings"
BY_BUILD = {"stages.svg"}  # shows counters of a build

sys.dont_write_bytecode = True
spec = importlib.util.spec_from_file_location("make_drawings", FOLDER / "make.py")
make = importlib.util.module_from_spec(spec)
spec.loader.exec_module(make)


class Drawings(unittest.TestCase):
    def test_script_reproduces_committed_drawings(self):
        made = dict(make.drawings())
        self.assertEqual(made.keys() | BY_BUILD, {path.name for path in FOLDER.glob("*.svg")})
        for name, text in made.items():
            same = text.encode() == (FOLDER / name).read_bytes()
            self.assertTrue(same, f"{name}: must be as its script makes it; run bench/drawings/make.py")

    def test_drawings_are_small_and_readable(self):
        for path in FOLDER.glob("*.svg"):
            with self.subTest(path.name):
                svg = xml.etree.ElementTree.parse(path).getroot()
                self.assertLessEqual(int(svg.get("width")), 720)
                paper = svg.find("{*}rect")
                self.assertEqual(paper.get("fill"), "#ffffff")
                self.assertEqual((paper.get("width"), paper.get("height")), (svg.get("width"), svg.get("height")))
                self.assertTrue(all(float(text.get("font-size")) >= 11 for text in svg.iter("{*}text")))

    def test_architecture_shows_each_drawing_and_a_header_names_it(self):
        page = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
        paths = [path for floor in ("core", "simd") for path in (ROOT / floor).rglob("*.hpp")]
        headers = [path.read_text(encoding="utf-8") for path in paths]
        for path in FOLDER.glob("*.svg"):
            with self.subTest(path.name):
                self.assertIn(f"](bench/drawings/{path.name})", page)
                self.assertTrue(any(f"Drawing: bench/drawings/{path.name}\n" in text for text in headers))


if __name__ == "__main__":
    unittest.main()
