"""Scenes, read from files or built from arrays."""

from __future__ import annotations

import os
import sys
import tempfile
import warnings
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Optional, Sequence, Tuple, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _raylane
from ._adding import Adding, inner_group
from ._atom_options import read_atoms
from ._errors import BadInput, InvalidValue
from ._renamed import ids_in
from ._shapes import Shapes
from ._values import AutoCamera, Camera, Color, Fog, Light, Material, Settings, Vector

if TYPE_CHECKING:
    from ._group import Group
    from ._image import Image

Ids = NDArray[np.uint32]


def _warn(remark: str) -> None:
    """Warns at the line outside of this package that led here."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
        level, frame = level + 1, frame.f_back
    warnings.warn(remark, stacklevel=level)


class Scene:
    """A validated, immutable scene. :func:`load`, :func:`parse` and :class:`SceneBuilder` create scenes.

    Any number of threads may use a scene concurrently.
    """

    _scene: _raylane.Scene

    def __init__(self, scene: _raylane.Scene, has_look: bool = False) -> None:
        self._scene = scene
        self._has_look = has_look  # whose outlines are as thick on a larger image

    @property
    def shape_count(self) -> int:
        return self._scene.shape_count()

    @property
    def material_count(self) -> int:
        return self._scene.material_count()

    @property
    def bounds(self) -> Tuple[Vector, Vector]:
        """Lower and upper corner of the bounds of all shapes except planes; inf and -inf without such shapes."""
        return self._scene.bounds()

    @overload
    def material_of(self, shapes: int) -> int: ...
    @overload
    def material_of(self, shapes: NDArray[Any]) -> NDArray[np.int64]: ...
    def material_of(self, shapes: Any) -> Any:
        """Returns the material index of a shape, or an array of them for an array of ids.

        -1 for ``NO_SHAPE``, the id of a miss. Raises :class:`InvalidValue` if the scene has no shape with an id.
        """
        return self._scene.material_of(ids_in(shapes))

    @overload
    def solid_of(self, shapes: int) -> int: ...
    @overload
    def solid_of(self, shapes: NDArray[Any]) -> Ids: ...
    def solid_of(self, shapes: Any) -> Any:
        """Returns the id of the solid that a shape is a part of: the id of the solid's first part.

        Returns the id of any other shape unchanged, and ``NO_SHAPE`` for ``NO_SHAPE``. Takes an id or an array of ids.
        """
        return self._scene.solid_of(ids_in(shapes))

    def shape(self, id: int) -> Shapes:
        """Returns one shape with exactly the numbers that it was given, or that :meth:`with_positions` gave it.

        For a part of a constructed solid, returns the part as it was given, except that ``lower`` and ``upper`` of a
        quadric are bounds of its visible surface. Takes time in proportion to the number of shapes, 4 ms for a million:
        for many shapes use :meth:`spheres` and the methods after it, which take 0.2 s for a million. Raises
        :class:`InvalidValue` if the scene has no shape with this id.
        """
        kind, numbers = self._scene.shape(id)
        return Shapes(kind, int(id), self.material_of(id), numbers[0])

    def spheres(self) -> Shapes:
        """Returns all spheres in the order of their ids, as :class:`Shapes`.

        Like the following methods, returns the numbers that the shapes were given, or that :meth:`with_positions` gave
        them. Equal shapes that count as one are all returned. Parts of constructed solids are not. So row i is that
        of :meth:`with_positions`. Which triangles form a polygon is lost.
        """
        return self._shapes("sphere")

    def ellipsoids(self) -> Shapes:
        return self._shapes("ellipsoid")

    def planes(self) -> Shapes:
        return self._shapes("plane")

    def discs(self) -> Shapes:
        return self._shapes("disc")

    def triangles(self, smooth: bool = False) -> Shapes:
        """Returns the triangles without normals or, if ``smooth``, those with normals. See :meth:`spheres`."""
        return self._shapes("smooth triangle" if smooth else "triangle")

    def boxes(self) -> Shapes:
        return self._shapes("box")

    def cylinders(self, caps: bool = True) -> Shapes:
        """Returns the cylinders with ``caps``, which are solids, or those without. See :meth:`spheres`."""
        return self._shapes("capped cylinder" if caps else "open cylinder")

    def cones(self, caps: bool = True) -> Shapes:
        """Returns the cones and frusta with ``caps``, which are solids, or those without. See :meth:`spheres`."""
        return self._shapes("capped cone" if caps else "open cone")

    def quadrics(self) -> Shapes:
        return self._shapes("quadric")

    def _shapes(self, kind: str) -> Shapes:
        return Shapes(kind, *self._scene.shapes(kind))

    def material(self, index: int) -> Material:
        """Returns a material by its index. Raises :class:`InvalidValue` if the scene has no such material."""
        return self._scene.material(index)

    def material_name(self, index: int) -> str:
        """Returns the name that a material has in its file, or that its builder was given; empty if it has none."""
        return self._scene.material_name(index)

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

    def seen_by(self, camera: Union[Camera, str, Dict[str, Any]]) -> Scene:
        """Returns a scene with the same shapes and another camera. Takes little memory and time.

        ``camera`` may be its JSON, see :meth:`Camera.from_json`.
        """
        if isinstance(camera, (str, dict)):
            camera = Camera.from_json(camera)
        return Scene(self._scene.seen_by(camera), self._has_look)

    def with_positions(self, positions: ArrayLike) -> Scene:
        """Returns a scene whose spheres have moved; all else stays, such as their radii and ids.

        ``positions``: shape (n, 3), float32 or float64, within -1e30 to 1e30. Row i becomes the centre of the i-th
        sphere in the order of the ids, without spheres that are parts of constructed solids. Rows that are contiguous
        are read in place. Annotations are left out, as they are those of the atoms before. The camera stays; fit another one by :meth:`camera_on_all` and :meth:`seen_by`. All answers
        and images have the bits of a scene that is built of these shapes. Raises :class:`InvalidValue` for another
        number of rows (field ``positions``), for an invalid coordinate (``positions/17/2``), and for a point light on
        a surface.
        """
        return Scene(self._scene.with_positions(positions), self._has_look)

    def camera_on_all(self, direction: Vector = (0.0, 0.0, -1.0), aspect: float = 1.0) -> Camera:
        """Returns a perspective camera that shows all bounded shapes as large as possible.

        ``direction``: line of sight, of any length except zero. ``aspect``: the image's width divided by its height,
        1e-5 to 1e5. Raises :class:`InvalidValue` if an argument is out of range, if the scene has no bounded shapes,
        or if the camera would have to be beyond 1e30.
        """
        return self._scene.camera_on_all(direction, aspect)

    @property
    def settings(self) -> Settings:
        """Settings of the scene's image. They are a copy, which can be changed and passed to :func:`render`."""
        return self._scene.settings()

    def render(self, **options: Any) -> Image:
        """Renders the scene. Same as :func:`raylane.render`."""
        from ._image import render

        return render(self, **options)

    def show(self, **options: Any) -> None:
        """Renders the scene and shows the image. ``options`` as in :func:`raylane.render`; see :meth:`Image.show`."""
        self.render(**options).show()

    def _repr_png_(self) -> bytes:
        return self.render()._repr_png_()

    def save(self, path: Union[str, os.PathLike[str]], on_remark: Callable[[str], object] = _warn) -> None:
        """Writes the scene to a file. The ending, in upper or lower case, decides the format.

        - ``.json``: everything that is visible of the scene, to the bit. It does not store which triangles form a
          polygon. If :meth:`seen_by` has replaced an automatic camera, it does not store that the depth-cue fog
          follows the camera.
        - ``.rl``: the scene with both of these, as in memory. :func:`load` maps the file instead of parsing it. It
          cannot hold constructed solids, and only versions of raylane with the same version of this format read it.
        - ``.nff`` and ``.pov``: for other programs, with less of the scene.

        Calls ``on_remark`` for each feature that the format cannot express; default: a warning. The file appears
        complete or not at all. Raises :class:`BadInput` for another ending, for shapes that the format does not
        support, and for solids nested deeper than raylane reads them from that format. Raises :class:`SystemRefused`.
        """
        _raylane.save(self._scene, os.fspath(path), on_remark)

    def __copy__(self) -> Scene:
        return self

    def __deepcopy__(self, memo: Any) -> Scene:
        return self

    def __reduce__(self) -> Tuple[Any, ...]:
        """Pickles the scene as ``.rl`` or, if it has constructed solids, as ``.json``.

        Only versions of raylane with the same version of the format ``.rl`` read the former. Features that ``.json``
        cannot express (:meth:`save`), such as which triangles form a polygon, and annotations produce warnings.
        """
        with tempfile.TemporaryDirectory() as folder:
            try:
                name = "scene.rl"
                self.save(os.path.join(folder, name))
            except BadInput:
                name = "scene.json"
                self.save(os.path.join(folder, name))
            with open(os.path.join(folder, name), "rb") as file:
                return parse, (file.read(), name)

    def __repr__(self) -> str:
        return f"<raylane.Scene: {self.shape_count} shapes, {self.material_count} materials>"


def inner(scene: Scene) -> _raylane.Scene:
    """Returns the compiled object of a scene. Raises TypeError for any other object."""
    if not isinstance(scene, Scene):
        raise TypeError(f"must be a raylane.Scene, not {type(scene).__name__}")
    return scene._scene


class SceneBuilder(Adding):
    """Builds a scene from arrays, which are added in any order, and checks each value as it is added.

    An array has one row per shape; a single row or number applies to all shapes. Any strides are allowed. If all
    arrays are float32, the shapes are stored in float, otherwise in double. ``material``: an index, or an array with
    one index per shape. Objects without a material have the default one, ``Material()``, which gets an index when it is
    first used. Methods that add shapes return the range of the new ids: 0, 1, 2, ... in the order in which
    shapes are added. They raise :class:`InvalidValue` for an invalid shape; its field gives the number of the shape,
    and the shapes before it have been added. Lengths are in the scene's unit.

    >>> import numpy as np
    >>> builder = SceneBuilder()
    >>> red = builder.add_material(Material(color=(1, 0, 0)))
    >>> builder.add_spheres(np.arange(12.0).reshape(4, 3), 0.5, material=red)
    range(0, 4)
    >>> scene = builder.build()
    """

    camera: Union[Camera, AutoCamera, None]
    """An :class:`AutoCamera` is placed by :meth:`build`. None: a camera that shows all shapes from the front, or
    ``Camera()`` if there are only planes, or if the shapes extend too far for such a camera."""
    camera_lights: bool
    """True: :meth:`build` adds two lights after the others, which :meth:`Scene.seen_by` moves with the camera: a sky
    whose zenith is upward in the image, and a lamp over the camera's left shoulder. A file with an automatic camera and
    without a list of lights has them."""
    background: Color
    fog: Fog
    settings: Settings
    wavelengths: List[float]
    """At most 64 wavelengths in nanometres, 380 to 780. Each is rendered with the index of glass at that wavelength."""
    merge_duplicates: bool
    """True: shapes with equal numbers and the same material index count as one shape, the first. Queries never return
    the ids of the others. This does not apply to triangles of polygons and to parts of solids. False: each of them
    counts, for example in tallies of crossings. Thousands of equal shapes then slow down rays that meet them."""

    keep_from: int
    """Number of shapes in one call of :meth:`add_copies` from which copies are kept. Fewer are faster as shapes."""

    def __init__(self, merge_duplicates: bool = True, keep_from: int = 2**22) -> None:
        self.merge_duplicates = merge_duplicates
        self.keep_from = keep_from
        self._renew()

    def _renew(self) -> None:
        self._to = self._builder = _raylane.Builder()
        self.camera = None
        self.camera_lights = False
        self.background = (0.0, 0.0, 0.0)
        self.fog = Fog()
        self.settings = Settings()
        self.wavelengths = []

    def add_material(self, material: Optional[Material] = None, *, name: str = "", **fields: Any) -> int:
        """Adds a :class:`Material`, or ``Material(**fields)``. Returns the index by which shapes refer to it.

        :meth:`Scene.save` writes the name. Several materials may have one name.
        """
        if material is not None and fields:
            raise TypeError("add_material takes a Material, or fields of one")
        return self._builder.add_material(Material(**fields) if material is None else material, name)

    def add_light(self, light: Optional[Light] = None, **fields: Any) -> None:
        """Adds a :class:`Light`, or ``Light(**fields)``."""
        if light is not None and fields:
            raise TypeError("add_light takes a Light, or fields of one")
        self._builder.add_light(Light(**fields) if light is None else light)

    def add_polygon(
        self, corners: ArrayLike, *, material: Optional[int] = None, normals: Optional[ArrayLike] = None
    ) -> range:
        """Adds triangles that tile one flat polygon. No reflection or shadow of one falls on another.

        ``corners``: (n, 3, 3), corners as rows. ``normals``: shading normals, (n, 3, 3), or None. If a triangle is
        invalid, or off the common plane by more than 2^-14 of the distance between corners and 2^-20 of the
        coordinates, adds none; the field of the :class:`InvalidValue` gives the number of the triangle.
        """
        return range(*self._builder.add_triangles(corners, normals, material, True))

    def add_sphereflake(
        self,
        center: ArrayLike,
        radius: float,
        depth: int,
        up: ArrayLike = (0.0, 0.0, 1.0),
        *,
        material: Optional[int] = None,
    ) -> range:
        """Adds a sphere with nine spheres of a third of its radius around it, each of which has nine again, and so on.

        ``depth``: 0 to 8, for 1, 10, 91, 820, ..., 48427561 spheres. ``up``: direction of the first three of the nine,
        of any length except zero. Numbers are rounded to float32.
        """
        return range(*self._builder.add_sphereflake(center, radius, depth, up, material))

    def add_copies(
        self,
        group: Group,
        translate: ArrayLike,
        *,
        rotate: ArrayLike = (0.0, 0.0, 0.0),
        scale: ArrayLike = 1.0,
        material: Optional[int] = None,
    ) -> range:
        """Adds copies of a group, each scaled, then rotated about the axes x, y and z, then translated.

        ``translate`` and ``rotate`` (degrees): (n, 3) or (3,). ``scale``: (n,) or a number, > 0. ``material``: for
        members without one. The ids are those of the copies' shapes, one copy after the other.

        From :attr:`keep_from` shapes on, spheres and cylinders without transmission take less than 100 bytes a copy, if the scene
        has no constructed solids. Shapes that rays have hit take memory from then on. Results and images have the bits
        of a scene with shapes in place of the copies, except that equal shapes of different copies count separately.
        For such a scene ``Tracer.contains``, ``Tracer.cells``, ``Tracer.closest``, ``with_positions`` and
        :meth:`Scene.save` to ``.rl`` raise an exception. Rays always have the precision ``"exact"``.
        """
        return range(
            *self._builder.add_copies(inner_group(group), translate, rotate, scale, material, self.keep_from)
        )

    def add_lattice(
        self,
        n: int,
        spacing: float,
        sphere_radius: float,
        strut_radius: float,
        *,
        corner: Optional[ArrayLike] = None,
        center: Optional[ArrayLike] = None,
        material: Optional[int] = None,
        strut_material: Optional[int] = None,
    ) -> range:
        """Adds a cubic grid of n^3 spheres, followed by the 3 n^2 (n - 1) open cylinders between neighbours.

        ``n``: nodes per side, 1 to 256. ``spacing`` (between neighbours) and radii: > 0, rounded to float32. Give
        either ``corner``, the node with the smallest coordinates, or ``center``, that of all nodes. ``strut_material``:
        of the cylinders; default: that of the spheres.
        """
        return range(
            *self._builder.add_lattice(n, spacing, sphere_radius, strut_radius, corner, center, material, strut_material)
        )

    def __len__(self) -> int:
        return self._builder.count()

    def build(self) -> Scene:
        """Checks the scene as a whole and returns it. Leaves the builder empty.

        Raises :class:`InvalidValue` for an invalid attribute; the builder then keeps its contents. Raises
        :class:`InvalidValue` also for shapes and lights that do not fit together, such as a light on a surface; the
        builder is then empty. If ``camera`` is None and a camera that shows all shapes would have to be beyond 1e30,
        warns and uses ``Camera()``.
        """
        builder, camera, settings = self._builder, self.camera, self.settings
        others = (self.background, self.fog, settings, self.wavelengths)
        lights = self.camera_lights
        _raylane.check(camera, *others)
        self._renew()
        scene = Scene(builder.build(camera, *others, self.merge_duplicates, lights))
        if camera is not None or not np.all(np.less_equal(*scene.bounds)):
            return scene
        aspect = min(max(settings.width / settings.height, 1e-5), 1e5)
        try:
            return scene.seen_by(scene.camera_on_all(aspect=aspect))
        except InvalidValue as error:
            warnings.warn(f"{error}; Camera() is used", stacklevel=2)
            return scene


# The default on_remark issues a warning for each part of a file that raylane ignores.
def load(
    path: Union[str, os.PathLike[str]],
    on_remark: Callable[[str], object] = _warn,
    *,
    style: Optional[str] = None,
    representations: Optional[Sequence[str]] = None,
    **options: Any,
) -> Scene:
    """Reads a scene from a file in JSON, NFF, the languages of POV-Ray or Tachyon, or ``.rl``, or from a file of atoms.

    The file's ending decides the format, or its content if the ending is unknown. ``"-"`` is a file of that name.
    Calls ``on_remark`` for each part of the file that raylane ignores; default: a warning. Raises :class:`BadInput`
    for a malformed or missing file, in JSON with up to ten mistakes, and :class:`SystemRefused`.

    For files of atoms, ``style``, ``representations`` and the other options are those of :func:`from_atoms`, and
    ``cell=True`` shows the edges of the cell, and ``frame`` is the number of a trajectory's frame, from 0; -1 is the
    last one. :class:`BadInput` also if the file is another scene.
    """
    name = os.fspath(path)
    return read_atoms(
        lambda texts, remarks: Scene(_raylane.load(name, texts, remarks), "look" in options),
        style,
        representations,
        options,
        on_remark,
    )


def parse(text: Union[str, bytes], name: str = "scene", on_remark: Callable[[str], object] = _warn) -> Scene:
    """Reads a scene from memory, as :func:`load` does. ``name`` stands for the file's name in messages and in the
    choice of the format.
    """
    if not isinstance(text, (str, bytes, bytearray, memoryview)):
        raise TypeError(f"text must be a str or bytes, not {type(text).__name__}")
    if not isinstance(name, str):
        raise TypeError(f"name must be a str, not {type(name).__name__}")
    data = text.encode() if isinstance(text, str) else bytes(text)
    return Scene(_raylane.parse(data, name, on_remark))
