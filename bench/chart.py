"""Turns the JSON of raylane-bench and of peers/run.sh into gnuplot commands for the figures of chart.sh.

    chart.py JSON methods RAYS [ISA...]    default: AVX-512 and AVX2 if both were measured, otherwise the widest
    chart.py JSON pictures
    chart.py JSON peers
    chart.py JSON errors
"""

import json
import math
import statistics
import sys

import machine

COLORS = {
    "fast": "#d7301f",
    "robust": "#e69f00",
    "exact": "#0072b2",
    "double": "#666666",
    "Embree": "#009e73",
    "raylane": "#0072b2",
}
# Open marks of several shapes and sizes, so that marks at one place all show.
MARKS = {"fast": 4, "robust": 8, "exact": 7, "double": 12, "Embree": 2}
SIZES = {"fast": 1.6, "robust": 1.2, "exact": 1.0, "double": 1.4, "Embree": 1.2}
MEANINGS = {
    "fast": "fast: textbook formulas in float",
    "robust": "robust: the best formulas in float",
    "exact": "exact: float bounds, certified in double, exact arithmetic in doubt",
    "double": "double: the formulas of robust in double",
    "Embree": "Embree 3: its own solvers in float, the faster of its calls",
}
CEILING = "upper bound: brute-force float loop for this shape"
GREY = "#999999"
ISAS = ("avx512", "avx2", "sse4.2", "neon", "portable")  # widest first


def runs_of(source, family):
    """Returns lists of runs of `family`, by the other parts of their names."""
    runs = {}
    with open(source) as file:
        for run in json.load(file)["benchmarks"]:
            first, *parts = run.get("run_name", run["name"]).split("/")
            if run.get("run_type") == "iteration" and first == family:
                runs.setdefault(tuple(parts), []).append(run)
    return runs


def document_of(source):
    with open(source) as file:
        return json.load(file)


def median(runs, counter):
    return statistics.median(run[counter] for run in runs)


def isas_to_draw(measured):
    """Returns AVX-512 and AVX2 if both were measured, otherwise the widest instruction set."""
    both = [isa for isa in ISAS[:2] if isa in measured]
    return both or [isa for isa in ISAS if isa in measured][:1]


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


def escaped(text):
    """Returns text for a double-quoted gnuplot string, whose enhanced mode reads some characters as commands."""
    return "".join("\\\\" + c if c in "_^@{}&~" else c for c in text if c not in '"\\`')


def begin(title, better, small_print, layout, xlabel, ylabel):
    lines = "{/=14 %s}\\n{/=10 %s}\\n{/=8 %s}" % (title, better, escaped(small_print) or " ")
    print("set multiplot layout %s title \"%s\"" % (layout, lines))
    print("set logscale y\nset format y '10^{%L}'\nset tics font ',9'")
    print("set grid ytics lt 1 lw 0.5 lc '#dddddd'")
    print("set xlabel '%s' offset 0,0.6 font ',9'" % xlabel)
    print("set ylabel '%s' offset 1.5 font ',9'" % ylabel)


def tick_step(range_end, most=4):
    """Returns 1, 2 or 5 times a power of ten, at least range_end / most."""
    step = 10 ** math.floor(math.log10(range_end / most))
    return next(step * factor for factor in (1, 2, 5, 10) if step * factor >= range_end / most)


def pareto_front(marks):
    """Returns the marks (speed, error, ...) that no other mark beats in both speed and error."""
    front, least = [], float("inf")
    for mark in sorted(marks, key=lambda mark: (-mark[0], mark[1])):
        if mark[1] < least:
            front.append(mark)
            least = mark[1]
    return front


class Panel:
    """Measurements of one shape: marks (speed, error, method, misclassified share) and upper bounds, by ISA."""

    def __init__(self):
        self.marks, self.ceilings, self.place = {}, {}, 0

    def add(self, method, isa, runs):
        speed = median(runs, "items_per_second") / 1e6
        if method == "ceiling":
            self.ceilings[isa] = speed
            return
        name = "Embree" if method.startswith("embree") else method
        mark = (speed, runs[0]["ulps_p99"], name, runs[0]["wrong"])
        marks = self.marks.setdefault(isa, {})
        if name not in marks or mark > marks[name]:  # the faster call
            marks[name] = mark
        if name != "Embree":  # raylane's precisions register all shapes, in their order
            self.place = runs[0]["family_index"]

    def all_marks(self):
        return [mark for marks in self.marks.values() for mark in marks.values()]


def overlap(a, b):
    """Returns the common area of two boxes (left, bottom, right, top)."""
    return max(0, min(a[2], b[2]) - max(a[0], b[0])) * max(0, min(a[3], b[3]) - max(a[1], b[1]))


class Labels:
    """Places labels beside marks of a panel where they hide the least. Units: about a pixel."""

    WIDTH, HEIGHT = 210, 140
    PLACES = (("center offset 0,0.9", 0, 14), ("center offset 0,-0.9", 0, -14),
              ("left offset 1,0", 1, 0), ("right offset -1,0", -1, 0))

    def __init__(self, xmax, floor, top):
        self.xmax, self.floor, self.top = xmax, floor, top
        self.taken = []

    def at(self, speed, error):
        return (self.WIDTH * speed / self.xmax,
                self.HEIGHT * math.log10(error / self.floor) / math.log10(self.top / self.floor))

    def keep_free(self, speed, error):
        x, y = self.at(speed, error)
        self.taken.append((x - 6, y - 6, x + 6, y + 6))

    def keep_free_between(self, mark, other):
        (x0, y0), (x1, y1) = self.at(*mark), self.at(*other)
        self.taken.append((min(x0, x1), min(y0, y1) - 1, max(x0, x1), max(y0, y1) + 1))

    def keep_free_line(self, speed):
        x = self.WIDTH * speed / self.xmax
        self.taken.append((x - 1, 0, x + 1, self.HEIGHT))

    def place(self, speed, error, text):
        """Returns gnuplot's placement of a label."""
        x, y = self.at(speed, error)
        half, best = 3.5 * len(text), None
        for placement, across, up in self.PLACES:
            middle = x + across * (8 + half)
            box = (middle - half, y + up - 7, middle + half, y + up + 7)
            area = (box[2] - box[0]) * (box[3] - box[1])
            hidden = sum(overlap(box, other) for other in self.taken)
            hidden += 2 * (area - overlap(box, (0, 0, self.WIDTH, self.HEIGHT)))
            if best is None or hidden < best[0]:
                best = (hidden, placement, box)
        self.taken.append(best[2])
        return best[1]


def methods_figure(source, rays, *isas):
    panels, measured = {}, set()
    for (shape, which, method, on), runs in runs_of(source, "methods").items():
        if which == rays:
            measured.add(on)
            panels.setdefault(shape, Panel()).add(method, on, runs)
    isas = [isa for isa in isas or isas_to_draw(measured) if isa in measured]
    panels = {shape: panel for shape, panel in panels.items() if isas and panel.marks.get(isas[0])}
    if not panels:
        sys.exit("chart.sh: no measurements of %s rays by %s in %s" % (rays, " ".join(isas), source))

    floor = 0.1  # ulps at the bottom of a panel
    for panel in panels.values():
        panel.marks = {isa: {name: (speed, max(error, floor), name, wrong)
                             for name, (speed, error, _, wrong) in panel.marks.get(isa, {}).items()}
                       for isa in isas}
        panel.ceilings = {isa: panel.ceilings[isa] for isa in isas if isa in panel.ceilings}
    worst = max(mark[1] for panel in panels.values() for mark in panel.all_marks())
    top = worst * max(10, worst / floor) ** 0.22  # room for a label
    rows = len(panels) // 4 + 1  # with the key in the last row
    begin("Speed and error of the nearest hit among 12 shapes, with normals: %s rays, one thread" % rays,
          "Lower right is better: faster and more accurate. p99: 99th percentile.",
          machine.small_print(document_of(source), isas, ("raylane", "Embree")), "%d,4" % rows,
          "million rays/s", "error of t [ulp], p99")
    print("set lmargin 8\nset rmargin 2\nset mytics 1")
    print("set yrange [%g:%g]\nset ytics 0.1,%d" % (floor, top, 100 if top / floor > 1e4 else 10))
    for shape in sorted(panels, key=lambda shape: panels[shape].place):
        panel = panels[shape]
        print("set title '%s' offset 0,-0.6" % shape.replace("_", " "))
        xmax = 1.1 * max([mark[0] for mark in panel.all_marks()] + list(panel.ceilings.values()))
        print("set xrange [0:%g]\nset xtics 0,%g" % (xmax, tick_step(xmax)))
        draw_methods(panel, isas, Labels(xmax, floor, top))
    drawn = {mark[2] for panel in panels.values() for mark in panel.all_marks()}
    draw_key(["NaN with points pt %d ps %g lw 1.5 lc '%s' title \"%s\"" %
              (MARKS[name], SIZES[name], color, MEANINGS[name])
              for name, color in COLORS.items() if name in drawn] +
             ["NaN with lines lw 1.5 lc 'black' title '%s'" % CEILING,
              "NaN with lines lc '%s' dt 2 title 'Pareto front'" % GREY,
              "NaN with dots lc 'white' title 'number at a mark: misclassified rays [%]'"] +
             ["NaN with linespoints pt 6 ps 0.6 lw 0.5 lc 'black' title "
              "'small mark, dotted upper bound: %s'" % machine.ISA_NAMES.get(isa, isa) for isa in isas[1:]])


def draw_methods(panel, isas, labels):
    first, *others = isas
    plot = Plot()
    for isa, ceiling in panel.ceilings.items():
        labels.keep_free_line(ceiling)
        plot.add([(ceiling, labels.floor), (ceiling, labels.top)],
                 "with lines lw 1.5 lc 'black' %s notitle" % ("" if isa == first else "dt 3"))
    plot.add([mark[:2] for mark in pareto_front(panel.marks[first].values())],
             "with lines lc '%s' dt 2 notitle" % GREY)
    for name, mark in panel.marks[first].items():
        color = COLORS[name]
        for isa in others:
            if name in panel.marks[isa]:  # joined to the mark of the first instruction set
                labels.keep_free_between(panel.marks[isa][name][:2], mark[:2])
                plot.add([panel.marks[isa][name][:2], mark[:2]], "with lines lw 0.5 lc '%s' notitle" % color)
                plot.add([panel.marks[isa][name][:2]],
                         "with points pt %d ps %g lc '%s' notitle" % (MARKS[name], SIZES[name] / 2, color))
        plot.add([mark[:2]],
                 "with points pt %d ps %g lw 1.5 lc '%s' notitle" % (MARKS[name], SIZES[name], color))
    for mark in panel.all_marks():
        labels.keep_free(*mark[:2])
    for speed, error, name, wrong in panel.marks[first].values():
        if wrong > 0:
            text = "%.2g" % (100 * wrong)
            plot.add([(speed, error, text)], "using 1:2:3 with labels %s font ',9' tc '%s' notitle" %
                     (labels.place(speed, error, text), COLORS[name]))
    plot.draw()


def draw_key(entries):
    """Draws the key in the last row, which holds nothing else."""
    print("unset title\nunset border\nunset tics\nunset grid\nunset logscale\nunset xlabel\n"
          "unset ylabel\nset xrange [0:1]\nset yrange [0:1]\n"
          "set key at 0,0.95 left top Left reverse maxrows 5 samplen 1.5 spacing 1.4 width -4 "
          "font ',10'")
    print("plot", ", ".join(entries))
    print("unset multiplot")


def interval(values):
    return "%g to %g" % (min(values), max(values))


def pictures_figure(source):
    scenes = {}
    for (scene, what, precision, value), runs in runs_of(source, "picture").items():
        scenes.setdefault(scene, {}).setdefault((what, precision), []).append(
            (int(value), 1000 * median(runs, "seconds"), runs[0]["rmse"]))
    if not scenes:
        sys.exit("chart.sh: no measurements of images in %s" % source)

    document = document_of(source)
    isas = [isa for isa in [document.get("context", {}).get("isa")] if isa]
    isas += sorted({what.partition("-")[2] for series in scenes.values() for what, _ in series if "-" in what})
    begin("Time and error of whole images, 400 pixels wide, one thread",
          "Lower left is better: faster and more accurate. Numbers: samples per pixel. "
          "Depth and weight limits: 64 samples per pixel.",
          machine.small_print(document, isas, ("raylane",)), "%d,3" % ((len(scenes) + 2) // 3),
          "time per image [ms]", "RMSE to 1,024 samples per pixel")
    print("set logscale x\nset format y '10^{%L}'\nset yrange [3e-4:1]\nset key off")
    print("set lmargin 9\nset style textbox opaque noborder margins 0.3,0.3 fillcolor 'white'")
    points_of = {scene: [point for points in series.values() for point in points] for scene, series in scenes.items()}
    roomiest = min(scenes, key=lambda scene: max(error for *_, error in points_of[scene]))
    for scene, series in sorted(scenes.items()):
        times = [ms for _, ms, _ in points_of[scene]]
        print("set title '%s' offset 0,-0.6\nset xrange [%g:%g]" % (scene, min(times) / 2.5, 1.5 * max(times)))
        plot = Plot()
        if scene == roomiest:  # free above its marks
            print("set key at graph 0.97,0.97 right top samplen 2 spacing 0.9 font ',9'")
        labels = []
        for precision, color in COLORS.items():
            points = sorted(series.get(("samples", precision), []))
            points = [(ms, error, str(samples)) for samples, ms, error in points]
            if not points:
                continue
            plot.add(points, "with linespoints pt %d ps %g lw 1.2 lc '%s' title '%s'" %
                     (MARKS[precision], 0.7 * SIZES[precision], color, precision))
            if precision == "exact":
                labels = points
        for isa in isas[1:]:
            points = [(ms, error) for _, ms, error in sorted(series.get(("samples-" + isa, "exact"), []))]
            plot.add(points, "with linespoints pt %d ps 0.5 lw 1.2 dt 3 lc '%s' title 'exact, %s'" %
                     (MARKS["exact"], COLORS["exact"], machine.ISA_NAMES[isa]))
        for what, title, mark, color in (("quality", "exact, quality %s dB", 5, "#cc79a7"),
                                         *(("quality-" + isa, "the same, " + machine.ISA_NAMES[isa], 4, "#cc79a7")
                                           for isa in isas[1:]),
                                         ("depth", "exact, depth limit %s", 6, "#7b3294"),
                                         ("weight", "exact, weight limit %s", 10, "#008080")):
            varied = sorted(series.get((what, "exact"), []))
            points = [(ms, error) for _, ms, error in varied if error > 0]
            values = [value for each in scenes.values() for value, *_ in each.get((what, "exact"), [])]
            if values and "%" in title:
                title %= interval([value / (1000 if what == "weight" else 1) for value in values])
            if values:
                style = "with linespoints pt %d ps 0.8 dt 2 lc '%s' title '%s'" % (mark, color, title)
                if points:
                    plot.add(points, style)
                else:  # for the key
                    plot.curves.append("NaN " + style)
        if labels:
            plot.add(labels, "using 1:2:3 with labels boxed right offset -0.8,-0.5 font ',8' tc '%s' "
                     "notitle" % COLORS["exact"])
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
    document = document_of(source)
    rows = [row for row in document["rows"] if row["threads"] == 1]
    isas = isas_to_draw({row.get("isa") for row in rows if speeds_by_count([row], "camera")})
    if not isas:
        sys.exit("chart.sh: no measurements of spheres in %s" % source)

    names = [machine.ISA_NAMES[isa] for isa in isas]
    begin("Rays per second against the number of uniform spheres of radius 0.3/n^{1/3} in the unit cube, one thread",
          "Higher is better. Top axis: speed of raylane's library relative to Embree, %s." % names[0],
          machine.small_print(document, isas, ("raylane", "Embree")), "1,3", "number of spheres n", "million rays/s")
    print("set logscale x\nset logscale x2\nset format x '10^{%L}'\nset format y '%g'\nset yrange [0.3:300]")
    print("set xtics nomirror\nset key top right samplen 2 spacing 1.2 font ',9'")
    for what in ("camera", "diffuse", "shadow"):
        by_isa = {isa: speeds_by_count([row for row in rows if row.get("isa") == isa], what) for isa in isas}
        points = by_isa[isas[0]]
        print("set title '%s rays' offset 0,-0.6" % what)
        limits = (points[0][0] / 2, points[-1][0] * 2)
        print("set xrange [%g:%g]\nset x2range [%g:%g]" % (*limits, *limits))
        ratios = ["'%.1f' %g" % (own / other, count) for count, own, _, other in points if other]
        print("set x2tics (%s) scale 0 offset 0,-0.4 tc '%s'" % (", ".join(ratios), COLORS["raylane"])
              if ratios else "unset x2tics")
        plot = Plot()
        for number, isa in enumerate(isas):
            draw_speeds(plot, by_isa[isa], names[number], is_first=number == 0)
        plot.draw()
    print("unset multiplot")


def draw_speeds(plot, points, isa, is_first):
    """Adds speeds of one instruction set: filled marks for the first, open and dotted for the second."""
    if not points:
        return
    ours, embree, line = (7, 5, "lw 2") if is_first else (6, 4, "lw 1 dt 3")
    plot.add([(count, own) for count, own, *_ in points],
             "with linespoints pt %d %s lc '%s' title \"raylane's library, %s\"" %
             (ours, line, COLORS["raylane"], isa))
    if is_first:
        plot.add([(count, engine) for count, _, engine, _ in points],
                 "with lines dt 2 lw 1 lc '%s' title \"raylane's engine, internal arrays, %s\"" %
                 (COLORS["raylane"], isa))
    if all(other for *_, other in points):
        plot.add([(count, other) for count, *_, other in points],
                 "with linespoints pt %d %s lc '%s' title 'Embree, fastest call, %s'" %
                 (embree, line, COLORS["Embree"], isa))


def errors_figure(source):
    data = document_of(source)
    scenes = list(dict.fromkeys(row["scene"] for row in data["rows"]))
    isas = [isa for isa in data.get("machine", {}).get("isa", "").split() if isa]
    begin("Time and error of whole programs, images of %d x %d pixels, %d thread%s" %
          (data["size"], data["size"], data.get("threads", 1), "s" if data.get("threads", 1) > 1 else ""),
          "Upper left is better: faster and more accurate. "
          "PSNR [dB] against the renderer's own converged image.",
          machine.small_print(data, isas, ("raylane", "POV-Ray", "Tachyon")),
          "%d,2" % ((len(scenes) + 1) // 2), "wall-clock time [s]", "PSNR [dB]")
    print("unset logscale y\nset logscale x\nset format '%g'\nset yrange [25:60]\nset xrange [0.01:100]")
    print("set lmargin 10\nset ylabel offset 0\nset key top left Left reverse samplen 2 spacing 1.2 font ',9'")
    names = {}
    for name, title, color, marks in (("raylane", "raylane, fixed samples per pixel", COLORS["raylane"], (7, 6)),
                                      ("raylane --quality", "raylane --quality", "#cc79a7", (5, 4))):
        for isa in isas or [""]:
            is_first = isa in isas[:1] or not isas
            names[name if is_first else name + " --isa " + isa] = (
                title + (", " + machine.ISA_NAMES[isa] if len(isas) > 1 else ""), color,
                "pt %d" % marks[0] if is_first else "pt %d dt 3" % marks[1])
    names["povray"] = ("POV-Ray, +A +AM2 +R", COLORS["Embree"], "pt 9")
    names["tachyon"] = ("Tachyon, -aasamples", COLORS["robust"], "pt 11")
    present = {row["by"] for row in data["rows"]}
    for scene in scenes:
        rows = [row for row in data["rows"] if row["scene"] == scene and row["psnr"]]
        print("set title '%s' offset 0,-0.6" % scene)
        plot = Plot()
        for name, (title, color, mark) in names.items():
            points = [(row["seconds"], row["psnr"]) for row in rows if row["by"] == name]
            if points:
                plot.add(points, "with linespoints %s ps 0.8 lw 1.5 lc '%s' title '%s'" %
                         (mark, color, title))
        if "povray" in present and all(row["by"] != "povray" for row in rows):
            print("set label 1 'without POV-Ray, which has no sky light' at graph 0.03,0.94 left font ',9'")
        plot.draw()
        print("set key off\nunset label 1")
    print("unset multiplot")


if __name__ == "__main__":
    figures = {"methods": methods_figure, "pictures": pictures_figure, "peers": peers_figure,
               "errors": errors_figure}
    figures[sys.argv[2]](sys.argv[1], *sys.argv[3:])
