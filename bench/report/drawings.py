"""Renders the numerical failures and some of the shipped scenes, with the Python module."""

import json
import pathlib

import numpy as np
import raylane
import textbook
from pictures import Picture, Set

BENCH = pathlib.Path(__file__).resolve().parents[1]
SCENES = BENCH.parent / "scenes"
PRECISIONS = {"fast": "fast: textbook float, no epsilon", "robust": "robust: best float", "double": "double", "exact": "exact"}
SHIPPED = {"birthday": (256, 256), "sphereflake": (256, 256), "ellipsoid": (256, 192), "protein": (256, 192)}


def steps(srgb, exact):
    """Returns the number of pixels that differ by more than 1 of 255 in a channel."""
    return int((np.abs(srgb.astype(int) - exact) > 1).any(-1).sum())


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
    return np.where(hits.hit, hits.t, np.inf).astype(np.float32), np.where(hits.hit, hits.shape_id.astype(np.int64), -1)


def draw_failure(failure):
    path = BENCH / "failures" / (failure["name"] + ".json")
    description = textbook.read(path)
    scene = raylane.load(path)
    rays = textbook.camera_rays(description)
    rgb, t, shape = textbook.draw(description, failure["textbook"])
    drawn = {"textbook": (raylane.Image(rgb).to_bytes(), t.ravel(), shape.ravel())}
    for precision in PRECISIONS:
        drawn[precision] = (raylane.render(scene, precision=precision).to_bytes(), *first_hits(scene, precision, *rays))
    exact, *exact_hits = drawn["exact"]
    titles = {"textbook": "textbook float, with a remedy", **PRECISIONS}
    pictures = [
        Picture(name, titles[name], srgb, {"off": steps(srgb, exact), **compare_hits(*hits, *exact_hits)})
        for name, (srgb, *hits) in drawn.items()
    ]
    return Set(failure["name"], f"{failure['title']} ({failure['reference']})", pictures, "exact")


def draw_failures():
    """Returns the failures' texts, and a set of images for each."""
    failures = json.loads((BENCH / "failures/failures.json").read_text())
    texts = [{key: each[key] for key in ("name", "reference", "title", "failure", "remedy")} for each in failures]
    return texts, [draw_failure(each) for each in failures]


def draw_scene(name, width, height):
    scene = raylane.load(SCENES / f"{name}.json")

    def draw(name, title, **options):
        return Picture(name, title, raylane.render(scene, width=width, height=height, **options).to_bytes())

    pictures = [draw(each, f"{title}, 1 sample", precision=each, grid=1) for each, title in PRECISIONS.items()]
    pictures += [draw(f"exact-{n * n}", f"exact, {n * n} samples", grid=n) for n in (2, 4, 8)]
    return Set(name, name, [*pictures, draw("quality", "exact, to 40 dB", quality=40)], "exact")


def draw_scenes():
    return [draw_scene(name, *size) for name, size in SHIPPED.items()]
