"""Groups of objects with a common transform or material."""

from __future__ import annotations

from typing import Optional

from . import _raylane
from ._adding import Adding
from ._solids import Solid, Transform, inner_transform


class Group(Adding):
    """Objects with a common transform or material: shapes, solids, and the members of other groups.

    Unlike the parts of a solid, they stay separate objects. :meth:`SceneBuilder.add_group` takes a group any number of
    times, transformed or not: these are the instances of a file. The methods that add objects are those of
    :class:`SceneBuilder`. They return the range of the numbers of the new members: 0, 1, 2, ... Members without a
    material take that of the group, of a group around it or of the builder.

    >>> table = Group()
    >>> table.add_aligned_boxes((-1, 0.9, -1), (1, 1, 1))
    range(0, 1)
    >>> table.add_cylinders([(-0.9, 0, -0.9), (0.9, 0, -0.9), (-0.9, 0, 0.9), (0.9, 0, 0.9)], (0, 0.9, 0), 0.05)
    range(1, 5)
    """

    def __init__(self, group: Optional[_raylane.Group] = None) -> None:
        self._to = _raylane.Group() if group is None else group

    def transformed(self, transform: Transform) -> Group:
        """Returns the group with each number of its shapes transformed and rounded once, to the nearest double.

        If the transform does not scale all lengths equally, spheres become ellipsoids, and cylinders and cones become
        solids of a quadric and planes, which have more ids. A quadric becomes a solid that its transformed box clips.
        Raises :class:`InvalidValue` for a disc that is not scaled equally.
        """
        return Group(self._own().transformed(inner_transform(transform)))

    def of(self, material: int) -> Group:
        """Returns the group with the material for members without one."""
        return Group(self._own().of(material))

    def solid(self) -> Solid:
        """Returns the union of the members, which are solids and half-spaces, for use as a part of another solid.

        The box of a quadric closes the quadric. Raises :class:`InvalidValue` if the group is empty.
        """
        return Solid(self._own().solid())

    def _own(self) -> _raylane.Group:
        assert isinstance(self._to, _raylane.Group)
        return self._to

    def __len__(self) -> int:
        return self._to.count()
