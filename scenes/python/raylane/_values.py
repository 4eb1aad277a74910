"""What a scene is made of besides its shapes. Each is a dataclass of plain numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal, Tuple, Union

from ._fields import Fields

Vector = Tuple[float, float, float]
"""A point, a direction or, as red, green and blue, a colour: any three numbers."""

Precision = Literal["fast", "robust", "exact", "double"]
"""How the hits of rays are found. ``"exact"`` decides as real arithmetic does for the numbers given, and is
hardly slower than ``"robust"``; the others are there to compare with."""

_WHITE: Vector = (1.0, 1.0, 1.0)
_BLACK: Vector = (0.0, 0.0, 0.0)


@dataclass
class Pattern(Fields):
    """A colour as a function of the point in space, in world coordinates."""

    kind: Literal["solid", "checker", "stripes", "gradient", "back_plane"] = "solid"
    colors: Tuple[Vector, Vector] = (_WHITE, _WHITE)
    """solid: the first. checker, stripes: alternating. gradient: at ``start`` and at ``end``. Linear RGB, >= 0."""
    size: float = 1.0
    """checker: the cells' edge; stripes: their width. In units of length, > 0."""
    axes: str = "xz"
    """checker: which axes count."""
    direction: Vector = (1.0, 0.0, 0.0)
    """stripes: across the bands, of any length but zero."""
    start: Vector = _BLACK
    end: Vector = (0.0, 1.0, 0.0)
    upper_edges: str = ""
    """checker: along which axes cells hold their upper edge, not the lower one."""


@dataclass
class Sellmeier(Fields):
    """Glass by Sellmeier's formula: n^2 = 1 + sum of B_i w^2 / (w^2 - C_i), wavelengths w in micrometres."""

    B: Vector = _BLACK
    C: Vector = _BLACK


@dataclass
class Material(Fields):
    """How a surface looks.

    With light *l* of colour L, the unit vectors n (normal), l (to the light) and h (halfway between l and the
    viewer), S what of the light the shadow lets through, and R the reflected fraction, what is seen is
    ``color ambient + sum of S L (color diffuse max(n.l, 0) + specular max(n.h, 0)^exponent)
    + R (colour reflected) + (1 - R) transmission (colour transmitted)``.
    """

    color: Union[Vector, Pattern] = _WHITE
    """Linear RGB, >= 0, or a pattern."""
    ambient: float = 0.1
    diffuse: float = 0.8
    specular: float = 0.0
    exponent: float = 32.0
    reflection: Literal["constant", "schlick", "dielectric"] = "constant"
    """``reflectivity``, Schlick's approximation or Fresnel's equations, these two from ``index``."""
    reflectivity: float = 0.0
    """0 to 1."""
    transmission: float = 0.0
    """0 to 1, for each surface that is crossed; 0 is opaque."""
    index: float = 1.5
    """Of refraction, > 0; what surrounds the scene has 1."""
    glass: Sellmeier = field(default_factory=Sellmeier)
    """If it has any B: in place of ``index``."""
    absorption: Vector = _BLACK
    """For each unit of length inside, >= 0: exp(-absorption * length) is left."""
    visible: Literal["both", "outside", "inside"] = "both"
    """Sides from which the surface can be seen."""
    opacity: float = 1.0
    """0 to 1: the share of what is seen that the surface is."""


@dataclass
class Light(Fields):
    """A light, which casts shadows and is not seen itself."""

    kind: Literal["point", "directional", "sky", "sphere", "disc", "rectangle"] = "point"
    position: Vector = _BLACK
    """point: where it is; sphere, disc: its middle; rectangle: a corner."""
    direction: Vector = (0.0, -1.0, 0.0)
    """directional: where the light travels to; sky: the same from the zenith; disc: its normal."""
    color: Vector = _WHITE
    """>= 0. Of lights with a size: the radiance. sky: that of the zenith."""
    radius: float = 1.0
    edge_u: Vector = (1.0, 0.0, 0.0)
    edge_v: Vector = (0.0, 0.0, 1.0)
    ground: Vector = _WHITE
    """sky: the colour of the nadir."""
    reach: float = math.inf
    """sky: what is farther away than that does not shade a surface from it."""


@dataclass
class Fog(Fields):
    """Fog of a fraction f: what is seen is (1 - f) times its colour and f times that of the fog."""

    kind: Literal["none", "linear_z", "linear", "exponential"] = "none"
    color: Vector = _WHITE
    start: float = 0.0
    end: float = 1.0
    density: float = 0.0


@dataclass
class Camera(Fields):
    """Where a picture is seen from."""

    projection: Literal["perspective", "orthographic"] = "perspective"
    position: Vector = (0.0, 0.0, 5.0)
    at: Vector = _BLACK
    """What the middle of the picture shows."""
    up: Vector = (0.0, 1.0, 0.0)
    field_of_view: float = 45.0
    """perspective: degrees from the picture's lower to its upper edge."""
    height: float = 2.0
    """orthographic: of the picture, in units of length."""
    lens_radius: float = 0.0
    """Of a thin lens that blurs what is not in focus; 0: a pinhole."""
    focus_distance: float = 0.0
    """From the lens to the plane that is sharp; 0: it goes through ``at``."""


@dataclass
class Outline(Fields):
    """Lines along the edges of what the camera sees first."""

    width: float = 0.0
    """Pixels, at most 32; 0: none."""
    color: Vector = _BLACK
    creases: float = 180.0
    """Degrees that surfaces are bent by at least where there is a line between them."""


@dataclass
class Settings(Fields):
    """Of a scene's picture."""

    width: int = 512
    height: int = 512
    grid: int = 1
    """Samples of a pixel: grid x grid, 1 to 256."""
    samples: Literal["regular", "stratified"] = "regular"
    quality: float = 0.0
    """0, or decibels (PSNR) against a converged picture, 10 to 80: each pixel gets the samples that it needs."""
    filter: Literal["box", "gaussian", "blackman_harris"] = "box"
    light_samples: int = 0
    """Rays to each light with a size, from each point that a sample sees; 0: four if pixels have one sample, one otherwise; -1: hard light, which is one ray to the middle of each lamp, and a sky that nothing shades."""
    transfer: Literal["srgb", "linear"] = "srgb"
    alpha: bool = False
    """The background is left out: the picture has an alpha."""
    max_depth: int = 8
    min_weight: float = 0.001
    max_see_through: int = 1_000_000
    outline: Outline = field(default_factory=Outline)
