"""Converts the JSON of raylane-bench and of peers/run.sh to rows for the page's charts."""

import json
import math

import chart
import machine


def methods(path):
    """Returns {shape, rays, isa, method, mrays, ulps_..., wrong}. Embree's row is the faster of its API calls."""
    best = {}
    for (shape, rays, method, isa), runs in chart.runs_of(path, "methods").items():
        name = "Embree" if method.startswith("embree") else method
        row = {
            "shape": shape,
            "rays": rays,
            "isa": isa,
            "method": name,
            "mrays": chart.median(runs, "items_per_second") / 1e6,
        }
        errors = {key: runs[0][key] for key in runs[0] if key.startswith("ulps_") or key == "wrong"}
        row.update({key: error for key, error in errors.items() if math.isfinite(error)})
        if not math.isfinite(row["mrays"]):
            raise ValueError(f"{shape} by {method}: the speed must be finite")
        key = (shape, rays, isa, name)
        if key not in best or row["mrays"] > best[key]["mrays"]:
            best[key] = row
    return list(best.values())


def pictures(path):
    """Returns {scene, way, value, ms, rmse}. `way` is the precision for samples, otherwise the varied setting."""
    rows = [
        {
            "scene": scene,
            "way": precision if what == "samples" else what,
            "value": float(value),
            "ms": 1000 * chart.median(runs, "seconds"),
            "rmse": runs[0]["rmse"],
        }
        for (scene, what, precision, value), runs in chart.runs_of(path, "picture").items()
        if "-" not in what  # of the widest instruction set
    ]
    # A converged image differs from itself by 0, which has no logarithm.
    return sorted((row for row in rows if row["rmse"] > 0), key=lambda row: (row["scene"], row["way"], row["ms"]))


def counts(path):
    """Returns {rays, by, count, mrays} for one thread and the instruction set of the first row."""
    rows = [row for row in json.loads(path.read_text())["rows"] if row["threads"] == 1 and row.get("unit", "Mrays/s") == "Mrays/s"]
    rows = [row for row in rows if row.get("isa") == rows[0].get("isa")]
    return [
        {"rays": f"{what} rays", "by": by, "count": count, "mrays": speed}
        for what in dict.fromkeys(row["what"] for row in rows)
        for count, *speeds in chart.speeds_by_count(rows, what)
        for by, speed in zip(("raylane", "raylane's engine", "Embree"), speeds)
        if speed
    ]


def peers(path):
    """Returns {scene, by, setting, seconds, psnr}."""
    keys = ("scene", "by", "setting", "seconds", "psnr")
    rows = [{key: row[key] for key in keys} for row in json.loads(path.read_text())["rows"]]
    return [row for row in rows if row["psnr"] and math.isfinite(row["psnr"])]


SOURCES = {
    "methods": (methods, "chart.json"),
    "pictures": (pictures, "chart.json"),
    "counts": (counts, "peers.json"),
    "peers": (peers, "errors.json"),
}


def small_prints_of(folder):
    """Returns the small print of each figure: the processor, versions, date and sizes that its source has."""
    texts = {}
    for name, (_, source) in SOURCES.items():
        path = folder / source
        document = json.loads(path.read_text()) if path.exists() else {}
        parts = [machine.small_print(document)]
        if name == "peers" and "threads" in document:
            parts += ["{threads} thread(s)".format(**document), "{size} x {size} pixels".format(**document)]
        texts[name] = "; ".join(part for part in parts if part)
    return texts


def of_folder(folder):
    """Returns the rows of each figure; empty if its source is missing."""
    rows = {}
    for name, (rows_of, source) in SOURCES.items():
        path = folder / source
        try:
            rows[name] = rows_of(path) if path.exists() else []
        except (ValueError, KeyError, TypeError, AttributeError, IndexError) as error:
            raise ValueError(f"{path}: expected measurements ({error!r})") from None
    return rows
