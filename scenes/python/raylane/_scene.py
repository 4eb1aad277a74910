"""Scenes: read, or built of arrays."""

from __future__ import annotations

import os
import tempfile
import warnings
from typing import TYPE_CHECKING, Any, Callable, List, Optional, Sequence, Tuple, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _raylane
from ._errors import BadInput, InvalidValue
from ._fields import Fields
from ._values import Camera, Fog, Light, Material, Settings, Vector

if TYPE_CHECKING:
    from ._image import Image

Ids = NDArray[np.uint32]


def _warn(remark: str) -> None:
    warnings.warn(remark, stacklevel=3)


class Scene:
    """A validated scene that never changes. Made by :func:`load`, :func:`parse` or :class:`SceneBuilder`.

    May be read by any number of threads at a time.
    """

    _scene: _raylane.Scene

    def __init__(self, scene: _raylane.Scene) -> None:
        self._scene = scene

    @property
    def shape_count(self) -> int:
        return self._scene.shape_count()

    @property
    def material_count(self) -> int:
        return self._scene.material_count()

    @property
    def bounds(self) -> Tuple[Vector, Vector]:
        """Of all shapes but planes: lower and upper corner. Without such shapes infinity to -infinity."""
        return self._scene.bounds()

    @overload
    def material_of(self, shapes: int) -> int: ...
    @overload
    def material_of(self, shapes: NDArray[Any]) -> Ids: ...
    def material_of(self, shapes: Any) -> Any:
        """The material's index of a shape, or of each of an array of shapes."""
        return self._scene.material_of(shapes)

    @overload
    def solid_of(self, shapes: int) -> int: ...
    @overload
    def solid_of(self, shapes: NDArray[Any]) -> Ids: ...
    def solid_of(self, shapes: Any) -> Any:
        """The id by which the solid goes that a shape is a part of; of others their own."""
        return self._scene.solid_of(shapes)

    def material(self, index: int) -> Material:
        return self._scene.material(index)

    @property
    def materials(self) -> List[Material]:
        return [self.material(index) for index in range(self.material_count)]

    @property
    def lights(self) -> List[Light]:
        return self._scene.lights()

    @property
    def fog(self) -> Fog:
        return self._scene.fog()

    @property
    def camera(self) -> Camera:
        return self._scene.camera()

    @property
    def background(self) -> Vector:
        return self._scene.background()

    def seen_by(self, camera: Camera) -> Scene:
        """The same shapes, seen by another camera. Takes little memory and time."""
        return Scene(self._scene.seen_by(camera))

    def camera_on_all(self, direction: Vector = (0.0, 0.0, -1.0), aspect: float = 1.0) -> Camera:
        """A camera that looks in a direction and sees all shapes that have bounds, as large as that may be.

        ``aspect``: the picture's width by its height. Raises :class:`InvalidValue` where there are no such shapes,
        or a camera would have to be beyond 1e30.
        """
        return self._scene.camera_on_all(direction, aspect)

    @property
    def settings(self) -> Settings:
        """Those of its picture: a copy, to change and to give to :func:`render`."""
        return self._scene.settings()

    def render(self, **options: Any) -> Image:
        """The same as :func:`raylane.render`."""
        from ._image import render

        return render(self, **options)

    def show(self, **options: Any) -> None:
        """Draws the scene and shows the picture: in a notebook, or else as the desktop shows pictures."""
        self.render(**options).show()

    def _repr_png_(self) -> bytes:
        return self.render()._repr_png_()

    def save(self, path: Union[str, os.PathLike[str]], on_remark: Callable[[str], object] = _warn) -> None:
        """Writes a file, in the format of its ending.

        ``.json`` has all of the scene that counts, to the bit, but which triangles make a polygon and, of what goes
        with a camera, that fog goes with one that has been given its place; ``.rl`` has these, too, and is mapped
        into memory rather than read, but has no solids that are made of others, and is for versions of raylane with
        the same format of it; ``.nff`` and ``.pov``, for other programs, have less. What is left out is warned of,
        or told to ``on_remark``. The file appears whole or not at all. Raises :class:`BadInput` for shapes that the
        format does not have, and for solids that are nested deeper than is read of it.
        """
        _raylane.save(self._scene, os.fspath(path), on_remark)

    def __copy__(self) -> Scene:
        return self

    def __deepcopy__(self, memo: Any) -> Scene:
        return self

    def __reduce__(self) -> Tuple[Any, ...]:
        """Pickled as ``.rl``, for versions of raylane with the same format of it, or, with solids, as ``.json``.

        What that does not have (:meth:`save`), as which triangles make a polygon, is warned of.
        """
        with tempfile.TemporaryDirectory() as room:
            try:
                name = "scene.rl"
                self.save(os.path.join(room, name))
            except BadInput:
                name = "scene.json"
                self.save(os.path.join(room, name))
            with open(os.path.join(room, name), "rb") as file:
                return parse, (file.read(), name)

    def __repr__(self) -> str:
        return f"<raylane.Scene: {self.shape_count} shapes, {self.material_count} materials>"


def inner(scene: Scene) -> _raylane.Scene:
    """What is compiled of it."""
    if not isinstance(scene, Scene):
        raise TypeError(f"must be a raylane.Scene, not {type(scene).__name__}")
    return scene._scene


class Solid:
    """A solid that is made of others; the operators ``|``, ``&`` and ``-`` join them, to any depth.

    >>> bowl = Solid.sphere((0, 0, 0), 1) - Solid.sphere((0, 0, 0), 0.9) - Solid.half_space((0, 0, 0), (0, -1, 0))
    """

    def __init__(self, solid: _raylane.Solid) -> None:
        self._solid = solid

    @staticmethod
    def sphere(center: ArrayLike, radius: float, material: Optional[int] = None) -> Solid:
        return Solid(_raylane.sphere_solid(center, radius, material))

    @staticmethod
    def half_space(point: ArrayLike, normal: ArrayLike, material: Optional[int] = None) -> Solid:
        """What is behind a plane, whose normal points away from it."""
        return Solid(_raylane.half_space_solid(point, normal, material))

    @staticmethod
    def box(corner: ArrayLike, edges: ArrayLike, material: Optional[int] = None) -> Solid:
        """A parallelepiped: a corner, and three edges as rows."""
        return Solid(_raylane.box_solid(corner, edges, material))

    @staticmethod
    def ellipsoid(center: ArrayLike, axes: ArrayLike, material: Optional[int] = None) -> Solid:
        """Semi-axes are rows."""
        return Solid(_raylane.ellipsoid_solid(center, axes, material))

    @staticmethod
    def cylinder(base: ArrayLike, axis: ArrayLike, radius: float, material: Optional[int] = None) -> Solid:
        return Solid(_raylane.cylinder_solid(base, axis, radius, material))

    @staticmethod
    def cone(
        base: ArrayLike, axis: ArrayLike, base_radius: float, top_radius: float = 0.0, material: Optional[int] = None
    ) -> Solid:
        return Solid(_raylane.cone_solid(base, axis, base_radius, top_radius, material))

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
        """A lens between two surfaces of revolution, in a cylinder of a radius.

        ``radii`` of curvature are positive where the centre is behind the surface, going along the axis; 0: flat.
        """
        return Solid(_raylane.lens_solid(vertex, axis, radii, conics, thickness, radius, material))

    def of(self, material: int) -> Solid:
        """The same of another material."""
        return Solid(self._solid.of(material))

    def clipped(self, *by: Solid) -> Solid:
        """What of its surface is in all of others: it is left open where it is cut."""
        return Solid(_raylane.clipped(self._solid, [_made(each) for each in by]))

    def __or__(self, other: Solid) -> Solid:
        if not isinstance(other, Solid):
            return NotImplemented
        return Solid(_raylane.union_of([self._solid, other._solid]))

    def __and__(self, other: Solid) -> Solid:
        if not isinstance(other, Solid):
            return NotImplemented
        return Solid(_raylane.intersection_of([self._solid, other._solid]))

    def __sub__(self, other: Solid) -> Solid:
        if not isinstance(other, Solid):
            return NotImplemented
        return Solid(_raylane.difference_of(self._solid, [other._solid]))


def _made(solid: Solid) -> _raylane.Solid:
    """What is compiled of it."""
    if not isinstance(solid, Solid):
        raise TypeError(f"must be a raylane.Solid, not {type(solid).__name__}")
    return solid._solid


class SceneBuilder(Fields):
    """Collects a scene, in any order, from arrays, and checks each value as it comes.

    Arrays have one row for each shape; a single row is for all of them, and so is a single number. Any strides
    will do. Arrays of float32 make shapes of floats; all others shapes of doubles, whose numbers count as they
    are. ``material`` is an index, or an array of one for each. What is added is told as the range of its ids:
    0, 1, 2, ... in the order in which shapes are added. Of arrays in which a shape is not valid, those before
    it have been added, and the error's field says which one it is.

    >>> import numpy as np
    >>> builder = SceneBuilder()
    >>> red = builder.add_material(Material(color=(1, 0, 0)))
    >>> builder.add_spheres(np.arange(12.0).reshape(4, 3), 0.5, material=red)
    range(0, 4)
    >>> scene = builder.build()
    """

    camera: Optional[Camera]
    """None: one that sees all from the front, or, where there are planes alone, or shapes that reach too far for
    one, ``Camera()``."""
    background: Vector
    fog: Fog
    settings: Settings
    wavelengths: List[float]
    """In nanometres, from 380 to 780: a picture is drawn for each, with the index that glass has for it."""

    def __init__(self) -> None:
        self._renew()

    def _renew(self) -> None:
        self._builder = _raylane.Builder()
        self.camera = None
        self.background = (0.0, 0.0, 0.0)
        self.fog = Fog()
        self.settings = Settings()
        self.wavelengths = []

    def add_material(self, material: Optional[Material] = None, **fields: Any) -> int:
        """The index by which shapes refer to it. ``add_material(color=...)`` makes a :class:`Material` of fields."""
        if material is not None and fields:
            raise TypeError("add_material takes a Material, or fields of one")
        return self._builder.add_material(Material(**fields) if material is None else material)

    def add_light(self, light: Optional[Light] = None, **fields: Any) -> None:
        """A :class:`Light`, or fields of one."""
        if light is not None and fields:
            raise TypeError("add_light takes a Light, or fields of one")
        self._builder.add_light(Light(**fields) if light is None else light)

    def add_spheres(self, centers: ArrayLike, radii: ArrayLike, *, material: ArrayLike) -> range:
        """(n, 3), (n,)"""
        return range(*self._builder.add_spheres(centers, radii, material))

    def add_ellipsoids(self, centers: ArrayLike, axes: ArrayLike, *, material: ArrayLike) -> range:
        """(n, 3), (n, 3, 3): semi-axes as rows, which need not be perpendicular to each other."""
        return range(*self._builder.add_ellipsoids(centers, axes, material))

    def add_planes(self, points: ArrayLike, normals: ArrayLike, *, material: ArrayLike) -> range:
        """(n, 3), (n, 3): unbounded."""
        return range(*self._builder.add_planes(points, normals, material))

    def add_discs(self, centers: ArrayLike, normals: ArrayLike, radii: ArrayLike, *, material: ArrayLike) -> range:
        """(n, 3), (n, 3), (n,)"""
        return range(*self._builder.add_discs(centers, normals, radii, material))

    def add_triangles(
        self, corners: ArrayLike, *, material: ArrayLike, normals: Optional[ArrayLike] = None
    ) -> range:
        """(n, 3, 3): corners as rows; and as many normals, to shade with, or none."""
        return range(*self._builder.add_triangles(corners, normals, material, False))

    def add_polygon(self, corners: ArrayLike, *, material: int, normals: Optional[ArrayLike] = None) -> range:
        """(n, 3, 3): triangles that tile one flat polygon. No reflection or shadow of one falls on another.

        If one is not valid, none is added, and the error's field says which one it is.
        """
        return range(*self._builder.add_triangles(corners, normals, material, True))

    def add_boxes(self, corners: ArrayLike, edges: ArrayLike, *, material: ArrayLike) -> range:
        """(n, 3), (n, 3, 3): parallelepipeds, with edges as rows."""
        return range(*self._builder.add_boxes(corners, edges, material))

    def add_cylinders(
        self, bases: ArrayLike, axes: ArrayLike, radii: ArrayLike, *, material: ArrayLike, caps: bool = True
    ) -> range:
        """(n, 3), (n, 3), (n,): from a base along an axis; solid, or without caps an open surface."""
        return range(*self._builder.add_cylinders(bases, axes, radii, material, caps))

    def add_cones(
        self,
        bases: ArrayLike,
        axes: ArrayLike,
        base_radii: ArrayLike,
        top_radii: ArrayLike = 0.0,
        *,
        material: ArrayLike,
        caps: bool = True,
    ) -> range:
        """(n, 3), (n, 3), (n,), (n,): solid cones and frusta, or without caps open surfaces."""
        return range(*self._builder.add_cones(bases, axes, base_radii, top_radii, material, caps))

    def add_quadrics(
        self, centers: ArrayLike, coefficients: ArrayLike, lower: ArrayLike, upper: ArrayLike, *, material: ArrayLike
    ) -> range:
        """(n, 3), (n, 10), (n, 3), (n, 3): Q(p) = 0 for lower <= p <= upper, p = x - center.

        Coefficients are xx, yy, zz, xy, xz, yz, x, y, z, one, of
        Q = xx px^2 + yy py^2 + zz pz^2 + 2 (xy px py + xz px pz + yz py pz) + 2 (x px + y py + z pz) + one.
        """
        return range(*self._builder.add_quadrics(centers, coefficients, lower, upper, material))

    def add_solid(self, solid: Solid, *, material: int) -> range:
        """A solid of others: the ids of its parts. It goes by the first; ``material`` is of what has none."""
        return range(*self._builder.add_solid(_made(solid), material))

    def __len__(self) -> int:
        return self._builder.shape_count()

    def build(self) -> Scene:
        """Checks the whole, and hands the scene over. The builder is new then.

        Where an attribute is not what it may be, :class:`InvalidValue` names it, and the builder keeps what it has;
        not so where it is by its shapes and lights that the whole is refused, as for a light on a surface. Shapes
        that reach so far that a camera on all would be beyond 1e30 are warned of, and seen by ``Camera()``.
        """
        builder, camera, settings = self._builder, self.camera, self.settings
        others = (self.background, self.fog, settings, self.wavelengths)
        _raylane.check(camera, *others)
        self._renew()
        scene = Scene(builder.build(camera, *others))
        if camera is not None or not np.all(np.less_equal(*scene.bounds)):
            return scene
        aspect = min(max(settings.width / settings.height, 1e-5), 1e5)
        try:
            return scene.seen_by(scene.camera_on_all(aspect=aspect))
        except InvalidValue as error:
            warnings.warn(f"{error}; as yet it has Camera()", stacklevel=2)
            return scene


# What a file says and the scene does not have.
def load(path: Union[str, os.PathLike[str]], on_remark: Callable[[str], object] = _warn) -> Scene:
    """Reads a scene: JSON, NFF, POV-Ray's language, Tachyon's, what ``raylane build`` or :meth:`Scene.save` has made; or atoms.

    The format follows the file's ending or else its content; ``"-"`` is a file of that name. Raises
    :class:`BadInput` for a file that is malformed, in JSON with up to ten of its mistakes, or not there, and
    :class:`SystemRefused`. What a file says and the scene does not have is warned of, or told to
    ``on_remark``.
    """
    return Scene(_raylane.load(os.fspath(path), on_remark))


def parse(text: Union[str, bytes], name: str = "scene", on_remark: Callable[[str], object] = _warn) -> Scene:
    """The same for a scene in memory. ``name`` is what messages call it; the format follows its ending."""
    if not isinstance(text, (str, bytes, bytearray, memoryview)):
        raise TypeError(f"text must be a str or bytes, not {type(text).__name__}")
    if not isinstance(name, str):
        raise TypeError(f"name must be a str, not {type(name).__name__}")
    data = text.encode() if isinstance(text, str) else bytes(text)
    return Scene(_raylane.parse(data, name, on_remark))
