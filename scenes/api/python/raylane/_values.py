"""Dataclasses for the contents of a scene besides its shapes."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field, replace
from os import PathLike
from typing import Any, Dict, Literal, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _raylane
from ._errors import InvalidValue
from ._fields import Fields
from ._raylane import Texture
from ._renamed import renamed

Vector = Tuple[float, float, float]
"""A point, a direction or a colour (red, green, blue): any three numbers."""

Color = Union[Vector, str]
"""A colour: linear red, green and blue, where 1 is white, or ``"#rrggbb"`` in sRGB."""

Precision = Literal["fast", "robust", "exact", "double"]
"""Method by which hits are found. ``"exact"`` decides as real arithmetic does for the given numbers, and is hardly
slower than ``"robust"``. The other methods serve comparisons."""

_WHITE: Vector = (1.0, 1.0, 1.0)
_BLACK: Vector = (0.0, 0.0, 0.0)


@dataclass
class Pattern(Fields):
    """A colour as a function of the point in space, an image on the surface, or the colours of the parts that a face cuts."""

    kind: Literal["solid", "checker", "stripes", "gradient", "formula", "image", "cutaway"] = "solid"
    """cutaway: on a face that cuts a solid, the colour of the part that it cuts there; of several, of the sphere or capped
    cylinder with the smallest power (squared distance from the centre or the axis minus squared radius), and of the
    first one of equals. A part whose colour depends on more than the point gives the first of ``colors``."""
    colors: Tuple[Color, Color] = (_WHITE, _WHITE)
    """Linear RGB, >= 0. solid: the first only. checker, stripes: alternating. gradient: at ``start`` and at ``end``."""
    size: float = 1.0
    """checker: edge length of a cell; stripes: width of a band. In units of length, > 0."""
    axes: str = "xz"
    """checker: the axes along which the colour alternates, one or more of x, y and z."""
    direction: Vector = (1.0, 0.0, 0.0)
    """stripes: direction across the bands, of any length except zero."""
    start: Vector = _BLACK
    end: Vector = (0.0, 1.0, 0.0)
    upper_edges: str = ""
    """checker: the axes along which a cell contains its upper edge instead of its lower one."""
    formula: Tuple[str, str, str] = ("", "", "")
    """formula: the texts of red, green and blue, such as ``"abs(cos(x))"``, in the language of the JSON format. Together
    they may have 64 different operations. A result that is undefined or below 0 counts as 0, above 1e10 as 1e10.
    A pattern that is made with formulas has this kind."""
    space: Literal["world", "object"] = "world"
    """checker, stripes, gradient, formula: coordinates of the points. In object space a pattern moves with its shapes
    when transforms and placements move them. The coordinates u and v of a formula are then those in object space,
    too."""
    image: Union[None, Texture, str, PathLike[str], NDArray[Any]] = None
    """image: a :class:`Texture`, or anything that one is made of: the path of a PNG, or an array (height, width, 3).
    Its lower left corner is at u = 0 and v = 0, coordinates on the shape in object space that the JSON format
    describes. A pattern that is made with an image has this kind."""
    width: float = 1.0
    """image: extent along u, > 0. A length on planes; on round shapes, 1 is a whole turn."""
    height: float = 1.0
    """image: extent along v, > 0. A length on planes; on round shapes, 1 is from end to end."""
    wrap: Literal["repeat", "clamp"] = "repeat"
    """image: colours beyond its edges. repeat: of further copies; clamp: of the nearest edge."""
    axis: Vector = (0.0, 1.0, 0.0)
    """image: from the lower to the upper pole of spheres and ellipsoids, of any length except zero."""

    def __post_init__(self) -> None:
        if self.kind == "solid" and any(self.formula):
            self.kind = "formula"
        if self.kind == "solid" and self.image is not None:
            self.kind = "image"


@dataclass
class Sellmeier(Fields):
    """Index of refraction of glass by Sellmeier's formula: n^2 = 1 + sum of B_i w^2 / (w^2 - C_i).

    The wavelength w is in micrometres, C in square micrometres.
    """

    B: Vector = _BLACK
    C: Vector = _BLACK

    @classmethod
    def catalogue(cls, name: str) -> Sellmeier:
        """Returns a glass by its name, as :attr:`Material.glass` takes it."""
        return _raylane.catalogue_glass(name)


@dataclass
class Material(Fields):
    """Optical properties of a surface.

    A ray that hits the surface shows the colour
    ``color ambient + sum of S L (color diffuse max(n.l, 0) + specular max(n.h, 0)^exponent)
    + R (colour reflected) + (1 - R) transmission (colour transmitted)``.
    The sum is over all lights. The unit vectors are n (normal), l (to the light) and h (halfway between l and the
    direction to the viewer). L is the colour of the light, S the fraction of it that reaches the point, and R the
    reflected fraction. ``ambient``, ``diffuse``, ``specular`` and ``exponent`` are >= 0.
    """

    color: Union[Color, Pattern] = _WHITE
    """Linear RGB, >= 0, ``"#rrggbb"``, or a :class:`Pattern`."""
    ambient: float = 0.1
    diffuse: float = 0.8
    specular: float = 0.0
    exponent: float = 32.0
    reflection: Literal["constant", "schlick", "dielectric"] = "constant"
    """constant: ``reflectivity``. schlick: Schlick's approximation from ``index``. dielectric: Fresnel's equations from
    ``index``."""
    reflectivity: float = 0.0
    """0 to 1."""
    transmission: float = 0.0
    """0 to 1, per crossed surface; 0 is opaque."""
    index: float = 1.5
    """Index of refraction, > 0; outside of all shapes it is 1."""
    glass: Union[Sellmeier, str] = field(default_factory=Sellmeier)
    """Replaces ``index`` if any B is nonzero. Also a name of the catalogue: ``"N-BK7"``, ``"N-K5"``, ``"N-BAK4"``,
    ``"F2"``, ``"N-F2"``, ``"SF5"``, ``"N-SF5"``, ``"N-SF10"``, ``"N-SF11"``, ``"SF11"``, ``"fused silica"``,
    ``"calcium fluoride"`` or ``"diamond"``."""
    absorption: Vector = _BLACK
    """Per unit of length inside, >= 0: the fraction exp(-absorption * length) of the light remains."""
    visible: Literal["both", "outside", "inside"] = "both"
    """Sides from which the surface is visible. Rays pass through the other side without a hit."""
    opacity: float = 1.0
    """0 to 1: weight of the surface's colour. The scene straight behind the surface has the weight 1 - opacity."""
    highlight: Literal["blinn", "phong"] = "blinn"
    """Shape of the highlight. phong: n.h stands for the cosine between l and the reflected ray."""

    @classmethod
    def preset(cls, name: str, **fields: Any) -> Material:
        """Returns a material that files know by name, with other values of some fields.

        ``name``: ``"matte"`` (the same as ``Material()``), ``"plastic"``, ``"metal"``, ``"mirror"``, ``"glass"``,
        ``"water"`` or ``"diamond"``. As in files, ``reflectivity`` also sets ``reflection`` to ``"constant"``.

        >>> Material.preset("metal", color="#b87333").reflectivity
        0.35
        """
        if "reflectivity" in fields:
            fields.setdefault("reflection", "constant")
        return replace(_raylane.material_preset(name), **fields)


@dataclass
class Light(Fields):
    """A light source. It casts shadows and is invisible itself.

    ``radius``: of a sphere or disc, > 0, in units of length. ``edge_u`` and ``edge_v``: perpendicular edges of a
    rectangle. Directions may have any length except zero.
    """

    kind: Literal["point", "directional", "sky", "sphere", "disc", "rectangle"] = "point"
    position: Vector = _BLACK
    """point: its position, not on a surface; sphere, disc: centre; rectangle: corner."""
    direction: Vector = (0.0, -1.0, 0.0)
    """directional: direction in which the light travels; sky: direction in which the zenith's light travels; disc:
    normal."""
    color: Color = _WHITE
    """>= 0. Lights with a size: the radiance. sky: the colour of the zenith."""
    radius: float = 1.0
    edge_u: Vector = (1.0, 0.0, 0.0)
    edge_v: Vector = (0.0, 0.0, 1.0)
    ground: Color = _WHITE
    """sky: colour of the nadir, >= 0. White unless given, also if ``color`` is not; in files, it is the zenith's."""
    reach: float = math.inf
    """sky: > 0, in units of length. Shapes farther than this from a surface do not shade it."""


@dataclass
class Fog(Fields):
    """Fog with a fraction f, 0 to 1: a ray segment shows (1 - f) * colour + f * fog colour.

    linear_z: f is linear in world z, 0 at ``start`` and 1 at ``end``. linear: the same in the distance along the ray,
    0 <= start < end. exponential: f = 1 - exp(-density * distance), density > 0.
    """

    kind: Literal["none", "linear_z", "linear", "exponential"] = "none"
    color: Color = _WHITE
    start: float = 0.0
    end: float = 1.0
    density: float = 0.0


@dataclass
class Camera(Fields):
    """A camera. ``up`` is not along the line of sight."""

    projection: Literal["perspective", "orthographic"] = "perspective"
    position: Vector = (0.0, 0.0, 5.0)
    at: Vector = _BLACK
    """Point at the centre of the image; differs from ``position``."""
    up: Vector = (0.0, 1.0, 0.0)
    field_of_view: float = 45.0
    """perspective: degrees from the image's lower to its upper edge, between 0 and 180."""
    height: float = 2.0
    """orthographic: height of the image, > 0, in units of length."""
    lens_radius: float = 0.0
    """Radius of the thin lens, >= 0, in units of length. 0: a pinhole, without depth of field."""
    focus_distance: float = 0.0
    """Distance from the lens to the plane of focus, >= 0, in units of length. 0: that plane goes through ``at``."""

    @classmethod
    def from_json(cls, camera: Union[str, Dict[str, Any]]) -> Camera:
        """Returns the camera of a scene's JSON, as ``raylane view`` prints it: a text, or the dict of json.loads.

        >>> Camera.from_json('{"from": [9, 7.5, 12], "at": [0, 0, 0], "field_of_view": 33}').position
        (9.0, 7.5, 12.0)
        """
        try:
            given: Any = camera
            if isinstance(given, str):
                text = given.strip().rstrip(",")
                given = json.loads("{" + text + "}" if text.startswith('"camera"') else text)
            members = dict(given.get("camera", given))
        except (AttributeError, TypeError, ValueError):
            raise InvalidValue("camera", f'must be a Camera or its JSON, got "{camera}"') from None
        if "height" in members:
            members.setdefault("projection", members.pop("type", "orthographic"))
        members.pop("type", None)
        if "from" in members:
            members["position"] = members.pop("from")
        vectors = {name: tuple(map(float, value)) for name, value in members.items() if isinstance(value, (list, tuple))}
        return cls(**{**members, **vectors})

    def rays(self, width: int, height: int) -> Tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Returns the origins and unit directions of the rays of an image, each (height, width, 3), for a tracer.

        They are the rays that :func:`render` traces from this camera with one sample at the centre of each pixel: with
        ``grid=1``, regular samples, the box filter and no quality. Row 0 is the upper edge of the image. A tracer reads
        the arrays in place. With a lens, each ray starts at a point of the lens that depends on the pixel.
        ``width`` and ``height``: 1 to 65535, at most 2^28 pixels in all. Raises :class:`InvalidValue`.

        >>> origins, directions = Camera(position=(0, 0, 5)).rays(64, 48)
        >>> directions.shape
        (48, 64, 3)
        """
        origins, directions = _raylane.camera_rays(self, width, height)
        return np.moveaxis(origins, 0, -1), np.moveaxis(directions, 0, -1)


@dataclass
class AutoCamera(Fields):
    """A camera that :meth:`SceneBuilder.build` places so that it shows all bounded shapes as large as possible.

    Building raises :class:`InvalidValue` if the scene has no bounded shapes.
    """

    view: Union[str, Vector] = "front"
    """Side from which it sees the scene: ``"front"`` (from +z), ``"back"``, ``"right"`` (from +x), ``"left"``,
    ``"top"`` (from +y), ``"bottom"``, ``"x"``, ``"y"`` (from +x and +y, with z upward), ``"z"`` or ``"corner"``; or its
    line of sight, of any length except zero."""
    up: Optional[Vector] = None
    """Upward direction in the image, not along the line of sight. None: that of the view."""
    projection: Literal["perspective", "orthographic"] = "perspective"
    field_of_view: float = 30.0
    """perspective: degrees from the image's lower to its upper edge, 0.01 to 179."""
    zoom: float = 1.0
    """Magnification, 0.01 to 1000. 1: all bounded shapes are visible."""
    depth_cue: float = 0.0
    """Fraction of the background's colour at the farthest shapes, 0 to 0.99, by a fog that replaces the scene's."""


@dataclass
class Outline(Fields):
    """Lines over the image, along the edges of the first visible surfaces."""

    width: float = 0.0
    """Line width in pixels, 0 to 32; 0: no lines."""
    color: Color = _BLACK
    creases: float = 180.0
    """Degrees, 0 to 180. Surfaces that meet have a line between them if their materials differ or if the angle between
    their normals exceeds this one. 180: lines only where one surface is in front of another."""


@renamed("max_see_through", "max_transparent")
@dataclass
class Settings(Fields):
    """Settings of a scene's image.

    ``width`` and ``height``: pixels, 1 to 65535, at most 2^28 pixels in all. ``samples``: regular is the centre of each
    cell of the grid, stratified a point in each cell. ``max_depth``: reflections and refractions on one path, 0 to
    1000. ``min_weight``: 0 to 1; a path ends when its largest throughput falls below it. ``max_transparent``: surfaces
    of opacity below 1 that a path shows behind each other, 1 to 1000000.
    """

    width: int = 512
    height: int = 512
    grid: int = 1
    """1 to 256; each pixel has grid x grid samples."""
    samples: Literal["regular", "stratified"] = "regular"
    quality: float = 0.0
    """0, or the PSNR in decibels against a converged image, 10 to 80. Each pixel then gets the samples that it needs;
    ``grid`` and ``samples`` are ignored."""
    filter: Literal["box", "gaussian", "blackman_harris"] = "box"
    light_samples: int = 0
    """Shadow rays to each light with a size, from each visible point of a sample, 1 to 4096. 0: four if a pixel has one
    sample, one otherwise. -1: hard light: one ray to the centre of each such light, and an unshadowed sky."""
    transfer: Literal["srgb", "linear"] = "srgb"
    alpha: bool = False
    """True: the image has an alpha channel. It omits the background that the camera sees directly or straight through
    surfaces of opacity below 1."""
    max_depth: int = 8
    min_weight: float = 0.001
    max_transparent: int = 1_000_000
    outline: Outline = field(default_factory=Outline)
    transparent_shadows: bool = True
    """False: surfaces of opacity below 1 and glass cast no shadows, and absorb no light on its way from the lights."""
