"""Adding shapes, solids and groups to a scene or to a group."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Union

from numpy.typing import ArrayLike

from . import _raylane
from ._fields import Fields
from ._shapes import Shapes
from ._solids import Solid, aligned, made

if TYPE_CHECKING:
    from ._group import Group


class Adding(Fields):
    """Base class of :class:`SceneBuilder` and :class:`Group`: the methods that add objects.

    An array has one row per shape, or is a single row for all shapes. Coordinates and lengths are from -1e30 to 1e30.
    """

    _to: Union[_raylane.Builder, _raylane.Group]

    def add_spheres(self, centers: ArrayLike, radii: ArrayLike, *, material: Optional[ArrayLike] = None) -> range:
        """Adds spheres. ``centers``: (n, 3). ``radii``: (n,), > 0."""
        return range(*self._to.add_spheres(centers, radii, material))

    def add_ellipsoids(self, centers: ArrayLike, axes: ArrayLike, *, material: Optional[ArrayLike] = None) -> range:
        """Adds solid ellipsoids. ``centers``: (n, 3). ``axes``: (n, 3, 3), semi-axes as rows, perpendicular or not."""
        return range(*self._to.add_ellipsoids(centers, axes, material))

    def add_planes(self, points: ArrayLike, normals: ArrayLike, *, material: Optional[ArrayLike] = None) -> range:
        """Adds unbounded planes. ``points``: (n, 3). ``normals``: (n, 3), to the front, of any length except zero."""
        return range(*self._to.add_planes(points, normals, material))

    def add_discs(
        self, centers: ArrayLike, normals: ArrayLike, radii: ArrayLike, *, material: Optional[ArrayLike] = None
    ) -> range:
        """Adds discs. ``centers``: (n, 3). ``radii``: (n,), > 0.

        ``normals``: (n, 3), to the front, of any length except zero.
        """
        return range(*self._to.add_discs(centers, normals, radii, material))

    def add_triangles(
        self, corners: ArrayLike, *, material: Optional[ArrayLike] = None, normals: Optional[ArrayLike] = None
    ) -> range:
        """Adds triangles. ``corners``: (n, 3, 3), corners as rows, not collinear. The front is the side from which they
        run counter-clockwise. ``normals``: shading normals, (n, 3, 3), or None.
        """
        return range(*self._to.add_triangles(corners, normals, material, False))

    def add_boxes(self, corners: ArrayLike, edges: ArrayLike, *, material: Optional[ArrayLike] = None) -> range:
        """Adds solid parallelepipeds. ``corners``: (n, 3). ``edges``: (n, 3, 3), the edges from the corner as rows."""
        return range(*self._to.add_boxes(corners, edges, material))

    def add_cylinders(
        self,
        bases: ArrayLike,
        axes: ArrayLike,
        radii: ArrayLike,
        *,
        material: Optional[ArrayLike] = None,
        caps: bool = True,
    ) -> range:
        """Adds cylinders from a base along an axis: solids with ``caps``, otherwise open surfaces.

        ``bases``: (n, 3). ``axes``: (n, 3), from the base to the top. ``radii``: (n,), > 0.
        """
        return range(*self._to.add_cylinders(bases, axes, radii, material, caps))

    def add_cones(
        self,
        bases: ArrayLike,
        axes: ArrayLike,
        base_radii: ArrayLike,
        top_radii: ArrayLike = 0.0,
        *,
        material: Optional[ArrayLike] = None,
        caps: bool = True,
    ) -> range:
        """Adds cones and frusta: solids with ``caps``, otherwise open surfaces.

        ``bases``: (n, 3). ``axes``: (n, 3), from the base to the top. ``base_radii`` and ``top_radii``: (n,), >= 0, not
        both 0.
        """
        return range(*self._to.add_cones(bases, axes, base_radii, top_radii, material, caps))

    def add_quadrics(
        self,
        centers: ArrayLike,
        coefficients: ArrayLike,
        lower: ArrayLike,
        upper: ArrayLike,
        *,
        material: Optional[ArrayLike] = None,
    ) -> range:
        """Adds quadrics: the surfaces Q(p) = 0 for lower <= p <= upper, p = x - center.

        ``centers``, ``lower`` and ``upper``: (n, 3); ``lower`` and ``upper`` are relative to the centre, not world
        coordinates. The outside is where Q > 0. ``coefficients``: (n, 10), in the order xx, yy, zz, xy, xz, yz,
        x, y, z, one, of
        Q = xx px^2 + yy py^2 + zz pz^2 + 2 (xy px py + xz px pz + yz py pz) + 2 (x px + y py + z pz) + one.
        """
        return range(*self._to.add_quadrics(centers, coefficients, lower, upper, material))

    def add_aligned_boxes(self, lower: ArrayLike, upper: ArrayLike, *, material: Optional[ArrayLike] = None) -> range:
        """Adds boxes with faces across the axes. ``lower`` and ``upper``: opposite corners, (n, 3), lower < upper. The
        edges are upper - lower, rounded to float64.
        """
        corners, edges = aligned(lower, upper)
        return self.add_boxes(corners, edges, material=material)

    def add(self, shapes: Shapes) -> range:
        """Adds shapes that a scene gave back, such as ``scene.spheres()`` or ``scene.shape(id)``.

        Their materials have the indices that they had in that scene.
        """
        if not isinstance(shapes, Shapes):
            raise TypeError(f"must be a raylane.Shapes, not {type(shapes).__name__}")
        return shapes._add_to(self)

    def add_solid(self, solid: Solid, *, material: Optional[int] = None) -> range:
        """Adds a constructed solid.

        ``material`` applies to parts without a material, and to the inside of the solid if that has none. If it is None
        and all parts have materials, the inside has that of the first part. In a scene, the range has the ids of the
        parts; the first one is also the id of the solid.
        """
        return range(*self._to.add_solid(made(solid), material))

    def add_group(self, group: Group, *, material: Optional[int] = None) -> range:
        """Adds all members of a group, which stay separate objects. ``material``: for members without one."""
        return range(*self._to.add_group(inner_group(group), material))


def inner_group(group: Any) -> _raylane.Group:
    """Returns the compiled object of a group. Raises TypeError for any other object."""
    to = getattr(group, "_to", None)
    if not isinstance(to, _raylane.Group):
        raise TypeError(f"must be a raylane.Group, not {type(group).__name__}")
    return to
