"""Shapes that a scene gives back."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Tuple, Union

import numpy as np
from numpy.typing import NDArray

_AXIAL = (("base", (3,)), ("axis", (3,)))
_ROUND = (*_AXIAL, ("radius", ()))
_CONICAL = (*_AXIAL, ("base_radius", ()), ("top_radius", ()))
_BOX = (("lower", (3,)), ("upper", (3,)))

# For each kind of shape: the builder's method, its options, and the arrays with the shapes of their rows.
_KINDS: Dict[str, Tuple[str, Dict[str, Any], Tuple[Tuple[str, Tuple[int, ...]], ...]]] = {
    "sphere": ("add_spheres", {}, (("center", (3,)), ("radius", ()))),
    "ellipsoid": ("add_ellipsoids", {}, (("center", (3,)), ("axes", (3, 3)))),
    "plane": ("add_planes", {}, (("point", (3,)), ("normal", (3,)))),
    "disc": ("add_discs", {}, (("center", (3,)), ("normal", (3,)), ("radius", ()))),
    "triangle": ("add_triangles", {}, (("corners", (3, 3)),)),
    "smooth triangle": ("add_triangles", {}, (("corners", (3, 3)), ("normals", (3, 3)))),
    "box": ("add_boxes", {}, (("corner", (3,)), ("edges", (3, 3)))),
    "open cylinder": ("add_cylinders", {"caps": False}, _ROUND),
    "capped cylinder": ("add_cylinders", {}, _ROUND),
    "open cone": ("add_cones", {"caps": False}, _CONICAL),
    "capped cone": ("add_cones", {}, _CONICAL),
    "quadric": ("add_quadrics", {}, (("center", (3,)), ("coefficients", (10,)), *_BOX)),
}
_ARGUMENTS = {
    "center": "centers",
    "radius": "radii",
    "point": "points",
    "normal": "normals",
    "corner": "corners",
    "base": "bases",
    "axis": "axes",
    "base_radius": "base_radii",
    "top_radius": "top_radii",
}


class Shapes:
    """n shapes of one kind, or one shape, that a scene gave back. :meth:`SceneBuilder.add` takes them.

    The numbers are exactly those of the shapes, in float32 if all of them are float32 values, otherwise in float64. For
    one shape, from :meth:`Scene.shape`, arrays lack the first axis, (n,). Attributes by kind:

    - ``"sphere"``: ``center`` (n, 3), ``radius`` (n,)
    - ``"ellipsoid"``: ``center`` (n, 3), ``axes`` (n, 3, 3), semi-axes as rows
    - ``"plane"``: ``point`` (n, 3), ``normal`` (n, 3)
    - ``"disc"``: ``center`` (n, 3), ``normal`` (n, 3), ``radius`` (n,)
    - ``"triangle"``, ``"smooth triangle"``: ``corners`` (n, 3, 3), corners as rows; ``normals`` (n, 3, 3) if smooth
    - ``"box"``: ``corner`` (n, 3), ``edges`` (n, 3, 3), edges as rows
    - ``"open cylinder"``, ``"capped cylinder"``: ``base`` (n, 3), ``axis`` (n, 3), ``radius`` (n,)
    - ``"open cone"``, ``"capped cone"``: ``base`` (n, 3), ``axis`` (n, 3), ``base_radius`` (n,), ``top_radius`` (n,)
    - ``"quadric"``: ``center`` (n, 3), ``coefficients`` (n, 10), ``lower`` (n, 3), ``upper`` (n, 3)
    """

    kind: str
    """The type, with its ends: ``"sphere"``, ``"open cylinder"``, ..."""
    shape_id: Union[NDArray[np.uint32], int]
    """(n,): ids, ascending."""
    material: Union[NDArray[np.uint32], int]
    """(n,): indices of materials."""

    def __init__(self, kind: str, shape_id: Any, material: Any, numbers: NDArray[Any]) -> None:
        self.kind = kind
        self.shape_id = shape_id
        self.material = material
        at = 0
        for name, row in _KINDS[kind][2]:
            end = at + int(np.prod(row, dtype=int))
            # The copy is contiguous and does not keep the other numbers.
            setattr(self, name, numbers[..., at:end].copy().reshape(numbers.shape[:-1] + row)[()])
            at = end

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> NDArray[Any]: ...

    def _add_to(self, builder: Any) -> range:
        """Calls the method of a builder that adds such shapes."""
        method, options, columns = _KINDS[self.kind]
        arrays = {_ARGUMENTS.get(name, name): getattr(self, name) for name, _ in columns}
        added: range = getattr(builder, method)(**arrays, **options, material=self.material)
        return added

    def __len__(self) -> int:
        return len(self.shape_id)  # type: ignore[arg-type]  # one shape has no length, like a number

    def __repr__(self) -> str:
        if np.ndim(self.shape_id) != 0:
            return f'<raylane.Shapes: {len(self)} of the kind "{self.kind}">'
        values = ", ".join(f"{name} {getattr(self, name)}" for name, _ in _KINDS[self.kind][2])
        return f"<raylane.Shapes: {self.kind} {self.shape_id} of material {self.material}, {values}>"
