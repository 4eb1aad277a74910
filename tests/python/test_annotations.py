"""Annotations of images of atoms."""

import pickle
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import raylane

MODULE = Path(raylane.__file__).parent / "raylane-annotation.so"
needs_pango = pytest.mark.skipif(not MODULE.exists(), reason="raylane was built without Pango")

WATER = (["O", "H", "H"], [[0, 0, 0.1], [0, 0.77, -0.46], [0, -0.77, -0.46]])
SIZE = {"width": 160, "height": 120, "grid": 1, "quality": 0}
ALL = {
    "labels": ["element O: {element}{index}", "element H: hydrogen"],
    "distances": ["index 1: index 2"],
    "legend": True,
    "legend_title": "Water",
    "triad": True,
    "font": "sans-serif",
}


def water(**options):
    return raylane.from_atoms(*WATER, view="x", **options)


def test_a_file_has_them_and_the_image_does_not(tmp_path):
    scene = water(scale_bar=1, **ALL)
    plain = water().render(**SIZE)
    with pytest.warns(UserWarning, match="scale_bar holds at the depth"):
        image = scene.render(annotations=tmp_path / "a.svg", **SIZE)
    assert np.array_equal(image.rgb, plain.rgb)
    svg = (tmp_path / "a.svg").read_text()
    texts = [">O1<", ">hydrogen<", ">0.95 \u00c5<", ">Water<", ">1 \u00c5<", ">x<"]
    for text in [*texts, "legend-colors", 'viewBox="0 0 160 120"']:
        assert text in svg, text
    remarks = []
    scene.render(annotations=tmp_path / "b.svg", on_remark=remarks.append, camera=scene.camera_on_all((0, 0, -1)), **SIZE)
    assert remarks and (tmp_path / "b.svg").read_text() != svg


@needs_pango
def test_the_image_has_them():
    plain, scene = water().render(**SIZE), water(**ALL)
    image = scene.render(**SIZE)
    changed = np.any(image.rgb != plain.rgb, axis=-1)
    assert 0.01 < changed.mean() < 0.5
    part = scene.render(crop=(20, 10, 80, 90), **SIZE)
    assert np.array_equal(part.rgb, image.rgb[10:100, 20:100])
    alpha = scene.render(alpha=True, **SIZE)
    assert (alpha.alpha > 0).sum() > (water().render(alpha=True, **SIZE).alpha > 0).sum()


def test_cells_have_their_axes(tmp_path):
    scene = water(cell=4 * np.eye(3), triad=True, orthographic=True, scale_bar=True)
    scene.render(annotations=tmp_path / "a.svg", **SIZE)
    assert ">a<" in (tmp_path / "a.svg").read_text()
    scene = water(cell=4 * np.eye(3), triad="xyz")
    scene.render(annotations=tmp_path / "a.svg", **SIZE)
    assert ">x<" in (tmp_path / "a.svg").read_text()


def test_atoms_of_other_packages(tmp_path):
    ase = pytest.importorskip("ase")
    for scene in raylane.frames([ase.Atoms("CO", [(0, 0, 0), (x, 0, 0)]) for x in (1.5, 2.5)], distances=["index 1: index 2"]):
        scene.render(annotations=tmp_path / "a.svg", **SIZE)
    assert ">2.50 \u00c5<" in (tmp_path / "a.svg").read_text()


def test_mistakes_name_the_option(tmp_path):
    for options, message in (
        ({"labels": ["all: a", "element Fe: b"]}, 'labels/1: "element Fe" selects none of 3 atoms'),
        ({"labels": ["all: {elemnt}"]}, 'labels/0: must have fields such as {element} or {index}, got "{elemnt}", did'),
        ({"label": "all: {element"}, 'label: must have a } behind each {, got "{element"'),
        ({"distances": ["all"]}, "distances/0: must be SELECTION: SELECTION"),
        ({"triad": "abc"}, "triad: must be xyz: the atoms have no cell"),
        ({"scale_bar": -1}, "scale_bar: must be auto or a length above 0"),
        ({"legend": True, "color": "orange"}, "legend: must have colours of elements, chains or numbers"),
        ({"font_size": 8}, "font_size: goes with legend, scale_bar, triad, label or distance"),
        ({"legend": "maybe"}, "legend: must be on or off"),
    ):
        with pytest.raises(raylane.BadInput) as error:
            water(**options)
        assert str(error.value).startswith(message)
    with pytest.raises(raylane.BadInput, match="scale_bar: must be auto or in the image"):
        water(scale_bar=1000).render(annotations=tmp_path / "a.svg", **SIZE)
    with pytest.raises(raylane.InvalidValue, match="annotations: goes with a scene of atoms that has annotations"):
        water().render(annotations=tmp_path / "a.svg", **SIZE)
    with pytest.raises(raylane.InvalidValue, match="annotations: must end with .svg"):
        water(legend=True).render(annotations=tmp_path / "a.png", **SIZE)
    with pytest.warns(UserWarning, match="the image does not show its atoms"):
        water(labels=["element O: oxygen"], hide="element O")


def test_moved_and_pickled_scenes_have_none(tmp_path):
    scene = water(legend=True)
    with pytest.warns(UserWarning, match="annotations"):
        again = pickle.loads(pickle.dumps(scene))
    for other in (again, scene.with_positions(scene.spheres().center)):
        with pytest.raises(raylane.InvalidValue, match="annotations"):
            other.render(annotations=tmp_path / "a.svg", **SIZE)


def test_without_pango_a_file_works(tmp_path):
    package = tmp_path / "raylane"
    shutil.copytree(MODULE.parent, package, ignore=shutil.ignore_patterns("raylane-annotation.so", "__pycache__"))
    program = """
import raylane
scene = raylane.from_atoms(["C"], [[0, 0, 0]], labels=["all: {element}"])
scene.render(width=40, height=40, grid=1, annotations="a.svg", on_remark=print)
try:
    scene.render(width=40, height=40, grid=1)
except raylane.SystemRefused as error:
    print(error)
"""
    out = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, env={"PYTHONPATH": str(tmp_path)}, capture_output=True, text=True
    )
    assert ">C<" in (tmp_path / "a.svg").read_text(), out.stderr
    assert "annotations: cannot write on an image" in out.stdout and "libpango1.0-dev" in out.stdout
