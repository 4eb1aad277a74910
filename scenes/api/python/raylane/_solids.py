"""Constructed solids and transforms."""

from __future__ import annotations

from typing import Any, Iterable, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _raylane
from ._errors import InvalidValue


class Transform:
    """An affine map x -> M x + t, in exact numbers.

    Products of maps are exact. :meth:`Solid.transformed` and :meth:`Group.transformed` round each number of a shape
    once, to the nearest double. The methods return this map followed by another one, so
    ``Transform().scaled(2).rotated((0, 90, 0)).translated((1, 0, 0))`` scales first, as a file's keys ``scale``,
    ``rotate`` and ``translate`` do. To transform a transformed object rounds again: combine the maps by :meth:`then` to
    round once. The keys of one object in a file are one map, and those of each group or instance around it another one,
    from the inside out. All numbers are from -1e30 to 1e30.

    ``matrix``: (3, 4), three rows of M, each followed by its element of t; M must not be singular. None: the identity.
    """

    def __init__(self, matrix: Optional[ArrayLike] = None) -> None:
        self._transform = _raylane.Transform() if matrix is None else _raylane.transform_of(matrix)

    def scaled(self, by: ArrayLike) -> Transform:
        """``by``: a factor, or one for each axis, (3,); not 0."""
        return _transform(self._transform.scaled(by))

    def rotated(self, degrees: ArrayLike) -> Transform:
        """Rotates about the axes x, y and z, one after the other. Multiples of 90 degrees are exact.

        ``degrees``: (3,), counter-clockwise for a viewer to whom the axis points.
        """
        return _transform(self._transform.rotated(degrees))

    def translated(self, by: ArrayLike) -> Transform:
        """``by``: (3,), in units of length."""
        return _transform(self._transform.translated(by))

    def then(self, next: Transform) -> Transform:
        """Returns this map followed by ``next``."""
        return _transform(self._transform.then(inner_transform(next)))


def _transform(inner: _raylane.Transform) -> Transform:
    result = Transform()
    result._transform = inner
    return result


def inner_transform(transform: Any) -> _raylane.Transform:
    """Returns the compiled object of a transform. Raises TypeError for any other object."""
    if not isinstance(transform, Transform):
        raise TypeError(f"must be a raylane.Transform, not {type(transform).__name__}")
    return transform._transform


class Solid:
    """A constructed solid. The operators ``|`` (union), ``&`` (intersection) and ``-`` (difference) combine solids.

    Solids nest up to 1024 levels deep. ``material`` is a material index; None takes the material of the solid or
    scene object that this solid becomes a part of.

    Chains of operators do not nest: ``a | b | c`` is one union of three. :meth:`union` takes any number of solids at
    once, in less time. Coordinates and lengths are from -1e30 to 1e30; numbers are used as float64.

    >>> bowl = Solid.sphere((0, 0, 0), 1) - Solid.sphere((0, 0, 0), 0.9) - Solid.half_space((0, 0, 0), (0, -1, 0))
    >>> heap = Solid.union(Solid.sphere((x, 0, 0), 0.6) for x in range(100))
    """

    def __init__(self, solid: _raylane.Solid) -> None:
        self._solid = solid

    @staticmethod
    def sphere(center: ArrayLike, radius: float, material: Optional[int] = None) -> Solid:
        """Returns a ball. ``radius``: > 0."""
        return Solid(_raylane.sphere_solid(center, radius, material))

    @staticmethod
    def half_space(point: ArrayLike, normal: ArrayLike, material: Optional[int] = None) -> Solid:
        """Returns the half-space behind a plane. The normal points away from the half-space."""
        return Solid(_raylane.half_space_solid(point, normal, material))

    @staticmethod
    def box(corner: ArrayLike, edges: ArrayLike, material: Optional[int] = None) -> Solid:
        """Returns a parallelepiped. ``edges``: (3, 3), with the edges from the corner as rows."""
        return Solid(_raylane.box_solid(corner, edges, material))

    @staticmethod
    def ellipsoid(center: ArrayLike, axes: ArrayLike, material: Optional[int] = None) -> Solid:
        """Returns an ellipsoid. ``axes``: (3, 3), with the semi-axes as rows."""
        return Solid(_raylane.ellipsoid_solid(center, axes, material))

    @staticmethod
    def aligned_box(lower: ArrayLike, upper: ArrayLike, material: Optional[int] = None) -> Solid:
        """Returns the box with faces across the axes and these opposite corners, lower < upper.

        The edges are upper - lower, rounded to float64.
        """
        return Solid.box(*aligned(lower, upper), material)

    @staticmethod
    def cylinder(
        base: ArrayLike, axis: ArrayLike, radius: float, material: Optional[int] = None, *, caps: bool = True
    ) -> Solid:
        """Returns the cylinder from a base along an axis. ``radius``: > 0. Without ``caps``: infinite both ways."""
        return Solid(_raylane.cylinder_solid(base, axis, radius, material, caps))

    @staticmethod
    def cone(
        base: ArrayLike,
        axis: ArrayLike,
        base_radius: float,
        top_radius: float = 0.0,
        material: Optional[int] = None,
        *,
        caps: bool = True,
    ) -> Solid:
        """Returns a cone or a frustum. Radii: >= 0, not both 0. Without ``caps``: the inside of both infinite nappes.
        """
        return Solid(_raylane.cone_solid(base, axis, base_radius, top_radius, material, caps))

    @staticmethod
    def quadric(center: ArrayLike, coefficients: ArrayLike, material: Optional[int] = None) -> Solid:
        """Returns all points x where Q(x - center) < 0. A scene needs bounded solids: intersect others with a box.

        ``coefficients``: (10,), as in :meth:`SceneBuilder.add_quadrics`.
        """
        return Solid(_raylane.quadric_solid(center, coefficients, material))

    @staticmethod
    def lens(
        vertex: ArrayLike,
        axis: ArrayLike,
        radii: Tuple[float, float],
        thickness: float,
        radius: float,
        conics: Tuple[float, float] = (0.0, 0.0),
        material: Optional[int] = None,
    ) -> Solid:
        """Returns a lens: the solid between two surfaces of revolution, inside of a cylinder of the given radius.

        ``vertex``: vertex of the first surface. ``axis``: from there to the second vertex, of any length except zero.
        ``radii``: radii of curvature, positive if the centre of curvature lies behind the surface in the direction of
        the axis; 0 is flat. ``thickness``: distance between the vertices. ``conics``: conic constants; 0 is a sphere.
        Raises :class:`InvalidValue` if the surfaces meet inside of the cylinder or do not reach it.
        """
        return Solid(_raylane.lens_solid(vertex, axis, radii, conics, thickness, radius, material))

    @staticmethod
    def union(solids: Iterable[Solid]) -> Solid:
        """Returns all points inside of at least one of the solids, one or more of them."""
        return Solid(_raylane.union_of([made(each) for each in solids]))

    @staticmethod
    def intersection(solids: Iterable[Solid]) -> Solid:
        """Returns all points inside of every one of the solids, one or more of them."""
        return Solid(_raylane.intersection_of([made(each) for each in solids]))

    @staticmethod
    def difference(whole: Solid, taken_away: Iterable[Solid]) -> Solid:
        """Returns all points inside of ``whole`` and outside of each solid in ``taken_away``."""
        return Solid(_raylane.difference_of(made(whole), [made(each) for each in taken_away]))

    def transformed(self, transform: Transform) -> Solid:
        """Returns the solid with each number of its shapes transformed and rounded once, to the nearest double.

        If the transform does not scale all lengths equally, spheres become ellipsoids, and cylinders and cones become
        solids of a quadric and planes, which have more ids. Raises :class:`InvalidValue` for an invalid shape.
        """
        return Solid(self._solid.transformed(inner_transform(transform)))

    def of(self, material: int) -> Solid:
        """Returns this solid with the given material. Parts that have their own material keep it."""
        return Solid(self._solid.of(material))

    def clipped(self, *by: Solid) -> Solid:
        """Returns the part of this solid's surface inside of all other solids. The cuts stay open, without faces."""
        return Solid(_raylane.clipped(self._solid, [made(each) for each in by]))

    def __or__(self, other: Solid) -> Solid:
        if not isinstance(other, Solid):
            return NotImplemented
        return Solid(_raylane.unite(self._solid, other._solid))

    def __and__(self, other: Solid) -> Solid:
        if not isinstance(other, Solid):
            return NotImplemented
        return Solid(_raylane.intersect(self._solid, other._solid))

    def __sub__(self, other: Solid) -> Solid:
        if not isinstance(other, Solid):
            return NotImplemented
        return Solid(_raylane.subtract(self._solid, other._solid))


def made(solid: Solid) -> _raylane.Solid:
    """Returns the compiled object of a solid. Raises TypeError for any other object."""
    if not isinstance(solid, Solid):
        raise TypeError(f"must be a raylane.Solid, not {type(solid).__name__}")
    return solid._solid


def aligned(lower: ArrayLike, upper: ArrayLike) -> Tuple[Any, Any]:
    """Returns the corners and the edges of axis-aligned boxes. Raises InvalidValue unless lower < upper."""
    for name, values in (("lower", lower), ("upper", upper)):
        _raylane.refuse_masked(values, name)
    low, high = np.asarray(lower, np.float64), np.asarray(upper, np.float64)
    for name, corner in (("lower", low), ("upper", high)):
        if corner.ndim not in (1, 2) or corner.shape[-1] != 3:
            raise InvalidValue(name, f"must have the shape (n, 3) or (3,), got {corner.shape}")
    try:
        low, high = np.broadcast_arrays(low, high)
    except ValueError:
        raise InvalidValue("upper", f"must have the shape {low.shape} of lower, got {high.shape}") from None
    if not np.all(low < high):
        raise InvalidValue("upper", "must be more than lower on each axis")
    return low, (high - low)[..., None] * np.eye(3)
