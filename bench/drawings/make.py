#!/usr/bin/env python3
"""Makes the drawings of ARCHITECTURE.md and the headers: SVG files beside this script.

    make.py [--raylane TOOL] [--out FOLDER]

Constants come from the source files. The script fails if a constant or a formula that it draws is missing there.
stages.svg shows counters and needs --raylane, the path of a built command line tool. packet.svg needs NumPy.
"""

import argparse
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
from xml.sax.saxutils import escape

FOLDER = pathlib.Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
FONT = "Verdana, 'DejaVu Sans', sans-serif"
TEXT, MUTED, LINE, PAPER = "#1b1f24", "#57606a", "#8c959f", "#ffffff"
BLUE, GREEN, ORANGE = "#0b5cad", "#0f7a4f", "#b54708"  # data and rays; certain; doubtful or inflated
PALE_BLUE, PALE_GREEN, PALE_ORANGE, PALE_GREY = "#dbe9f8", "#d3efe1", "#fde6d2", "#eceff2"
SMALL = 11


def source(name, pattern):
    """Returns the text that the pattern, or its group, matches in a source file. Exits if nothing matches."""
    found = re.search(pattern, (ROOT / name).read_text())
    if not found:
        sys.exit(f"{name}: must match {pattern}, found no match")
    return found[1] if found.groups() else found[0]


def constant(name, pattern):
    return int(source(name, pattern))


def thousands(number):
    return f"{number:,}"


def shown(number):
    """Returns a coordinate with at most one decimal."""
    text = f"{number:.1f}".removesuffix(".0")
    return "0" if text == "-0" else text


class Drawing:
    """An SVG drawing on white paper. Refuses text that is too small, leaves the paper or overlaps other text."""

    def __init__(self, width, height, title, small_print):
        assert width <= 720
        self.width, self.height, self.title = width, height, title
        self.parts, self.boxes = [], []
        self.text(16, 22, title, size=14, bold=True)
        for number, words in enumerate(reversed(small_print)):
            self.text(16, height - 10 - 14 * number, words, color=MUTED)

    def add(self, part):
        self.parts.append(part)

    def rect(self, x, y, width, height, fill=PALE_GREY, stroke=LINE, rounded=0):
        place = f'x="{shown(x)}" y="{shown(y)}" width="{shown(width)}" height="{shown(height)}"'
        corners = f' rx="{rounded}"' if rounded else ""
        self.add(f'<rect {place} fill="{fill}" stroke="{stroke}"{corners}/>')

    @staticmethod
    def stroke(color, width, dash):
        return f'stroke="{color}" stroke-width="{width}"' + (f' stroke-dasharray="{dash}"' if dash else "")

    def path(self, points, color=TEXT, width=1.2, dash=None, fill="none", closed=False):
        steps = " ".join(f"{shown(x)},{shown(y)}" for x, y in points)
        element = "polygon" if closed else "polyline"
        self.add(f'<{element} points="{steps}" fill="{fill}" {self.stroke(color, width, dash)}/>')

    def arrow(self, points, color=TEXT, width=1.2, dash=None):
        """A line with a head at its last point."""
        (x0, y0), (x1, y1) = points[-2:]
        length = math.hypot(x1 - x0, y1 - y0)
        ux, uy = (x1 - x0) / length, (y1 - y0) / length
        back = (x1 - 7 * ux, y1 - 7 * uy)
        self.path([*points[:-1], back], color, width, dash)
        sides = [(back[0] - side * uy, back[1] + side * ux) for side in (3.5, -3.5)]
        self.path([(x1, y1), *sides], color, 0.5, fill=color, closed=True)

    def circle(self, x, y, radius, color=TEXT, fill="none", width=1.2, dash=None):
        place = f'cx="{shown(x)}" cy="{shown(y)}" r="{shown(radius)}"'
        self.add(f'<circle {place} fill="{fill}" {self.stroke(color, width, dash)}/>')

    def text(self, x, y, words, size=SMALL, bold=False, color=TEXT, anchor="start"):
        assert size >= SMALL, words
        wide = len(words) * size * (0.66 if bold else 0.6)
        left = x - {"start": 0, "middle": wide / 2, "end": wide}[anchor]
        box = (left, y - 0.8 * size, left + wide, y + 0.2 * size)
        inside = 4 <= box[0] and box[2] <= self.width and 0 <= box[1] and box[3] <= self.height
        assert inside, f"off the paper: {words}"
        for other, its in self.boxes:
            apart = box[2] <= other[0] or other[2] <= box[0] or box[3] <= other[1] or other[3] <= box[1]
            assert apart, f"{words!r} overlaps {its!r}"
        self.boxes.append((box, words))
        weight = ' font-weight="bold"' if bold else ""
        place = f'x="{shown(x)}" y="{shown(y)}" text-anchor="{anchor}"'
        self.add(f'<text {place} font-size="{size}"{weight} fill="{color}">{escape(words)}</text>')

    def lines(self, x, y, many, **how):
        for number, words in enumerate(many):
            self.text(x, y + 15 * number, words, **how)

    def svg(self):
        size = f'width="{self.width}" height="{self.height}"'
        view = f'viewBox="0 0 {self.width} {self.height}"'
        head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} {view} role="img" font-family="{FONT}">'
        paper = f'<rect {size} fill="{PAPER}"/>'
        return "\n".join([head, f"<title>{escape(self.title)}</title>", paper, *self.parts, "</svg>", ""])


def ray_life():
    wavefront = "simd/wavefront/wavefront.hpp"
    wave = thousands(constant(wavefront, r"chunk_samples = (\d+);"))
    source(wavefront, r"wave_rays = chunk_samples;")
    waiting = constant(wavefront, r"deferred_waves = (\d+);")
    tile = constant("simd/wavefront/render.cpp", r"Wavefront::max_region\)\s+: (\d+);")
    steps = constant("simd/query/tracing.hpp", r"longest_walk = (\d+);")
    source("simd/query/paths.hpp", "struct Paths {")
    source("simd/query/hits.hpp", "struct Hits {")
    source("simd/units/trace_kernels.hpp", "struct Candidates {")
    drawing = Drawing(720, 600, "The life of a ray, with its queues", [
        f"Numbers: {wavefront}, simd/query/tracing.hpp, simd/wavefront/render.cpp.",
        "Drawn by bench/drawings/make.py. Steps are numbered as in ARCHITECTURE.md.",
    ])
    left, middle, right = 16, 238, 486

    def step(x, y, number, name, words, width=218):
        drawing.rect(x, y, width, 54, PALE_BLUE, BLUE, rounded=6)
        drawing.text(x + 10, y + 17, f"{number}  {name}", size=13, bold=True)
        drawing.lines(x + 10, y + 32, words)

    def queue(x, y, fills, cell=13.6):
        for number, fill in enumerate(fills):
            drawing.rect(x + cell * number, y, cell, 12, fill)

    for number, (name, words) in enumerate([
        ("Read", ["a reader gives values", "to a SceneBuilder"]),
        ("Build", ["validated scene, 16-wide", "tree, blocks of 16 shapes"]),
        ("View", ["the scene as plain data", "for the kernels"]),
        ("Tile", [f"a thread takes {tile} × {tile}", "pixels"]),
        ("Rays", [f"{wave} samples at a time,", "in Morton order of pixels"]),
    ]):
        y = 44 + 76 * number
        step(left, y, number + 1, name, words, 186)
        if number:
            drawing.arrow([(left + 93, y - 22), (left + 93, y)])
    drawing.arrow([(left + 186, 375), (220, 375), (220, 50), (middle, 50)], BLUE)

    # Down the middle: from a wave of rays to sorted hits.
    queue(middle, 44, [PALE_BLUE] * 16)
    drawing.text(middle, 70, f"wave: Paths, up to {wave} rays", color=BLUE)
    for y, number, name, words in [
        (88, 6, "Search", ["rounds rays to float, bounds t,", "keeps the two smallest bounds"]),
        (198, 7, "Certify", ["solves one shape in double; the", "uncertain: refined, at last exactly"]),
        (308, 8, "Look through", ["invisible surfaces: search again;", "contacts: the scalar tracer"]),
        (418, 9, "Sort", ["stable, by material; rays", "without a hit come last"]),
    ]:
        step(middle, y, number, name, words, 228)
    for y, fills, words, color in [
        (154, [PALE_ORANGE] * 16, "Candidates: bound, shape, next bound", ORANGE),
        (264, [PALE_GREEN] * 13 + [PALE_ORANGE] * 3, "Hits; lanes that were not certain", GREEN),
        (374, [PALE_GREEN] * 16, "Hits: t, normal, slot of each ray", GREEN),
    ]:
        drawing.arrow([(middle + 8, y - 12), (middle + 8, y)])
        queue(middle, y, fills)
        drawing.text(middle, y + 26, words, color=color)
        drawing.arrow([(middle + 8, y + 30), (middle + 8, y + 44)])
    drawing.arrow([(middle + 8, 74), (middle + 8, 88)])
    drawing.arrow([(middle + 8, 472), (middle + 8, 484)])
    queue(middle, 484, [PALE_GREEN] * 5 + [PALE_BLUE] * 4 + [PALE_ORANGE] * 3 + [PALE_GREY] * 4)
    drawing.text(middle, 510, "runs of one material, then no hit")

    # Up the right: from sorted hits to the next wave.
    for y, number, name, words in [
        (418, 10, "Shade", ["point, normal, colour of a run;", "shadow rays of each light"]),
        (308, 11, "Shadows", ["blocked, unblocked or doubtful;", f"doubtful: ≤ {steps} steps of nearest"]),
        (198, 12, "Spawn", ["reflected, transmitted and", "straight-on rays of enough weight"]),
    ]:
        step(right, y, number, name, words, 222)
    drawing.arrow([(middle + 13.6 * 16, 490), (right + 40, 490), (right + 40, 472)])
    for y, fills, words, color in [
        (396, [PALE_BLUE] * 12, "shadow rays to one light", BLUE),
        (286, [PALE_GREEN] * 12, "surfaces of the wave, run by run", GREEN),
    ]:
        drawing.arrow([(right + 8, y + 22), (right + 8, y + 10)])
        queue(right, y - 4, fills)
        drawing.text(right, y - 10, words, color=color)
        drawing.arrow([(right + 8, y - 20), (right + 8, y - 34)])
    drawing.arrow([(right + 8, 198), (right + 8, 180)])
    queue(right, 168, [PALE_BLUE] * 16)
    drawing.text(right, 162, "next wave, one deeper", color=BLUE)
    beyond = [f"Beyond {wave} rays, the", "later samples wait:", f"up to {waiting} deferred waves"]
    drawing.lines(right + 20, 96, beyond, color=MUTED)
    drawing.arrow([(right + 8, 150), (right + 8, 50), (middle + 13.6 * 16, 50)], BLUE)

    # The film.
    step(left, 452, 13, "Add", ["to its sample, in double;", "then the mean of a pixel"], 186)
    drawing.arrow([(middle, 490), (left + 186, 490)])
    drawing.path([(right + 222, 335), (714, 335), (714, 530)], GREEN)
    drawing.path([(right + 222, 445), (714, 445)], GREEN)
    drawing.arrow([(714, 530), (left + 93, 530), (left + 93, 506)], GREEN)
    drawing.text(middle, 545, "each contribution of light, with the number of its sample", color=GREEN)
    return drawing


def node_and_block():
    node, block = "core/hierarchy/hierarchy.hpp", "core/shapes/block.hpp"
    size = constant(block, r"block_size = (\d+);")
    for row in ("float lower[3][block_size];", "float upper[3][block_size];", "Child children[block_size];"):
        source(node, re.escape(row))
    index = constant(node, r"max_index = \(1U << (\d+)\) - 1")
    kind = constant(node, r"leaf_bit = 1U << (\d+);") - index
    source("core/shapes/types.hpp", r"struct SphereOf {\s+Vec3<Number> center;\s+Number radius;")
    names = ["center.x", "center.y", "center.z", "radius", "ids"]
    drawing = Drawing(720, 404, "A wide node and one of its leaves, structure of arrays", [
        f"Sizes: {node} (WideNode, Child), {block} (Block).",
        "Drawn by bench/drawings/make.py.",
    ])
    cell, top = 15, 76
    node_x, block_x = 92, 458
    entry, children, shapes = 5, 11, 13

    def rows(x, names, filled, pointing):
        for number, name in enumerate(names):
            y = top + 22 * number
            drawing.text(x - 6, y + 12, name, anchor="end")
            for lane in range(size):
                fill = PALE_GREEN if name in ("children", "ids") else PALE_BLUE
                fill = PALE_GREY if lane >= filled else PALE_ORANGE if lane == pointing else fill
                drawing.rect(x + cell * lane, y, cell, 16, fill)

    boxes = [f"{end}.{axis}" for end in ("lower", "upper") for axis in "xyz"] + ["children"]
    drawing.text(16, 48, f"WideNode: {size} children, {4 * size * len(boxes)} bytes", bold=True)
    drawing.text(392, 48, f"Block<Sphere>: {size} shapes, {4 * size * len(names)} bytes", bold=True)
    for x in (node_x, block_x):
        for lane in (0, entry, size - 1):
            drawing.text(x + cell * (lane + 0.5), 68, str(lane), color=MUTED, anchor="middle")
    rows(node_x, boxes, children, entry)
    rows(block_x, names, shapes, None)
    y = top + 22 * 6 + 16
    x = node_x + cell * (entry + 0.5)
    under = top + 22 * 4 + 17
    drawing.arrow([(x, y), (x, y + 14), (block_x + 60, y + 14), (block_x + 60, under)], ORANGE)
    drawing.text(block_x + 70, under + 28, "a leaf: one block of one kind", color=ORANGE)

    # The reference from an entry to a block.
    y = 268
    drawing.text(16, y + 13, "a Child:")
    for x, width, words, fill in (
        (92, 50, "1 bit", PALE_ORANGE),
        (142, 70, f"{kind} bits", PALE_GREEN),
        (212, 274, f"{index} bits", PALE_BLUE),
    ):
        drawing.rect(x, y, width, 18, fill)
        drawing.text(x + width / 2, y + 13, words, anchor="middle")
    for x, words in ((117, "leaf"), (177, "kind"), (349, "index of a node, or of a block")):
        drawing.text(x, y + 32, words, anchor="middle")
    # A row in registers.
    y = 316
    drawing.lines(16, y + 12, [
        f"One row is {size} floats, {4 * size} bytes: one register of AVX-512, two of AVX2, four of SSE or NEON.",
        f"With AVX-512, one instruction handles a row for one ray: {size} boxes, or {size} shapes.",
        "Grey: an empty entry has lower > upper; an empty lane has NaN and no_shape. 11 and 13 are examples.",
    ])
    return drawing


def sphere_filter():
    header = "simd/kernel/shapes/sphere.hpp"
    ulps = constant(header, r"rounding = F\((\d+) \* half_ulp\) \* \(abs\(tau\) \+ radius\);")
    for line in ("error = rounding + rays.slack;", "outer = radius + error, inner = radius - error;",
                 "entry = tau - outer_half - rounding;", "tau - inner_half + rounding"):
        source(header, re.escape(line))
    source("simd/kernel/shapes/filter.hpp", "half_ulp = 0x1p-24F;")
    x, y, radius, error, rounding, foot = 330, 196, 112, 26, 9, 66
    origin = 46
    tau = (x - origin) / radius
    real = ulps * 2.0**-24 * (tau + 1)
    outer, exact, inner = (math.sqrt(r * r - foot * foot) for r in (radius + error, radius, radius - error))
    scale = thousands(int(round(error / radius / real, -3)))
    drawing = Drawing(720, 446, "The filter of a sphere: bounds on t from an inflated and a deflated sphere", [
        f"Formulas: {header}, SphereFilter. Drawn by bench/drawings/make.py.",
        f"With r = 1, |τ| = {tau:.1f} and no slack, E = {real:.1e}; E is drawn {scale} times as large.",
    ])
    drawing.circle(x, y, radius + error, ORANGE, PALE_ORANGE, dash="5 3")
    drawing.circle(x, y, radius - error, GREEN, PALE_GREEN, dash="5 3")
    drawing.circle(x, y, radius, BLUE, width=1.8)
    line = y - foot
    drawing.arrow([(origin, line), (x + 190, line)], TEXT, 1.5)
    drawing.circle(origin, line, 3, TEXT, TEXT)
    drawing.text(origin - 6, line - 9, "origin")
    drawing.text(x + 172, line - 9, "d, of length 1", anchor="start")
    drawing.path([(x, y), (x, line)], TEXT, 1.2, "3 3")
    drawing.path([(x, line + 8), (x - 8, line + 8), (x - 8, line)])
    drawing.circle(x, y, 2.5, TEXT, TEXT)
    drawing.text(x + 7, y - 24, "q", bold=True)
    drawing.text(x - 8, y - 4, "centre", anchor="end")
    drawing.text(x, line - 8, "foot", anchor="middle")
    for r, angle, color in ((radius - error, 150, GREEN), (radius, 92, BLUE), (radius + error, 35, ORANGE)):
        a = math.radians(angle)
        drawing.arrow([(x, y), (x + r * math.cos(a), y + r * math.sin(a))], color)
    drawing.text(x - 50, y + 50, "r − E", color=GREEN)
    drawing.text(x - 9, y + 101, "r", color=BLUE, anchor="end")
    drawing.text(x + 118, y + 92, "r + E", color=ORANGE)
    # Three crossings, and the axis of t.
    axis = 356
    low, t, high = x - outer - rounding, x - exact, x - inner + rounding
    drawing.rect(low, axis - 6, high - low, 12, PALE_ORANGE, ORANGE)
    drawing.arrow([(origin, axis), (x + 190, axis)])
    drawing.text(x + 196, axis + 4, "t")
    for at, color in ((x - outer, ORANGE), (t, BLUE), (x - inner, GREEN)):
        drawing.circle(at, line, 3.5, color, color)
        drawing.path([(at, line), (at, axis)], color, 1, "2 3")
    drawing.path([(x, line), (x, axis + 5)], MUTED, 1, "2 3")
    drawing.path([(origin, line), (origin, axis + 5)], MUTED, 1, "2 3")
    drawing.text(origin, axis + 20, "0", anchor="middle")
    drawing.text(low, axis + 20, "lower", color=ORANGE, anchor="middle")
    drawing.text(t, axis + 20, "t", color=BLUE, anchor="middle")
    drawing.text(high + 4, axis + 20, "upper", color=GREEN, anchor="middle")
    drawing.text(x, axis + 20, "τ", anchor="middle")
    drawing.text(origin, axis + 40, "lower = τ − √((r + E)² − q²) − rounding", color=ORANGE)
    drawing.text(origin + 300, axis + 40, "upper = τ − √((r − E)² − q²) + rounding", color=GREEN)
    drawing.lines(504, 158, ["τ = −f · d, f = origin − centre", "q = f + τ d"], color=TEXT)
    drawing.lines(504, 200, [f"rounding = {ulps} u (|τ| + r)", "E = rounding + slack", "u = 2⁻²⁴"])
    drawing.text(504, 256, "|q| > r + E: no crossing", color=MUTED)
    drawing.text(504, 274, "between: possible", color=ORANGE)
    drawing.text(504, 292, "|q| < r − E: certain", color=GREEN)
    return drawing


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def plus(a, s, b):
    """a + s b"""
    return tuple(x + s * y for x, y in zip(a, b))


def cylinder_foot():
    header = "core/shapes/cylinder.hpp"
    for name in ("across_origin", "across_direction"):
        source("core/shapes/axial.hpp", rf"Vec3<Real> {name};")
    source(header, r"across_direction")
    base, axis, radius = (0.0, 0.0, 0.0), (0.0, 0.0, 2.6), 1.0
    origin, direction = (-0.96, -2.28, 0.45), (0.57, 0.76, 0.31)
    f = plus(origin, -1, base)
    across_origin = plus(f, -dot(f, axis) / dot(axis, axis), axis)
    across_direction = plus(direction, -dot(direction, axis) / dot(axis, axis), axis)
    speed = dot(across_direction, across_direction)
    tau = -dot(across_origin, across_direction) / speed
    foot = plus(across_origin, tau, across_direction)
    half = math.sqrt((radius**2 - dot(foot, foot)) / speed)
    distance, entry, leaves = math.sqrt(dot(foot, foot)), tau - half, tau + half
    drawing = Drawing(720, 420, "The foot of the perpendicular at a cylinder", [
        f"Formulas: {header} and core/shapes/axial.hpp (AxialRay). Drawn by bench/drawings/make.py",
        f"from one cylinder and one ray: |foot| = {distance:.2f} r, τ = {tau:.2f}, t = {entry:.2f} and {leaves:.2f}.",
    ])

    # An oblique view: x to the right, y into the paper, z upwards.
    def seen(point):
        return (200 + 66 * point[0] + 30 * point[1], 280 - 66 * point[2] - 24 * point[1])

    def ring(height):
        angles = [2 * math.pi * k / 72 for k in range(72)]
        return [seen((radius * math.cos(a), radius * math.sin(a), height)) for a in angles]

    drawing.text(16, 48, "in space", bold=True)
    drawing.path(ring(0.0), BLUE, 1.2, fill=PALE_BLUE, closed=True)
    drawing.path(ring(axis[2]), BLUE, 1.2, fill=PALE_BLUE, closed=True)
    for side in (min, max):
        lower, upper = (side(ring(height), key=lambda p: p[0]) for height in (0.0, axis[2]))
        drawing.path([lower, upper], BLUE, 1.2)
    drawing.arrow([seen(base), seen(plus(axis, 0.12, axis))], MUTED, 1.2, "4 3")
    drawing.text(seen(axis)[0] + 8, seen(axis)[1] + 6, "axis", color=MUTED)
    drawing.circle(*seen(base), 2.5, MUTED, MUTED)
    drawing.text(seen(base)[0] - 7, seen(base)[1] + 1, "base", color=MUTED, anchor="end")
    ends = [plus(origin, t, direction) for t in (0.0, tau - half, tau, tau + half, tau + 1.7)]
    # Its projection along the axis, into the plane of the base.
    drawing.path([seen(plus(across_origin, t, across_direction)) for t in (0.0, tau + half)], ORANGE, 1.2, "4 3")
    drawing.path([seen(origin), seen(across_origin)], LINE, 1, "2 3")
    drawing.path([seen(ends[2]), seen(foot)], LINE, 1, "2 3")
    drawing.path([seen(base), seen(foot)], GREEN, 1.8)
    drawing.path([seen((0.0, 0.0, ends[2][2])), seen(ends[2])], GREEN, 1.8)
    drawing.arrow([seen(ends[0]), seen(ends[4])], TEXT, 1.5)
    drawing.circle(*seen(origin), 3, TEXT, TEXT)
    drawing.text(seen(origin)[0] - 8, seen(origin)[1] + 4, "origin", anchor="end")
    for at in (ends[1], ends[3]):
        drawing.circle(*seen(at), 3.5, BLUE, BLUE)
    drawing.circle(*seen(ends[2]), 3.5, GREEN, GREEN)
    drawing.text(16, 372, "dashed: the ray without its part along the axis", color=ORANGE)

    # Along the axis.
    def flat(point):
        return (552 + 72 * point[0], 196 - 72 * point[1])

    drawing.text(384, 48, "seen along the axis", bold=True)
    drawing.circle(*flat(base), 72 * radius, BLUE, PALE_BLUE, 1.6)
    beyond = plus(across_origin, tau + half + 0.55, across_direction)
    drawing.arrow([flat(across_origin), flat(beyond)], ORANGE, 1.5, "5 3")
    drawing.path([flat(base), flat(foot)], GREEN, 1.8)
    unit = tuple(c / math.sqrt(speed) for c in across_direction)
    inward = tuple(-c / distance for c in foot)
    corner = [plus(foot, -0.11, unit), plus(plus(foot, -0.11, unit), 0.11, inward), plus(foot, 0.11, inward)]
    drawing.path([flat(p) for p in corner])
    drawing.path([flat(base), flat(plus(across_origin, tau + half, across_direction))], BLUE, 1.2)
    drawing.circle(*flat(base), 2.5, MUTED, MUTED)
    drawing.circle(*flat(across_origin), 3, TEXT, TEXT)
    drawing.text(flat(across_origin)[0] - 9, flat(across_origin)[1] + 4, "across_origin", anchor="end")
    for t in (tau - half, tau + half):
        drawing.circle(*flat(plus(across_origin, t, across_direction)), 3.5, BLUE, BLUE)
    drawing.circle(*flat(foot), 3.5, GREEN, GREEN)
    drawing.text(flat(foot)[0] - 18, flat(foot)[1] + 16, "foot", color=GREEN, anchor="end")
    drawing.text(flat(base)[0] - 7, flat(base)[1] + 4, "axis", color=MUTED, anchor="end")
    drawing.text(flat(base)[0] + 30, flat(base)[1] - 18, "r", color=BLUE)
    drawing.lines(384, 72, [
        "τ = −across_origin · across_direction / s",
        "s = |across_direction|²",
        "foot = across_origin + τ across_direction",
    ])
    drawing.lines(574, 322, ["D = r² − |foot|²", "t = τ ± √(D / s)", "D < 0: a miss"])
    return drawing


def cone_nappes():
    header = "core/shapes/cone.hpp"
    source(header, r"if \(root\.entering == enters\) on_nappe\.add\(root\);")
    source(header, r"const bool enters = predicate\.sign\(M\) > 0;")
    # A plane through the axis: x along the axis from the base, y across, in pixels.
    length, base_radius, top_radius = 170.0, 112.0, 36.0
    slope = (top_radius - base_radius) / length
    apex = -base_radius / slope
    drawing = Drawing(720, 478, "Both nappes of a cone: the mirror nappe, and the clip to the ends", [
        f"Formulas: {header}. Drawn by bench/drawings/make.py from one cone and three rays in a plane",
        "through the axis; filled dots are the crossings that count.",
    ])
    left, middle = 130, 222

    def at(x, y):
        return (left + x, middle - y)

    far, end = 530.0, -52.0
    near_width, far_width = base_radius + end * slope, base_radius + far * slope
    drawing.path([at(end, near_width), at(apex, 0), at(end, -near_width)], LINE, 1.2, fill=PALE_GREY)
    drawing.path([at(far, far_width), at(apex, 0), at(far, -far_width)], ORANGE, 1.2, "5 3", fill=PALE_ORANGE)
    solid = [at(0, base_radius), at(length, top_radius), at(length, -top_radius), at(0, -base_radius)]
    drawing.path(solid, BLUE, 1.8, fill=PALE_BLUE, closed=True)
    drawing.path([at(end - 20, 0), at(far + 20, 0)], MUTED, 1, "6 3 1 3")
    for x, words in ((0.0, "base"), (length, "top")):
        drawing.path([at(x, 148), at(x, -148)], MUTED, 1.2, "4 3")
        drawing.text(at(x, 0)[0], middle + 163, words, color=MUTED, anchor="middle")
    drawing.circle(*at(apex, 0), 3.5, TEXT, TEXT)
    drawing.text(at(apex, 0)[0] + 6, middle + 36, "apex: width = 0", anchor="middle")
    drawing.text(at(far, 0)[0] - 6, middle - 20, "mirror nappe", color=ORANGE, anchor="end")
    drawing.text(at(far, 0)[0] - 6, middle - 5, "width < 0", color=ORANGE, anchor="end")

    def crossings(origin, direction):
        W, M = base_radius + slope * origin[0], slope * direction[0]
        A, B, C = direction[1] ** 2 - M * M, origin[1] * direction[1] - M * W, origin[1] ** 2 - W * W
        root = math.sqrt(B * B - A * C)
        for t in sorted(((-B - root) / A, (-B + root) / A)):
            yield t, W + t * M, A

    signs = []
    for name, origin, direction, stop in (
        ("ray 1", (8.0, -150.0), (0.33, 1.0), 290.0),
        ("ray 2", (-96.0, 20.56), (1.0, 0.14), 606.0),
        ("ray 3", (209.0, -150.0), (-0.12, 1.0), 290.0),
    ):
        points = [at(*plus(origin, t, direction)) for t in (0.0, stop)]
        drawing.arrow(points, TEXT, 1.5)
        if name == "ray 2":
            drawing.text(points[0][0], points[0][1] - 8, name, bold=True)
        else:
            drawing.text(points[1][0] + 7, points[1][1] + 8, name, bold=True)
        for t, width, A in crossings(origin, direction):
            place = plus(origin, t, direction)
            counts = width >= 0 and 0 <= place[0] <= length
            color = GREEN if counts else ORANGE if width < 0 else MUTED
            drawing.circle(*at(*place), 4, color, color if counts else PAPER, 1.6)
            signs.append((A > 0, counts, width < 0))
        for x in (0.0, length):
            place = plus(origin, (x - origin[0]) / direction[0], direction)
            if abs(place[1]) <= base_radius + slope * x:
                drawing.rect(at(*place)[0] - 4, at(*place)[1] - 4, 8, 8, GREEN, GREEN)
    two, dropped = (True, True, False), (True, False, False)
    assert signs == [two, two, (False, True, False), (False, False, True), dropped, dropped]  # as the text below says
    y = 46
    drawing.circle(22, y - 4, 4, GREEN, GREEN)
    drawing.text(32, y, "counts")
    drawing.rect(98, y - 8, 8, 8, GREEN, GREEN)
    drawing.text(112, y, "counts, at a cap")
    drawing.circle(246, y - 4, 4, ORANGE, PAPER, 1.6)
    drawing.text(256, y, "dropped: mirror nappe")
    drawing.circle(424, y - 4, 4, MUTED, PAPER, 1.6)
    drawing.text(434, y, "dropped: beyond an end")
    drawing.text(400, 366, "width = W + t M")
    drawing.text(400, 382, "A = |across_direction|² − M²")
    drawing.lines(16, 406, [
        "Ray 1, A > 0: both crossings are on the cone's nappe.",
        "Ray 2, A < 0: one crossing on each nappe. As M < 0, the first one counts; the ray enters by the base.",
        "Ray 3, A > 0: both crossings are beyond the top.",
    ])
    return drawing


SCENES = ("protein.json", "fullerene.xyz", "doublet.json")


def counters_of(tool, scene):
    """Renders a scene and returns its counters."""
    with tempfile.TemporaryDirectory() as folder:
        render = [tool, "render", ROOT / "scenes" / scene, "-o", f"{folder}/image.png", "-q", "--no-resume"]
        done = subprocess.run([*render, "--stats", "-"], stdout=subprocess.PIPE, check=True)
        return json.loads(done.stdout)


def stages(tool):
    """Shows how many rays reach each stage, by the counters of --stats."""
    all_counters = [counters_of(tool, scene) for scene in SCENES]
    version, isa = all_counters[0]["version"], all_counters[0]["isa"]
    drawing = Drawing(720, 478, "How many rays reach each stage", [
        f"Counters: raylane {version}, render SCENE --stats - in scenes/, {isa.upper()} kernels. Bars: logarithmic.",
        "Drawn by bench/drawings/make.py --raylane TOOL.",
    ])
    names = [
        ("bound", ["float bounds of each shape", "that the traversal reaches"]),
        ("solve, certify", ["one shape in double, with a", "bound on the error of t"]),
        ("refine", ["all that may be first, in double", "with bounds, then twice the digits"]),
        ("scalar code", ["a crossing by core::solve, or", "a path where surfaces meet"]),
        ("exact", ["scalar tests in more than", "double, at last in exact numbers"]),
    ]
    fills = [PALE_BLUE, PALE_GREEN, PALE_ORANGE, PALE_ORANGE, PALE_GREY]
    strokes = [BLUE, GREEN, ORANGE, ORANGE, MUTED]
    for column, (scene, counters) in enumerate(zip(SCENES, all_counters)):
        x = 250 + 156 * column
        total, shadow = counters["rays"]["total"], counters["rays"]["shadow"]
        decided = shadow - counters["shadow_rays_walked"]
        assert decided > shadow / 2  # as the text below says
        left = counters["left_to_the_reference"]
        beyond = counters["tests_beyond_double"]
        reached = [total, total - decided, counters["rays_refined"], left["rays"] + left["paths"], beyond]
        drawing.text(x, 48, scene, bold=True)
        drawing.text(x, 64, f"{thousands(counters['shapes'])} shapes", color=MUTED)
        for row, count in enumerate(reached):
            y = 84 + 62 * row
            width = 142 * math.log10(1 + count) / 8
            drawing.rect(x, y, max(width, 1), 16, fills[row], strokes[row])
            drawing.text(x, y + 30, thousands(count) + (" rays" if row < 4 else " tests"))
            if 0 < row < 4 and count:
                drawing.text(x, y + 44, share(count / total), color=MUTED)
    for row, (name, words) in enumerate(names):
        y = 84 + 62 * row
        drawing.text(16, y + 12, name, size=13, bold=True)
        drawing.lines(16, y + 28, words, color=MUTED)
        if row < 4:
            drawing.arrow([(8, y + 18), (8, y + 56)], LINE)
    drawing.lines(16, 402, [
        "Bounds alone decide most shadow rays. All other rays count at “solve, certify”, and so do those that",
        "hit nothing. A shadow ray through transparent surfaces has a search for each step; each may be refined.",
        "Comparisons of two crossings, in more than double or exact, have no counter.",
    ])
    return drawing


def share(part):
    percent = 100 * part
    return f"{percent:.0f} % of rays" if percent >= 10 else f"{percent:.1g} % of rays"


def sphere_bounds(np, origin, direction, slack, center, radius):
    """SphereFilter::bounds in float32, without fused operations. Returns masks and arrays by ray."""
    F = np.float32
    assert origin.dtype == direction.dtype == F
    ulps = F(constant("simd/kernel/shapes/sphere.hpp", r"rounding = F\((\d+) \* half_ulp\)"))
    u = F(2.0**-24)

    def total(a, b):
        return a[0] * b[0] + (a[1] * b[1] + a[2] * b[2])

    f = origin - center[:, None]
    tau = -total(f, direction)
    foot = tau * direction + f
    foot_squared = total(foot, foot)
    rounding = ulps * u * (np.abs(tau) + radius)
    error = rounding + slack
    outer, inner = radius + error, radius - error
    outer_chord, inner_chord = outer * outer - foot_squared, inner * inner - foot_squared
    with np.errstate(invalid="ignore"):
        outer_half, inner_half = np.sqrt(outer_chord), np.sqrt(inner_chord)
    entry, leaves = tau - outer_half - rounding, tau + outer_half + rounding
    possible = ~((outer_chord < 0) | (leaves < 0))
    certain = (inner > 0) & (inner_chord > 0) & (entry > 0)
    assert not np.any((inner > 0) & (tau * tau + foot_squared < inner * inner))  # no ray starts inside
    return {"possible": possible, "certain": certain, "lower": np.where(entry > 0, entry, F(0)),
            "upper": tau - inner_half + rounding, "foot_squared": foot_squared, "error": error}


def certified(np, origin, direction, center, radius):
    """SphereCertifiedSolver::solve in double for rays that start outside: t, its error, and where both are certain."""
    header = "simd/kernel/shapes/sphere.hpp"
    source(header, re.escape("H * (F(0x1p-49) * radius + F(0x1p-90) * H)"))
    source(header, re.escape("F(0x1p-45) * H + discriminant_error * (inverse * radius)"))
    f = origin - center[:, None]
    shift = -(f * direction).sum(0)
    foot = f + shift * direction
    discriminant = radius * radius - (foot * foot).sum(0)
    H = np.abs(shift) + 2 * radius
    discriminant_error = H * (2.0**-49 * radius + 2.0**-90 * H)
    with np.errstate(invalid="ignore", divide="ignore"):
        root = np.sqrt(discriminant)
        t = shift - root
        error = 2.0**-45 * H + discriminant_error / root
        certain = (discriminant > discriminant_error) & (np.abs(t) > error) & (error < 2.0**-14 * radius)
    return t, error, certain


def packet():
    import numpy as np

    F = np.float32
    size = constant("simd/kernel/traverse/frustum/packets.hpp", r"size = (\d+);")
    slack = F(2.0 ** -constant("simd/units/trace_kernels.hpp", r"slack_floor = 0x1p-(\d+)F;"))
    culling = F(1 + 2.0 ** -constant("simd/units/trace_kernels.hpp", r"culling_slack = 1\.0F \+ 0x1p-(\d+)F;"))
    morton = r"even_bits\(code\)\),\s+static_cast<std::uint8_t>\(even_bits\(code >> 1\)\)"
    source("simd/wavefront/regions.cpp", morton)
    # 4 x 4 pixels in Morton order, rays along -z. A sphere of radius 5: 3^2 + 4^2 = 5^2 makes two of them tangents.
    across = [(lane & 1) | (lane >> 1 & 2) for lane in range(size)]
    down = [(lane >> 1 & 1) | (lane >> 2 & 2) for lane in range(size)]
    xs, ys, height = [2 + i for i in across], [5 - j for j in down], 20
    origin = np.array([xs, ys, [height] * size], F)
    direction = np.array([[0] * size, [0] * size, [-1] * size], F)
    center, radius = np.zeros(3, F), F(5)
    bounds = sphere_bounds(np, origin, direction, slack, center, radius)
    possible, certain = bounds["possible"], bounds["certain"]
    t, error, solved = certified(np, origin.astype(float), direction.astype(float), center.astype(float), float(radius))
    # The rule of list_uncertain. There is no second candidate, so t + error must be before the culling limit.
    with np.errstate(invalid="ignore"):
        sure = solved & ((t + error).astype(F) * F(1 + 2.0**-21) <= bounds["lower"] * culling)
    hits = [lane for lane in range(size) if possible[lane]]
    uncertain = [lane for lane in hits if not sure[lane]]
    # Exactly, in integers: a closed sphere is hit by a line that touches it.
    exact = [lane for lane in range(size) if xs[lane] ** 2 + ys[lane] ** 2 <= int(radius) ** 2]
    assert exact == hits and uncertain == [lane for lane in exact if not certain[lane]]

    drawing = Drawing(720, 560, "One packet: 16 rays and one sphere", [
        "Computed by bench/drawings/make.py, formulas of simd/kernel/shapes/sphere.hpp: SphereFilter in float32",
        "(NumPy, no fused operations), SphereCertifiedSolver in double, list_uncertain, tangents in integers.",
    ])
    cell = 34
    x0, y0 = 20, 54
    unit = 40
    # Pixels and the sphere's outline.
    for lane in range(size):
        fill = PALE_GREEN if certain[lane] else PALE_ORANGE if possible[lane] else PALE_GREY
        drawing.rect(x0 + unit * across[lane], y0 + unit * down[lane], unit, unit, fill)
        if possible[lane]:  # below the outline, which passes above the pixel's middle
            drawing.text(x0 + unit * across[lane] + 4, y0 + unit * (down[lane] + 1) - 4, str(lane))
        else:
            drawing.text(x0 + unit * across[lane] + unit - 4, y0 + unit * down[lane] + 12, str(lane), anchor="end")
        drawing.circle(x0 + unit * (across[lane] + 0.5), y0 + unit * (down[lane] + 0.5), 2.5, TEXT, TEXT)
    points = []
    for k in range(201):
        angle = math.pi / 2 * k / 200
        px, py = 5 * math.cos(angle), 5 * math.sin(angle)
        if px >= 1.5 and py >= 1.5:
            points.append((x0 + unit * (px - 1.5), y0 + unit * (5.5 - py)))
    drawing.path(points, BLUE, 2)
    tangent = height - float(bounds["lower"][uncertain[0]])
    others = max(float(t[lane]) - float(bounds["lower"][lane]) for lane in hits if lane not in uncertain)
    drawing.lines(206, 64, [
        f"A sphere of radius {int(radius)} about (0, 0, 0); rays from (x, y, {height}) along (0, 0, −1).",
        f"4 × 4 pixels in Morton order are {size} consecutive rays, hence one packet.",
        f"Rays {' and '.join(map(str, uncertain))} are tangents: 3² + 4² = 5².",
        f"E = {bounds['error'][0]:.2g}: the filter cannot tell a tangent from a near miss.",
        f"The lower bound is {tangent:.2g} below t for tangents, which is √(2 r E),",
        f"and at most {others:.1g} for the other rays.",
    ])
    drawing.rect(206, 166, 12, 12, PALE_GREEN)
    drawing.text(224, 176, "certain")
    drawing.rect(290, 166, 12, 12, PALE_ORANGE)
    drawing.text(308, 176, "possible, not certain")
    drawing.rect(446, 166, 12, 12, PALE_GREY)
    drawing.text(464, 176, "certainly missed")

    # The packet's lanes, then its queues.
    left, top = 150, 250

    def row(number, name, values, fills, color=TEXT):
        y = top + 22 * number
        drawing.text(left - 8, y + 12, name, anchor="end")
        for lane, (value, fill) in enumerate(zip(values, fills)):
            drawing.rect(left + cell * lane, y, cell, 17, fill)
            drawing.text(left + cell * (lane + 0.5), y + 12, value, anchor="middle", color=color)

    def fills_of(mask):
        return [(PALE_GREEN if certain[lane] else PALE_ORANGE) if mask[lane] else PALE_GREY for lane in range(size)]

    def bits(mask):
        return sum(1 << lane for lane in range(size) if mask[lane])

    for lane in range(size):
        drawing.text(left + cell * (lane + 0.5), top - 6, str(lane), color=MUTED, anchor="middle")
    drawing.text(left - 8, top - 6, "lane", color=MUTED, anchor="end")
    plain = [PALE_BLUE] * size
    row(0, "x, y", [f"{x},{y}" for x, y in zip(xs, ys)], plain)
    row(1, "q²", [f"{int(q)}" for q in bounds["foot_squared"]], plain)
    lower = [f"{bound:.2f}" if may_hit else "" for bound, may_hit in zip(bounds["lower"], possible)]
    row(2, "lower", lower, fills_of(possible))
    row(3, f"possible 0x{bits(possible):04X}", ["1" if p else "0" for p in possible], fills_of(possible))
    row(4, f"certain 0x{bits(certain):04X}", ["1" if c else "0" for c in certain], fills_of(certain))

    def queue(y, name, lanes, fill, words):
        drawing.text(left - 8, y + 12, name, anchor="end", bold=True)
        for number, lane in enumerate(lanes):
            drawing.rect(left + 26 * number, y, 26, 17, fill(lane))
            drawing.text(left + 26 * (number + 0.5), y + 12, str(lane), anchor="middle")
        drawing.text(left + 26 * len(lanes) + 10, y + 12, words)

    def kind(lane):
        return PALE_GREEN if certain[lane] else PALE_ORANGE if possible[lane] else PALE_GREY

    y = top + 128
    missed = [lane for lane in range(size) if lane not in exact]
    queue(y, "candidates", hits, kind, "lower bound and shape of these lanes")
    queue(y + 28, "certified", [lane for lane in hits if sure[lane]], kind, "t + error is before every other bound")
    queue(y + 56, "uncertain", uncertain, kind, f"refined: both touch the sphere at t = {height}, so both hit")
    queue(y + 84, "sorted", exact + missed, kind, "hits, then misses")
    states = f"{sum(certain)} blocked, {len(uncertain)} doubtful, {size - len(hits)} unblocked"
    drawing.text(16, y + 122, f"As shadow rays to a light behind the sphere: {states}.")
    return drawing


def drawings(tool=None):
    """Yields the file name and the text of each drawing."""
    for make in (ray_life, node_and_block, sphere_filter, cylinder_foot, cone_nappes, packet):
        yield make.__name__ + ".svg", make().svg()
    if tool:
        yield "stages.svg", stages(tool).svg()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--raylane", metavar="TOOL", help="Tool that counts rays. Default: no stages.svg.")
    parser.add_argument("--out", metavar="FOLDER", type=pathlib.Path, default=FOLDER, help="Default: the script's.")
    arguments = parser.parse_args()
    for name, text in drawings(arguments.raylane):
        (arguments.out / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
