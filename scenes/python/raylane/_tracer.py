"""Rays that are asked about a scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _raylane
from ._errors import InvalidValue
from ._fields import Fields
from ._scene import Scene, inner
from ._values import Precision

NO_SHAPE: int = _raylane.NO_SHAPE
"""The id that no shape has: what a ray that hits nothing has hit."""

Floats = NDArray[np.float32]
Doubles = NDArray[np.float64]
Ids = NDArray[np.uint32]
Bools = NDArray[np.bool_]
Bytes = NDArray[np.uint8]
Firsts = NDArray[np.uint64]


class Hits(Fields):
    """What n rays have hit first. To be filled again and again, it may be given to :meth:`Tracer.intersect`."""

    t: Floats
    """(n,): > 0 and finite, the float nearest to the true one; infinite where nothing is hit."""
    shape: Ids
    """(n,): ids, or ``NO_SHAPE``."""
    entering: Bools
    """(n,): whether the ray goes from the outside to the inside."""
    face: Bytes
    """(n,): the part of the shape's surface, for rays that go on from there."""
    t_double: Optional[Doubles]
    """(n,): t in double, if it is wanted, which takes longer than all others together."""

    def __init__(self, count: int, double: bool = False) -> None:
        self.t = np.empty(count, np.float32)
        self._normal = np.empty((3, count), np.float32)
        self.shape = np.empty(count, np.uint32)
        self.entering = np.empty(count, np.bool_)
        self.face = np.empty(count, np.uint8)
        self.t_double = np.empty(count, np.float64) if double else None

    @property
    def normal(self) -> Floats:
        """(n, 3): of unit length, on the surface's outside, whichever side is hit; 0 where nothing is."""
        return self._normal.T

    @property
    def hit(self) -> Bools:
        """(n,): whether anything is hit."""
        return np.not_equal(self.shape, NO_SHAPE)

    def __len__(self) -> int:
        return len(self.t)

    def _arrays(self) -> Tuple[Any, ...]:
        n = self._normal
        return (self.t, n[0], n[1], n[2], self.shape, self.entering.view(np.uint8), self.face, self.t_double)

    def __repr__(self) -> str:
        return f"<raylane.Hits: {int(self.hit.sum())} of {len(self)} rays>"


class _Rows:
    """Rows of different lengths, one after the other: those of i are from ``first[i]`` up to ``first[i + 1]``."""

    first: Firsts

    def counts(self) -> NDArray[np.int64]:
        """(n,): how many each has."""
        return np.diff(self.first.astype(np.int64))

    def of(self) -> NDArray[np.int64]:
        """Of each entry, the number of what it belongs to."""
        return np.repeat(np.arange(len(self.first) - 1), self.counts())

    def __len__(self) -> int:
        return len(self.first) - 1

    def __repr__(self) -> str:
        return f"<raylane.{type(self).__name__}: {int(self.first[-1])} of {len(self)}>"


@dataclass(repr=False, eq=False)
class Crossings(_Rows):
    """All crossings of n rays, by ray and then in their order."""

    first: Firsts
    """(n + 1,)"""
    t: Doubles
    shape: Ids
    entering: Bools
    face: Bytes
    tied: Bools
    """Whether it is at the same t as the one before it, as real arithmetic has it."""
    touching: Bools
    """Whether the shape is entered and left at the same t."""
    normal: Optional[Floats] = None
    """(m, 3), if they are wanted."""


@dataclass(repr=False, eq=False)
class Solids(_Rows):
    """Solids that n points are in, by point and then by id."""

    first: Firsts
    shape: Ids
    on_surface: Bools
    """Whether the point is exactly on the solid's surface."""


@dataclass(repr=False, eq=False)
class Lengths(_Rows):
    """Lengths of n rays inside of materials, by ray and then by material."""

    first: Firsts
    material: Ids
    length: Doubles
    """In the scene's unit, within an ulp of the true one; infinite for what has no end."""

    def total(self, material: Optional[int] = None) -> Doubles:
        """(n,): of each ray, in all materials or in one."""
        which = self.length if material is None else np.where(self.material == material, self.length, 0.0)
        return np.bincount(self.of(), which, len(self)).astype(np.float64)


@dataclass(eq=False)
class Leaving(Fields):
    """What rays leave, exactly: they start on the surface that a hit was on, however their numbers were rounded.

    ``inward`` says whether a ray goes to the inside of what it leaves: where it goes through and the hit was
    entering, or is thrown back and it was not.
    """

    shape: ArrayLike
    face: ArrayLike
    inward: ArrayLike


class Tracer:
    """Asks rays about a scene.

    Rays are ``origins`` and ``directions`` of shape (n, 3), or one of either for all; directions may have any
    length but zero, and t counts in units of that length. Components are 0 or of magnitude from 2^-149 to below
    2^128, those of a direction beside its largest 0 or down to 2^-276 of that: a ray with others hits nothing. If all
    arrays, those of ``t_min`` and ``t_max`` included, are float32, rays are asked as floats, else as doubles, each for
    exactly what it is. Arrays whose columns lie one after the other in memory (``np.empty((3, n)).T``, or Fortran's order) are read where they
    are; others are copied in parts, and those of another type first converted. ``t_min`` and ``t_max`` are (n,),
    or numbers, which are taken for ones of the rays' type.

    With ``precision="exact"`` all that is answered is what real arithmetic gives for the numbers given. The
    interpreter's lock is free meanwhile: any number of threads may ask one tracer.

    >>> from raylane import parse
    >>> scene = parse('{"camera": "auto", "materials": {"m": {}}, "objects":'
    ...               ' [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"}]}')
    >>> hits = Tracer(scene).intersect([[0, 0, 5], [0, 2, 5]], [0, 0, -1])
    >>> hits.t
    array([ 4., inf], dtype=float32)
    """

    def __init__(self, scene: Scene, threads: int = 0, precision: Precision = "exact") -> None:
        """threads: at most, 1 to 4096; 0: as RAYLANE_THREADS says, or all of the machine."""
        self.scene = scene
        self._tracer = _raylane.Tracer(inner(scene), threads, precision)

    @staticmethod
    def _rest(t_min: Any, t_max: Any, leaving: Optional[Leaving]) -> Tuple[Any, ...]:
        if leaving is None:
            return (t_min, t_max, None, None, None)
        if not isinstance(leaving, Leaving):
            raise TypeError(f"leaving must be a raylane.Leaving, not {type(leaving).__name__}")
        return (t_min, t_max, leaving.shape, leaving.face, leaving.inward)

    def intersect(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        t_min: Optional[ArrayLike] = None,
        t_max: Optional[ArrayLike] = None,
        leaving: Optional[Leaving] = None,
        double: bool = False,
        out: Optional[Hits] = None,
    ) -> Hits:
        """The nearest crossing of each ray with t_min < t <= t_max."""
        if out is None:
            out = Hits(_count(origins, directions), double)
        elif not isinstance(out, Hits):
            raise TypeError(f"out must be a raylane.Hits, not {type(out).__name__}")
        elif double and out.t_double is None:
            out.t_double = np.empty(len(out), np.float64)
        self._tracer.intersect(origins, directions, self._rest(t_min, t_max, leaving), out._arrays())
        return out

    def occluded(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        t_min: Optional[ArrayLike] = None,
        t_max: Optional[ArrayLike] = None,
        leaving: Optional[Leaving] = None,
        out: Optional[Bools] = None,
    ) -> Bools:
        """(n,): whether a ray has any crossing within its limits."""
        if out is None:
            out = np.empty(_count(origins, directions), np.bool_)
        elif not isinstance(out, np.ndarray) or out.dtype != np.bool_ or not out.flags.c_contiguous:
            raise InvalidValue("out", "must be an array of bool, whose values lie one after the other")
        rest = self._rest(t_min, t_max, leaving)
        self._tracer.occluded(origins, directions, rest, out.view(np.uint8))
        return out

    def crossings(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        t_min: Optional[ArrayLike] = None,
        t_max: Optional[ArrayLike] = None,
        leaving: Optional[Leaving] = None,
        most: int = 0,
        normals: bool = False,
    ) -> Crossings:
        """All crossings of each ray in the order of their true t, or the first ``most`` of them. Always exact."""
        rest = self._rest(t_min, t_max, leaving)
        return Crossings(**self._tracer.crossings(origins, directions, rest, most, normals))

    def path_lengths(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        t_min: Optional[ArrayLike] = None,
        t_max: Optional[ArrayLike] = None,
    ) -> Lengths:
        """How much of each ray is inside of the solids of each material. Always exact, up to the last rounding."""
        return Lengths(**self._tracer.path_lengths(origins, directions, self._rest(t_min, t_max, None)))

    def contains(self, points: ArrayLike) -> Solids:
        """The solids that each point is in, or on the surface of. Always exact."""
        return Solids(**self._tracer.contains(points))


def _count(origins: ArrayLike, directions: ArrayLike) -> int:
    """Of rays. What is no array of them is refused where they are read."""
    for rays in (origins, directions):
        shape: Tuple[int, ...] = getattr(rays, "shape", None) or _shape(rays)
        if len(shape) > 1:
            return shape[0]
    return 1


def _shape(rays: ArrayLike) -> Tuple[int, ...]:
    try:
        return np.shape(rays)
    except ValueError:
        return ()
