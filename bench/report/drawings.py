"""Renders the numerical failures and some of the shipped scenes, with the Python module and raylane-tiers."""

import json
import pathlib
import subprocess

import numpy as np
import raylane
import textbook
from pictures import Map, Picture, Set, encoded

BENCH = pathlib.Path(__file__).resolve().parents[1]
SCENES = BENCH.parent / "scenes"
PRECISIONS = {"fast": "fast: textbook float, no epsilon", "robust": "robust: best float", "double": "double", "exact": "exact"}
TIERS = [
    "certified: bounds in float, one crossing in double",
    "refined: all candidates in double with bounds, or in double-double; shadow rays surface by surface",
    "scalar: a crossing by scalar code, in double with bounds",
    "extended: more digits than double, or exact arithmetic",
    "reference: the whole path, as surfaces meet or too many follow each other",
]
SHIPPED = {"birthday": (256, 256), "sphereflake": (256, 256), "ellipsoid": (256, 192), "protein": (256, 192)}


def has_tiers(build):
    return (build / "bin/raylane-tiers").exists()


def tiers_of(build, scene, width, height):
    """Returns a list of one map; an empty list without raylane-tiers."""
    if not has_tiers(build):
        return []
    command = [build / "bin/raylane-tiers", scene, str(width), str(height)]
    done = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    head = f"P5\n{width} {height}\n{len(TIERS) - 1}\n".encode()
    assert done.stdout.startswith(head)
    values = np.frombuffer(done.stdout[len(head) :], np.uint8).reshape(height, width)
    return [Map("tiers", "stage that decided the rays", values, TIERS)]


def steps(rgb, exact):
    """Returns the number of pixels that differ by more than 1 of 255 in a channel, in sRGB."""
    return int((np.abs(encoded(rgb).astype(int) - encoded(exact)) > 1).any(-1).sum())


def compare_hits(t, shape, exact_t, exact_shape):
    """Returns the number of misclassified rays, and the error of t of the others in ulps of float: median, p99, maximum."""
    same = shape == exact_shape
    hit = same & np.isfinite(exact_t)
    # The bits of positive floats are ordered like the floats.
    off = np.abs(t[hit].astype(np.float32).view(np.int32).astype(np.int64) - exact_t[hit].view(np.int32))
    ulps = [float(np.percentile(off, share)) for share in (50, 99, 100)] if off.size else [0.0, 0.0, 0.0]
    return {"wrong": int((~same).sum()), "ulps": ulps}


def first_hits(scene, precision, origins, directions):
    """Returns t in float32, infinite without a hit, and the shape's number or -1."""
    hits = raylane.Tracer(scene, precision=precision).intersect(origins, directions)
    return np.where(hits.hit, hits.t, np.inf).astype(np.float32), np.where(hits.hit, hits.shape.astype(np.int64), -1)


def draw_failure(build, failure):
    path = BENCH / "failures" / (failure["name"] + ".json")
    description = textbook.read(path)
    scene = raylane.load(path)
    rays = textbook.camera_rays(description)
    rgb, t, shape = textbook.draw(description, failure["textbook"])
    drawn = {"textbook": (rgb, t.ravel(), shape.ravel())}
    for precision in PRECISIONS:
        drawn[precision] = (raylane.render(scene, precision=precision).rgb, *first_hits(scene, precision, *rays))
    exact, *exact_hits = drawn["exact"]
    titles = {"textbook": "textbook float, with a remedy", **PRECISIONS}
    pictures = [
        Picture(name, titles[name], rgb, {"off": steps(rgb, exact), **compare_hits(*hits, *exact_hits)})
        for name, (rgb, *hits) in drawn.items()
    ]
    height, width = exact.shape[:2]
    maps = tiers_of(build, path, width, height)
    return Set(failure["name"], f"{failure['title']} ({failure['reference']})", pictures, maps, "exact")


def draw_failures(build):
    """Returns the failures' texts, and a set of images for each."""
    failures = json.loads((BENCH / "failures/failures.json").read_text())
    texts = [{key: each[key] for key in ("name", "reference", "title", "failure", "remedy")} for each in failures]
    return texts, [draw_failure(build, each) for each in failures]


def draw_scene(build, name, width, height):
    scene = raylane.load(SCENES / f"{name}.json")

    def draw(**options):
        return raylane.render(scene, width=width, height=height, **options)

    pictures = [Picture(each, f"{title}, 1 sample", draw(precision=each, grid=1).rgb) for each, title in PRECISIONS.items()]
    pictures += [Picture(f"exact-{n * n}", f"exact, {n * n} samples", draw(grid=n).rgb) for n in (2, 4, 8)]
    of_quality = draw(quality=40, layers=True)
    pictures.append(Picture("quality", "exact, to 40 dB", of_quality.rgb))
    maps = [Map("samples", "samples, to 40 dB", of_quality.layers.samples)]
    return Set(name, name, pictures, maps + tiers_of(build, SCENES / f"{name}.json", width, height), "exact")


def draw_scenes(build):
    return [draw_scene(build, name, *size) for name, size in SHIPPED.items()]
