"""Tests bench/report.py without a browser: its data, and the images of numerical failures.

    PYTHONPATH=BUILD/python pytest tests/report
"""

import fractions
import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "bench"), str(ROOT / "bench/report"), str(ROOT / "bench/failures")]

import drawings  # noqa: E402
import gallery  # noqa: E402
import measurements  # noqa: E402
import pictures  # noqa: E402
import raylane  # noqa: E402
import report  # noqa: E402
import textbook  # noqa: E402

FAILURES = json.loads((ROOT / "bench/failures/failures.json").read_text())


def fails_in_double(failure):
    """True if formulas in double fail, too."""
    return failure["name"].startswith("double-")


@pytest.mark.parametrize("failure", FAILURES, ids=lambda each: each["name"])
def test_textbook_in_double_with_a_tiny_epsilon_renders_the_exact_image(failure, monkeypatch):
    """Only floats and epsilons make the textbook tracer fail, except in the two scenes where double fails."""
    monkeypatch.setattr(textbook, "F", np.float64)
    monkeypatch.setattr(textbook, "NONE", np.inf)
    path = ROOT / "bench/failures" / (failure["name"] + ".json")
    description = textbook.read(path)
    scale = max(np.abs(description["camera"][which]).max() for which in ("from", "at"))
    rgb, _, shape = textbook.draw(description, {"epsilon": 1e-9 * scale})
    exact = raylane.render(raylane.load(path)).to_bytes()
    off = drawings.steps(raylane.Image(rgb).to_bytes(), exact)
    assert off > 10000 if fails_in_double(failure) else off <= 0.001 * shape.size


@pytest.fixture(scope="module")
def drawn():
    """The failures' texts and their images."""
    return drawings.draw_failures()


def test_textbook_fails_everywhere_and_double_in_its_two_scenes(drawn):
    for failure, images in zip(FAILURES, drawn[1]):
        numbers = {picture.name: picture.numbers for picture in images.pictures}
        assert numbers["textbook"]["off"] > 300
        assert numbers["double"]["off"] > 10000 if fails_in_double(failure) else numbers["double"]["off"] <= 3
        assert numbers["exact"] == {"off": 0, "wrong": 0, "ulps": [0.0, 0.0, 0.0]}


def test_readme_matches_the_rendered_failures(drawn):
    assert gallery.text_of(*drawn) == (ROOT / "bench/failures/README.md").read_text()


def rationals(numbers):
    return [fractions.Fraction(float(number)) for number in numbers]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


@pytest.mark.parametrize("name", ["pbrt-265", "pbrt-44-far", "mitsuba-512", "mitsuba-1236", "plotoptix-4", "double-shells"])
def test_rays_hit_the_spheres_that_rational_arithmetic_finds(name):
    """Rays hit the outer one of two concentric spheres."""
    path = ROOT / "bench/failures" / f"{name}.json"
    description = textbook.read(path)
    origins, directions = (rays[::11] for rays in textbook.camera_rays(description))
    found = raylane.Tracer(raylane.load(path)).intersect(origins, directions)
    spheres = [(rationals(each["center"]), fractions.Fraction(float(each["radius"]))) for each in description["objects"]]
    nested = name == "double-shells"
    hits = 0
    for hit, shape, o, d in zip(found.hit, found.shape_id, map(rationals, origins), map(rationals, directions)):
        crossed = []
        for number, (center, radius) in enumerate(spheres):
            f = [x - c for x, c in zip(o, center)]
            b = dot(f, d)
            if b < 0 and b * b >= dot(d, d) * (dot(f, f) - radius * radius):
                crossed.append(number)
        assert hit == bool(crossed)
        if hit:
            hits += 1
            assert shape in crossed
            assert not nested or shape == max(crossed)
    assert hits > 500


def test_hits_are_compared_by_shape_and_ulps():
    t = np.array([1, 1 + 2**-22, np.inf, 1, 2], np.float32)
    exact = np.array([1, 1, np.inf, np.inf, 2], np.float32)
    shape, exact_shape = np.array([0, 0, -1, 0, 1]), np.array([0, 0, -1, -1, 0])
    assert drawings.compare_hits(t, shape, exact, exact_shape) == {"wrong": 2, "ulps": [1.0, pytest.approx(1.98), 2.0]}
    assert drawings.compare_hits(t[2:3], shape[2:3], exact[2:3], exact_shape[2:3])["ulps"] == [0.0, 0.0, 0.0]


def test_images_of_several_sizes_are_refused(tmp_path):
    scene = raylane.load(ROOT / "scenes/sphere.json")
    (tmp_path / "some").mkdir()
    for width in (4, 5):
        raylane.render(scene, width=width, height=4, grid=1).save(tmp_path / f"some/{width}.png")
    with pytest.raises(ValueError, match="several sizes"):
        pictures.of_folder(tmp_path)


def test_data_and_script_cannot_close_their_elements():
    name = "</script><!--/*SCRIPT*/"
    page = report.page_of({"name": name}, "let a = '</script><!--';", "b {}", "<c>")
    assert page.count("</script>") == 2 and "<!--" not in page.split("<body>")[1]
    data = page.split('id="data">')[1].split("</script>")[0]
    assert json.loads(data) == {"name": name}
    assert "&lt;c&gt;" in page


def test_embree_has_the_speed_of_its_faster_call_and_speeds_are_medians(tmp_path):
    def runs(method, speeds):
        name = f"methods/sphere/random/{method}/avx512"
        more = {"run_type": "iteration", "run_name": name, "name": name, "ulps_p99": float("nan"), "wrong": 0.25}
        return [{**more, "items_per_second": 1e6 * speed} for speed in speeds]

    some = runs("exact", (3, 1, 2)) + runs("embree1", (5, 5, 5)) + runs("embree16", (1, 7, 7))
    (tmp_path / "chart.json").write_text(json.dumps({"benchmarks": some}))
    rows = {row["method"]: row for row in measurements.of_folder(tmp_path)["methods"]}
    assert {name: row["mrays"] for name, row in rows.items()} == {"exact": 2, "Embree": 7}
    assert rows["exact"]["wrong"] == 0.25 and "ulps_p99" not in rows["exact"]


@pytest.mark.parametrize(
    "files, words",
    [
        ({}, "nothing to show"),
        ({"chart.json": "{"}, "chart.json"),
        ({"pictures/a/b.png": "no picture"}, "b.png"),
        ({"errors.json": '{"rows": [{"psnr": 30}]}'}, "errors.json"),
    ],
)
def test_errors_are_one_line(tmp_path, files, words):
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    command = [sys.executable, str(ROOT / "bench/report.py"), str(tmp_path), "--build", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 2 and words in done.stderr and "Traceback" not in done.stderr
    assert not (tmp_path / "report.html").exists()
