"""A ray tracer with the formulas of textbooks, in float. It shows the failures that users of other renderers have reported.

Finds roots by b^2 - 4ac. An epsilon keeps rays off the surface that they leave. Reads the scenes of this folder:
spheres, cylinders, cones, boxes, planes and quadrics; point and directional lights; mirrors and glass without Fresnel.
`how` selects the remedies of the reports:

    epsilon       the minimum t, in units of length
    offset_ulps   secondary rays start this number of ulps of the coordinates along the normal instead
    interval      half the width of an interval around the coordinates of a ray's origin: only certain hits of spheres
                  count
    balls         open cylinders and cones end in balls
    shadows       false: no shadow rays

Arrays of n rays: origins and directions (n, 3), t (n,), in float32.
"""

import json
import math
import re

import numpy as np

F = np.float32
NONE = F(np.inf)


def read(path):
    with open(path) as file:
        return json.loads(re.sub(r"^\s*//.*$|(?<=[,{\[])\s+//.*$", "", file.read(), flags=re.MULTILINE))


def vector(numbers):
    return np.array(numbers, F)


def color_of(color):
    """Returns a linear colour, like the renderer's scene reader."""
    if isinstance(color, str):
        encoded = np.array([int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)])
        return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4).astype(F)
    return vector(color)


def dot(a, b):
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2]


def unit(v):
    return v / np.sqrt(dot(v, v))[..., None]


def discriminant(a, b, c):
    return b * b - F(4) * a * c


def roots(a, b, c):
    """Returns both roots of a t^2 + b t + c = 0, or NaN."""
    root = np.sqrt(discriminant(a, b, c))
    return (-b - root) / (F(2) * a), (-b + root) / (F(2) * a)


def first_of(candidates, least):
    """Returns the smallest t above `least` of the candidates whose condition holds."""
    best = NONE
    for t, holds in candidates:
        best = np.where(holds & (t > least) & (t < best), t, best)
    return best


class Sphere:
    def __init__(self, of, how):
        self.center, self.radius = vector(of["center"]), F(of["radius"])
        self.interval = how.get("interval", 0)

    def hit(self, o, d, least):
        f = o - self.center
        t = first_of([(t, ~np.isnan(t)) for t in roots(dot(d, d), F(2) * dot(f, d), dot(f, f) - self.radius**2)], least)
        return t if self.interval == 0 else np.where(self._is_sure(f, d), t, NONE)

    def _is_sure(self, f, d):
        off = self.interval
        b = np.maximum(np.abs(dot(f, d)) - off * np.abs(d).sum(-1), 0)
        c = dot(f, f) + 2 * off * np.abs(f).sum(-1) + 3 * off**2 - self.radius**2
        return b * b >= dot(d, d) * c

    def normal(self, p):
        return unit(p - self.center)


class Cone:
    """Cone or cylinder: |p|^2 - (p.a)^2 = (r0 + k p.a)^2 around the unit axis a."""

    def __init__(self, of, how):
        self.base, axis = vector(of["base"]), vector(of["axis"])
        self.height = np.sqrt(dot(axis, axis))
        self.axis = axis / self.height
        self.r0 = F(of["radius"] if of["type"] == "cylinder" else of["base_radius"])
        self.r1 = self.r0 if of["type"] == "cylinder" else F(of.get("top_radius", 0))
        self.slope = (self.r1 - self.r0) / self.height
        self.is_capped = of.get("capped", True)

    def hit(self, o, d, least):
        f = o - self.base
        fa, da = dot(f, self.axis), dot(d, self.axis)
        width, grows = self.r0 + self.slope * fa, self.slope * da
        wall = (
            dot(d, d) - da * da - grows * grows,
            F(2) * (dot(f, d) - fa * da - width * grows),
            dot(f, f) - fa * fa - width * width,
        )
        candidates = [(t, (fa + t * da >= 0) & (fa + t * da <= self.height)) for t in roots(*wall)]
        if self.is_capped:
            for at, radius in ((F(0), self.r0), (self.height, self.r1)):
                t = (at - fa) / da
                q = f + t[..., None] * d - at * self.axis
                # Caps are not tested where the wall is not crossed.
                candidates.append((t, (dot(q, q) <= radius * radius) & ~(discriminant(*wall) < 0)))
        return first_of(candidates, least)

    def normal(self, p):
        q = p - self.base
        along = dot(q, self.axis)
        wall = unit(q - along[..., None] * self.axis) - self.slope * self.axis
        if not self.is_capped:
            return unit(wall)
        off = np.abs(np.sqrt(np.maximum(dot(q, q) - along * along, 0)) - self.r0 - self.slope * along)
        below, above = np.abs(along) < off, np.abs(along - self.height) < off
        return np.where(below[..., None], -self.axis, np.where(above[..., None], self.axis, unit(wall)))


class Plane:
    def __init__(self, of, how):
        self.point, self.up = vector(of["point"]), unit(vector(of["normal"]))

    def hit(self, o, d, least):
        t = dot(self.point - o, self.up) / dot(d, self.up)
        return first_of([(t, ~np.isnan(t))], least)

    def normal(self, p):
        return np.broadcast_to(self.up, p.shape)


class Box:
    def __init__(self, of, how):
        self.least, self.most = vector(of["min"]), vector(of["max"])

    def hit(self, o, d, least):
        a, b = (self.least - o) / d, (self.most - o) / d
        enters, leaves = np.minimum(a, b).max(-1), np.maximum(a, b).min(-1)
        return first_of([(enters, enters <= leaves), (leaves, enters <= leaves)], least)

    def normal(self, p):
        q = (p - (self.least + self.most) / F(2)) / ((self.most - self.least) / F(2))
        face = np.abs(q).argmax(-1)
        normal = np.zeros_like(p)
        rows = np.arange(len(p))
        normal[rows, face] = np.sign(q[rows, face])
        return normal


class Quadric:
    def __init__(self, of, how):
        self.center, self.matrix = vector(of["center"]), vector(of["matrix"])
        self.least, self.most = vector(of["lower"]), vector(of["upper"])

    def hit(self, o, d, least):
        linear = self.matrix[:3, 3]
        f = o - self.center
        fm, dm = self._times(f), self._times(d)
        both = roots(
            dot(dm, d), F(2) * (dot(fm, d) + dot(d, linear)), dot(fm, f) + F(2) * dot(f, linear) + self.matrix[3, 3]
        )

        def is_inside(t):
            q = f + t[..., None] * d
            return ((q >= self.least) & (q <= self.most)).all(-1)

        return first_of([(t, is_inside(t)) for t in both], least)

    def normal(self, p):
        return unit(self._times(p - self.center) + self.matrix[:3, 3])

    def _times(self, v):
        return np.stack([dot(v, row[:3]) for row in self.matrix[:3]], -1)


KINDS = {"sphere": Sphere, "cylinder": Cone, "cone": Cone, "plane": Plane, "box": Box, "quadric": Quadric}


def balls_of(each):
    """Returns the balls at the ends of a cylinder or cone that a curve replaces."""
    if each["type"] == "cylinder":
        radii = (each["radius"], each["radius"])
    else:
        radii = (each["base_radius"], each.get("top_radius", 0))
    top = [a + b for a, b in zip(each["base"], each["axis"])]
    return [
        {"type": "sphere", "material": each["material"], "center": center, "radius": radius}
        for center, radius in zip((each["base"], top), radii)
        if radius > 0
    ]


class Textbook:
    def __init__(self, scene, how):
        objects = list(scene["objects"])
        if how.get("balls"):
            objects += [ball for each in scene["objects"] for ball in balls_of(each)]
        self.shapes = [KINDS[each["type"]](each, how) for each in objects]
        self.materials = [scene["materials"][each["material"]] for each in objects]
        self.lights = scene["lights"]
        self.background = color_of(scene.get("background", [0, 0, 0]))
        self.max_depth = scene.get("limits", {}).get("max_depth", 16)
        self.how = how
        self.epsilon = F(how.get("epsilon", 0))

    def first_hits(self, o, d, skip=None):
        """Returns t, infinite without a hit, and the shape's number, or -1."""
        best, which = np.full(len(o), NONE), np.full(len(o), -1)
        for number, shape in enumerate(self.shapes):
            if skip is not None and skip(number):
                continue
            t = shape.hit(o, d, self.epsilon)
            if self.materials[number].get("visible") == "outside":
                seen = t < NONE
                p = o + np.where(seen, t, 0)[..., None] * d
                t = np.where(seen & (dot(shape.normal(p), d) < 0), t, NONE)
            which = np.where(t < best, number, which)
            best = np.minimum(t, best)
        return best.astype(F), which

    def moved(self, p, normal, direction):
        """Returns the start of a secondary ray."""
        ulps = self.how.get("offset_ulps", 0)
        if ulps == 0:
            return p
        step = F(ulps * 2.0**-24) * (F(1) + np.abs(p).max(-1))
        return (p + (step * np.sign(dot(normal, direction)))[..., None] * normal).astype(F)

    def colors(self, o, d, depth=0):
        """Returns colours (n, 3), linear."""
        result = np.broadcast_to(self.background, (len(o), 3)).copy()
        t, which = self.first_hits(o, d)
        for number in range(len(self.shapes)):
            rays = np.flatnonzero(which == number)
            if rays.size:
                p = o[rays] + t[rays][..., None] * d[rays]
                result[rays] = self._shaded(number, p, d[rays], depth)
        return result

    def _shaded(self, number, p, d, depth):
        material = self.materials[number]
        outward = self.shapes[number].normal(p)
        entering = dot(outward, d) < 0
        n = np.where(entering[..., None], outward, -outward)
        own = self._own_color(material, p)
        color = F(material.get("ambient", 0.1)) * own
        for light in self.lights:
            color = color + self._lit(material, own, light, p, n, d)
        if depth >= self.max_depth:
            return color
        mirrored = F(material.get("reflectivity", 0))
        if mirrored > 0:
            r = d - F(2) * dot(d, n)[..., None] * n
            color = color + mirrored * self.colors(self.moved(p, n, r), r.astype(F), depth + 1)
        through = F(material.get("transmission", 0))
        if through > 0:
            ratio = np.where(entering, F(1 / material["index"]), F(material["index"]))
            along = ratio[..., None] * (d - dot(d, n)[..., None] * n)
            left = F(1) - dot(along, along)
            bent = along - np.sqrt(np.maximum(left, 0))[..., None] * n
            r = np.where((left < 0)[..., None], d - F(2) * dot(d, n)[..., None] * n, bent).astype(F)
            color = color + through * self.colors(self.moved(p, n, r), r, depth + 1)
        return color

    @staticmethod
    def _own_color(material, p):
        pattern = material.get("pattern")
        if pattern is None:
            return np.broadcast_to(color_of(material.get("color", [1, 1, 1])), p.shape)
        cells = np.floor(p[:, [0, 2]] / F(pattern["size"])).sum(-1).astype(np.int64) % 2
        return np.where((cells == 0)[..., None], *(color_of(color) for color in pattern["colors"]))

    def _lit(self, material, own, light, p, n, d):
        if light["type"] == "directional":
            to_light, distance = np.broadcast_to(unit(-vector(light["direction"])), p.shape), NONE
        else:
            to_light = vector(light["position"]) - p
            distance = np.sqrt(dot(to_light, to_light))
            to_light = to_light / distance[..., None]
        cos = dot(n, to_light)
        reached = cos > 0
        if self.how.get("shadows", True):
            start = self.moved(p, n, to_light)
            t, _ = self.first_hits(start, to_light, lambda number: self.materials[number].get("transmission", 0) > 0)
            reached &= ~(t < distance)
        half = unit(to_light - d)
        falloff = np.maximum(dot(n, half), 0).astype(float) ** material.get("exponent", 32)
        shine = F(material.get("specular", 0)) * falloff.astype(F)
        light_color = color_of(light.get("color", [1, 1, 1]))
        lit = F(material.get("diffuse", 0.8)) * cos[..., None] * own + shine[..., None]
        return np.where(reached[..., None], light_color * lit, F(0))


def camera_rays(scene):
    """Returns rays through pixel centres, row by row from the top: origins, unit directions (n, 3), in double."""
    camera, image = scene["camera"], scene["image"]
    start, at = np.array(camera["from"], float), np.array(camera["at"], float)
    forward = unit(at - start)
    right = unit(np.cross(forward, camera.get("up", [0, 1, 0])))
    up = np.cross(right, forward)
    width, height = image["width"], image["height"]
    x, y = np.meshgrid((2 * np.arange(width) + 1 - width) / height, (height - 2 * np.arange(height) - 1) / height)
    x, y = x.ravel()[:, None], y.ravel()[:, None]
    if camera.get("type") == "orthographic":
        half = camera["height"] / 2
        return start + half * (x * right + y * up), np.broadcast_to(forward, (len(x), 3)).copy()
    half = math.tan(math.radians(camera["field_of_view"]) / 2)
    return np.broadcast_to(start, (len(x), 3)).copy(), unit(forward + half * (x * right + y * up))


def draw(scene, how):
    """Returns the image (height, width, 3), and t and the shape's number of the first hits (height, width)."""
    tracer = Textbook(scene, how)
    o, d = (rays.astype(F) for rays in camera_rays(scene))
    shape = (scene["image"]["height"], scene["image"]["width"])
    with np.errstate(all="ignore"):
        t, which = tracer.first_hits(o, d)
        return tracer.colors(o, d).astype(F).reshape(*shape, 3), t.reshape(shape), which.reshape(shape)
