"""Fills a folder for bench/report.py: synthetic measurements, and two images of known shades.

    fixture.py FOLDER
"""

import itertools
import json
import pathlib
import sys

from PIL import Image

folder = pathlib.Path(sys.argv[1])
count = itertools.count(1)


def run(name, **counters):
    return [{"name": name, "run_name": name, "run_type": "iteration", **counters} for _ in range(3)]


runs = []
for rays, shape in itertools.product(("random", "hard"), ("sphere", "capped_cone")):
    for method in ("fast", "robust", "exact", "double", "embree1", "embree16", "ceiling"):
        errors = {"ulps_median": 0.25, "ulps_p99": next(count) / 4, "ulps_max": 70 + next(count), "wrong": next(count) / 1024}
        if method == "ceiling":
            errors = dict.fromkeys(errors, float("nan"))
        some = run(f"methods/{shape}/{rays}/{method}/avx512", family_index=0, **errors)
        for each, speed in zip(some, (11, 17, 12)):
            each["items_per_second"] = 1e6 * speed * next(count)
        runs += some
for scene, (what, value) in itertools.product(("birthday", "lattice"), (("samples", 4), ("quality", 40))):
    runs += run(f"picture/{scene}/{what}/exact/{value}", seconds=next(count) / 64, rmse=next(count) / 4096)
(folder / "chart.json").write_text(json.dumps({"benchmarks": runs}))

rows = [
    {
        "scene": f"spheres/{n}",
        "what": what,
        "threads": 1,
        "unit": "Mrays/s" if what != "build" else "s",
        "isa": "avx512",
        "own": "library",
        "by": [{"name": name, "median": next(count) * 1.5} for name in ("raylane exact", "library", "embree16")],
    }
    for n, what in itertools.product((10, 1000), ("build", "camera", "diffuse"))
]
(folder / "peers.json").write_text(json.dumps({"rows": rows}))
rows = [
    {"scene": scene, "by": by, "setting": setting, "seconds": next(count) / 8, "psnr": 20 + next(count) / 16}
    for scene, by, setting in itertools.product(("lattice", "protein"), ("raylane", "povray"), ("1", "4"))
]
(folder / "errors.json").write_text(json.dumps({"size": 512, "rows": rows}))

(folder / "pictures/known").mkdir(parents=True)
for name, shade in (("a", 188), ("b", 255)):
    Image.new("L", (4, 3), shade).save(folder / f"pictures/known/{name}.png")
