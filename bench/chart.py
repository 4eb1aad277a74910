"""Turns the JSON of raylane-bench and of peers/run.sh into gnuplot commands for the figures of chart.sh.

    chart.py JSON methods RAYS ISA
    chart.py JSON pictures
    chart.py JSON peers
    chart.py JSON errors
"""

import json
import statistics
import sys

COLORS = {
    "fast": "#d7301f",
    "robust": "#e69f00",
    "exact": "#0072b2",
    "double": "#666666",
    "Embree": "#009e73",
    "raylane": "#0072b2",
}
MEANINGS = {
    "fast": "fast: float, textbook formulas",
    "robust": "robust: float, its best formulas",
    "exact": "exact: float bounds, double certified, exact where in doubt",
    "double": "double: robust's formulas in double",
    "Embree": "Embree 3: float, its own solvers; the faster way to call it",
}
CEILING = "the plainest loop in float, of this kind alone"
GREY = "#999999"


def runs_of(source, family):
    """Returns lists of runs of `family`, by the other parts of their names."""
    runs = {}
    with open(source) as file:
        for run in json.load(file)["benchmarks"]:
            first, *parts = run.get("run_name", run["name"]).split("/")
            if run.get("run_type") == "iteration" and first == family:
                runs.setdefault(tuple(parts), []).append(run)
    return runs


def median(runs, counter):
    return statistics.median(run[counter] for run in runs)


class Plot:
    """One panel: curves, each with a block of points in the script itself."""

    blocks = 0

    def __init__(self):
        self.curves = []

    def add(self, points, style):
        Plot.blocks += 1
        print("$points%d << END" % Plot.blocks)
        for point in points:
            print(*('"%s"' % value if isinstance(value, str) else "%g" % value for value in point))
        print("END")
        self.again(style)

    def again(self, style):
        """Adds the points of the last `add` in another style."""
        self.curves.append("$points%d %s" % (Plot.blocks, style))

    def draw(self):
        print("plot", ", ".join(self.curves))


def begin(title, layout, xlabel, ylabel):
    print("set multiplot layout %s title \"%s\" font ',14'" % (layout, title))
    print("set logscale y\nset format y '10^{%L}'\nset tics font ',9'")
    print("set grid ytics lc '#dddddd'")
    print("set xlabel '%s' offset 0,0.6 font ',9'" % xlabel)
    print("set ylabel '%s' offset 1.5 font ',9'" % ylabel)


def pareto_front(marks):
    """Returns those of the marks (speed, error, ...) that no other mark beats in both."""
    front, least = [], float("inf")
    for mark in sorted(marks, key=lambda mark: (-mark[0], mark[1])):
        if mark[1] < least:
            front.append(mark)
            least = mark[1]
    return front


def methods_figure(source, rays, isa):
    by_shape, places, ceilings = {}, {}, {}
    for (shape, which, method, on), runs in runs_of(source, "methods").items():
        if which != rays or on != isa:
            continue
        if method == "ceiling":
            ceilings[shape] = median(runs, "items_per_second") / 1e6
            continue
        name = "Embree" if method.startswith("embree") else method
        mark = (median(runs, "items_per_second") / 1e6, runs[0]["ulps_p99"], name, runs[0]["wrong"])
        marks = by_shape.setdefault(shape, {})
        if name not in marks or mark > marks[name]:  # the fastest way to call it
            marks[name] = mark
        if name != "Embree": # raylane's precisions register all shapes, in their order
            places[shape] = runs[0]["family_index"]
    if not by_shape:
        sys.exit("chart.sh: no measurements of %s rays by %s in %s" % (rays, isa, source))

    floor = 0.1 # ulps at the bottom of a panel
    begin("Nearest of 12 shapes, normals included: %s rays, one thread, %s" % (rays, isa),
          "%d,4" % (len(by_shape) // 4 + 1),  # with the key in the last row
          "million rays/s", "ulps of t, 99th percentile")
    for shape in sorted(by_shape, key=places.get):
        marks = [(speed, max(error, floor), name, wrong)
                 for speed, error, name, wrong in by_shape[shape].values()]
        print("set title '%s' offset 0,-0.6" % shape.replace("_", " "))
        ceiling = ceilings.get(shape)
        top = 8 * max(mark[1] for mark in marks)
        fastest = 1.2 * max([mark[0] for mark in marks] + [ceiling or 0])
        print("set xrange [0:%g]\nset xtics %g\nset yrange [%g:%g]" %
              (fastest, 50 if fastest > 100 else 20, floor, top))
        plot = Plot()
        if ceiling:
            plot.add([(ceiling, floor), (ceiling, top)], "with lines lw 1.5 lc 'black' notitle")
        plot.add([mark[:2] for mark in pareto_front(marks)],
                 "with lines lc '%s' dt 2 notitle" % GREY)
        for speed, error, name, wrong in marks:
            share = "" if wrong == 0 else " %.2g %% wrong" % (100 * wrong)
            plot.add([(speed, error, share)],
                     "with points pt 7 ps 1.1 lc '%s' notitle" % COLORS[name])
            plot.again("using 1:2:3 with labels center offset 0,0.8 font ',9' tc '%s' notitle" %
                       COLORS[name])
        plot.draw()
    named = {name for marks in by_shape.values() for name in marks}
    draw_key(["NaN with points pt 7 ps 1.4 lc '%s' title \"%s\"" % (color, MEANINGS[name])
              for name, color in COLORS.items() if name in named] +
             ["NaN with lines lw 1.5 lc 'black' title '%s'" % CEILING,
              "NaN with lines lc '%s' dt 2 title 'the best of these'" % GREY])


def draw_key(entries):
    """Draws the key in the last row, which holds nothing else."""
    print("unset title\nunset border\nunset tics\nunset grid\nunset logscale\nunset xlabel\n"
          "unset ylabel\nset xrange [0:1]\nset yrange [0:1]\n"
          "set key at 0,0.95 left top Left reverse samplen 1.5 spacing 1.5 font ',11'")
    print("plot", ", ".join(entries))
    print("unset multiplot")


def pictures_figure(source):
    scenes = {}
    for (scene, what, precision, value), runs in runs_of(source, "picture").items():
        scenes.setdefault(scene, {}).setdefault((what, precision), []).append(
            (int(value), 1000 * median(runs, "seconds"), runs[0]["rmse"]))
    if not scenes:
        sys.exit("chart.sh: no measurements of pictures in %s" % source)

    begin("What pictures cost and what they are off by, by samples per pixel: 400 pixels a row, "
          "one thread", "2,3", "milliseconds", "RMSE to 1,024 samples")
    print("set logscale x\nset format y '10^{%L}'\nset yrange [3e-4:1]\nset key off")
    print("set lmargin 9")
    for index, (scene, series) in enumerate(scenes.items()):
        print("set title '%s' offset 0,-0.6" % scene)
        plot = Plot()
        if index == len(scenes) // 2:  # below, left: there is room above its marks
            print("set key at graph 0.97,0.97 right top samplen 2 spacing 1.1 font ',9'")
        for precision, color in COLORS.items():
            points = sorted(series.get(("samples", precision), []))
            points = [(ms, error, str(samples)) for samples, ms, error in points]
            if not points:
                continue
            plot.add(points, "with linespoints pt 7 ps 0.7 lw 1.5 lc '%s' title '%s'" %
                     (color, precision))
            if precision == "exact":
                plot.again("using 1:2:3 with labels right offset -0.7,-0.4 font ',8' tc '%s' "
                           "notitle" % color)
        for what, title, mark, color in (("quality", "exact, to a quality", 5, "#cc79a7"),
                                         ("depth", "64 samples, fewer reflections", 6, "#7b3294"),
                                         ("weight", "64 samples, fewer faint paths", 4, "#008080")):
            points = [(ms, error) for _, ms, error in sorted(series.get((what, "exact"), []))
                      if error > 0]
            if points:
                plot.add(points, "with linespoints pt %d ps 0.8 dt 2 lc '%s' title '%s'" %
                         (mark, color, title))
        plot.draw()
        print("set key off")
    print("unset multiplot")


def speeds_by_count(rows, what):
    """Returns, for spheres: (number, speed of raylane's library, of its engine, Embree's best)."""
    points = []
    for row in rows:
        kind, _, count = row["scene"].partition("/")
        if kind != "spheres" or row["what"] != what:
            continue
        speeds = {result["name"]: result["median"] for result in row["by"]}
        others = [speed for name, speed in speeds.items() if not name.startswith(("raylane", "library"))]
        points.append((int(count), speeds[row["own"]], speeds[row["by"][0]["name"]],
                       max(others, default=0)))
    return sorted(points)


def peers_figure(source):
    with open(source) as file:
        rows = json.load(file)["rows"]
    rows = [row for row in rows if row["threads"] == 1 and row.get("isa") == rows[0].get("isa")]
    if not speeds_by_count(rows, "camera"):
        sys.exit("chart.sh: no measurements of spheres in %s" % source)

    begin("Uniform spheres of radius 0.3/n^{1/3} in the unit cube: one thread, %s" %
          rows[0]["isa"], "1,2", "n, spheres", "million rays/s")
    print("set logscale x\nset format x '10^{%L}'\nset format y '%g'\nset yrange [0.3:300]")
    print("set key top right samplen 2 spacing 1.3 font ',10'")
    for what in ("camera", "incoherent"):
        points = speeds_by_count(rows, what)
        print("set title '%s rays' offset 0,-0.6" % what)
        print("set xrange [%g:%g]" % (points[0][0] / 2, points[-1][0] * 2))
        plot = Plot()
        plot.add([(count, own, "%.1f" % (own / other) if other else "")
                  for count, own, _, other in points],
                 "with linespoints pt 7 lw 2 lc '%s' title "
                 "'raylane, and how many times Embree'" % COLORS["raylane"])
        plot.again("using 1:2:3 with labels center offset 0,-0.9 font ',9' tc '%s' notitle" %
                   COLORS["raylane"])
        plot.add([(count, engine) for count, _, engine, _ in points],
                 "with lines dt 2 lw 1 lc '%s' title 'its engine, by its own arrays'" % COLORS["raylane"])
        if all(other for *_, other in points):
            plot.add([(count, other) for count, *_, other in points],
                     "with linespoints pt 7 lw 2 lc '%s' title 'Embree, its best call'" %
                     COLORS["Embree"])
        plot.draw()
    print("unset multiplot")


def errors_figure(source):
    with open(source) as file:
        data = json.load(file)
    scenes = list(dict.fromkeys(row["scene"] for row in data["rows"]))
    begin("Time of the whole program, one thread, and what a picture of %d x %d is off by" %
          (data["size"], data["size"]), "%d,2" % ((len(scenes) + 1) // 2), "seconds",
          "dB to its converged one")
    print("unset logscale y\nset logscale x\nset format '%g'\nset yrange [15:60]\nset xrange [0.01:100]")
    print("set lmargin 10\nset ylabel offset 0\nset key bottom right samplen 2 spacing 1.2 font ',9'")
    names = {"raylane": ("raylane, as many samples in each pixel", COLORS["raylane"], 7),
             "raylane --quality": ("raylane --quality", "#cc79a7", 5),
             "povray": ("POV-Ray, +A +AM2 +R", COLORS["Embree"], 9),
             "tachyon": ("Tachyon, -aasamples", COLORS["robust"], 11)}
    for scene in scenes:
        print("set title '%s' offset 0,-0.6" % scene)
        plot = Plot()
        for name, (title, color, mark) in names.items():
            points = [(row["seconds"], row["psnr"]) for row in data["rows"]
                      if row["scene"] == scene and row["by"] == name and row["psnr"]]
            if points:
                plot.add(points, "with linespoints pt %d ps 0.8 lw 1.5 lc '%s' title '%s'" %
                         (mark, color, title))
        plot.draw()
        print("set key off")
    print("unset multiplot")


if __name__ == "__main__":
    figures = {"methods": methods_figure, "pictures": pictures_figure, "peers": peers_figure,
               "errors": errors_figure}
    figures[sys.argv[2]](sys.argv[1], *sys.argv[3:])
