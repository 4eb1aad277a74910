"""Scenes that are read and built."""

import copy
import dataclasses
import pickle
import threading
import typing
import warnings

import numpy as np
import pytest
import raylane
from raylane import InvalidValue, SceneBuilder, Solid, Tracer


def test_what_is_set_is_there():
    builder = SceneBuilder()
    glass = raylane.Material(
        color=(0.5, 0.25, 1.0),
        ambient=0.5,
        diffuse=0.25,
        specular=0.75,
        exponent=8.0,
        reflection="dielectric",
        reflectivity=0.125,
        transmission=1.0,
        index=1.25,
        glass=raylane.Sellmeier(B=(1.0, 0.25, 1.0), C=(0.0078125, 0.015625, 100.0)),
        absorption=(0.5, 0.0, 2.0),
        visible="both",
        opacity=1.0,
    )
    checker = raylane.Material(
        color=raylane.Pattern("checker", ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)), size=2.0, axes="yz", upper_edges="z")
    )
    stripes = raylane.Material(color=raylane.Pattern("stripes", direction=(0.0, 1.0, 0.0)), visible="inside")
    gradient = raylane.Material(color=raylane.Pattern("gradient", start=(1.0, 2.0, 3.0), end=(4.0, 5.0, 6.0)))
    formula = raylane.Material(color=raylane.Pattern(formula=("abs(cos(x))", "v", "0.5")), highlight="phong")
    pixels = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
    globe = raylane.Material(
        color=raylane.Pattern(image=raylane.Texture(pixels), width=0.5, height=2.0, wrap="clamp", axis=(0.0, 0.0, 1.0))
    )
    grain = raylane.Material(color=raylane.Pattern(formula=("x", "y", "z"), space="object"))
    materials = [glass, checker, stripes, gradient, formula, globe, grain, raylane.Material(opacity=0.5)]
    for index, material in enumerate(materials):
        assert builder.add_material(material) == index
    lights = [
        raylane.Light(position=(1.0, 2.0, 3.0)),
        raylane.Light("directional", direction=(0.0, 0.0, 1.0), color=(0.5, 0.5, 0.5)),
        raylane.Light("sky", ground=(0.0, 0.5, 0.0), reach=4.0),
        raylane.Light("sphere", position=(9.0, 9.0, 9.0), radius=0.5),
        raylane.Light("rectangle", edge_u=(2.0, 0.0, 0.0), edge_v=(0.0, 2.0, 0.0), position=(5.0, 5.0, 5.0)),
    ]
    for light in lights:
        builder.add_light(light)
    builder.fog = raylane.Fog("exponential", (0.5, 0.5, 0.5), density=0.25)
    builder.camera = raylane.Camera("orthographic", (0.0, 1.0, 8.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), height=3.0)
    builder.background = (0.25, 0.5, 0.75)
    builder.settings = raylane.Settings(
        320, 200, 3, "stratified", 0.0, "gaussian", 4, "linear", True, 5, 0.5, 7, raylane.Outline(2.0, (1.0, 0.0, 0.0), 30.0),
        False,
    )
    ids = builder.add_spheres([0, 0, 0], 1, material=0)
    fog, camera, background, settings = builder.fog, builder.camera, builder.background, builder.settings
    scene = builder.build()
    assert list(ids) == [0]
    glass.index = scene.material(0).index  # the formula's
    assert scene.materials == materials
    assert scene.lights == lights
    assert (scene.fog, scene.camera, scene.background, scene.settings) == (fog, camera, background, settings)
    # The builder is new.
    assert len(builder) == 0 and builder.camera is None


def luminous(image, **fields):
    return raylane.Material(color=raylane.Pattern(image=image, **fields), ambient=1.0, diffuse=0.0)


def color_on_wall(material):
    """Returns the colour in the middle of the image on a wall, 1 wide and 1 high."""
    builder = raylane.SceneBuilder()
    builder.add_planes((0, 0, 0), (0, 0, 1), material=builder.add_material(material))
    builder.add_light(position=(0, 0, 9))
    builder.camera = raylane.Camera(position=(0.5, 0.5, 5), at=(0.5, 0.5, 0))
    return builder.build().render(width=1, height=1).rgb[0, 0]


def test_images_on_surfaces(tmp_path):
    codes = np.array([[[0, 128, 255], [0, 128, 255]]] * 2, np.uint8)
    linear = ((128 / 255 + 0.055) / 1.055) ** 2.4
    assert color_on_wall(luminous(codes)) == pytest.approx([0.0, linear, 1.0], rel=1e-6)
    floats = np.array([[[0.25, 0.5, 4.0], [0.75, 0.5, 4.0]]] * 2)
    for image in (floats, floats.astype(np.float32), floats[::-1], np.asfortranarray(floats)):
        assert color_on_wall(luminous(image)) == pytest.approx([0.5, 0.5, 4.0])
    texture = raylane.Texture(floats)
    assert texture.shape == (2, 2, 3) and repr(texture) == "<raylane.Texture: 2 x 2>"
    assert (texture.pixels() == floats).all() and texture == raylane.Texture(floats)
    assert texture != raylane.Texture(codes)

    path = tmp_path / "wall.png"
    builder = raylane.SceneBuilder()
    builder.background = (0.0, linear, 1.0)
    builder.camera = raylane.Camera(position=(0, 0, 5))
    builder.build().render(width=3, height=2).save(path)
    for image in (path, str(path), raylane.Texture(path)):
        assert color_on_wall(luminous(image)) == pytest.approx([0.0, linear, 1.0], rel=1e-6)
    with pytest.raises(raylane.BadInput, match="none.png"):
        color_on_wall(luminous(tmp_path / "none.png"))
    for image in (np.zeros((2, 2)), np.zeros((2, 2, 4)), np.zeros((2, 2, 3), np.int64), -floats, np.zeros((0, 2, 3)), 3):
        with pytest.raises(raylane.InvalidValue) as caught:
            color_on_wall(luminous(image))
        assert caught.value.field == "color/image"
    with pytest.raises(raylane.InvalidValue, match="color/image: must be an image, got none"):
        color_on_wall(raylane.Material(color=raylane.Pattern("image")))


def test_faces_of_cuts_have_the_colours_of_the_parts():
    def color_of_face(pattern):
        builder = raylane.SceneBuilder()
        red = builder.add_material(raylane.Material(color=(1, 0, 0), ambient=1, diffuse=0))
        face = builder.add_material(raylane.Material(color=pattern, ambient=1, diffuse=0))
        ball = raylane.Solid.sphere((0, 0, 0), 1, material=red)
        builder.add_solid(ball & raylane.Solid.half_space((0, 0, 0.5), (0, 0, 1), material=face))
        builder.add_light(position=(0, 0, 9))
        builder.camera = raylane.Camera(position=(0, 0, 5))
        return builder.build().render(width=1, height=1).rgb[0, 0]

    assert color_of_face((0, 0, 1)) == pytest.approx([0, 0, 1])
    assert color_of_face(raylane.Pattern("cutaway")) == pytest.approx([1, 0, 0])


def test_patterns_follow_groups_and_copies():
    def image(add):
        builder = raylane.SceneBuilder()
        material = builder.add_material(luminous(np.arange(48, dtype=np.uint8).reshape(2, 8, 3) * 5))
        group = raylane.Group()
        group.add_spheres((0, 0, 0), 1, material=material)
        add(builder, group)
        builder.add_light(position=(0, 0, 9))
        builder.camera = raylane.Camera(position=(0, 0, 5))
        return builder.build().render(width=20, height=20).rgb

    turn = raylane.Transform().rotated((0, 90, 0))
    plain = image(lambda builder, group: builder.add_group(group))
    turned = image(lambda builder, group: builder.add_group(group.transformed(turn)))
    copied = image(lambda builder, group: builder.add_copies(group, (0, 0, 0), rotate=(0, 90, 0)))
    assert (turned == copied).all() and (turned != plain).any()


def test_classes_have_the_defaults_and_words_of_files():
    text = """{"camera": {"from": [0, 0, 5], "at": [0, 0, 0]}, "materials": {"m": {}}, "objects": [],
        "lights": [{"type": "point", "position": [0, 0, 9]}]}"""
    scene = raylane.parse(text, "a.json", lambda remark: None)
    assert scene.materials == [raylane.Material()]
    assert scene.lights == [raylane.Light(position=(0.0, 0.0, 9.0))]
    assert (scene.fog, scene.camera, scene.settings) == (raylane.Fog(), raylane.Camera(), raylane.Settings())
    checks = 0
    for kind in (raylane.Material, raylane.Pattern, raylane.Light, raylane.Fog, raylane.Camera, raylane.Settings):
        for name, hint in typing.get_type_hints(kind).items():
            if typing.get_origin(hint) is not typing.Literal:
                continue
            wrong, builder = kind(**{name: "?"}), SceneBuilder()
            with pytest.raises(InvalidValue) as error:
                if kind is raylane.Light:
                    builder.add_light(wrong)
                elif kind in (raylane.Material, raylane.Pattern):
                    builder.add_material(wrong if kind is raylane.Material else raylane.Material(color=wrong))
                else:
                    setattr(builder, kind.__name__.lower(), wrong)
                    builder.build()
            words = ", ".join(f'"{word}"' for word in typing.get_args(hint))
            assert error.value.expectation == f"must be one of {words}, got '?'"
            checks += 1
    assert checks == 12


def test_arrays_of_all_kinds(random):
    """Arrays of any shape, stride and type give the same scene as shapes that are added one by one."""
    n = 20
    axes = random.normal(size=(n, 3, 3))
    points, vectors, radii = random.normal(size=(n, 3)), random.normal(size=(n, 3)), random.uniform(0.1, 1, n)
    coefficients = np.tile([1.0, 1, 1, 0, 0, 0, 0, 0, 0, -1], (n, 1))
    adds = [
        ("add_spheres", (points, radii), {}),
        ("add_ellipsoids", (points, axes), {}),
        ("add_planes", (points, vectors), {}),
        ("add_discs", (points, vectors, radii), {}),
        ("add_triangles", (axes,), {}),
        ("add_boxes", (points, axes), {}),
        ("add_cylinders", (points, vectors, radii), {}),
        ("add_cylinders", (points, vectors, radii), {"caps": False}),
        ("add_cones", (points, vectors, radii, 2 * radii), {}),
        ("add_cones", (points, vectors, radii), {"caps": False}),
        ("add_quadrics", (points, coefficients, -np.ones(3), np.ones(3)), {}),
    ]
    for dtype in (np.float32, np.float64):
        for order in (lambda a: a, np.asfortranarray, lambda a: np.repeat(a, 2, axis=0)[::2], lambda a: a[::-1].copy()[::-1]):
            whole, single = SceneBuilder(), SceneBuilder()
            for builder in (whole, single):
                builder.add_material()
                builder.add_material(color=(1, 0, 0))
            materials = np.arange(n) % 2
            for name, arrays, options in adds:
                arrays = [order(np.asarray(a, dtype)) if np.ndim(a) and len(a) == n else np.asarray(a, dtype) for a in arrays]
                before = len(whole)
                assert getattr(whole, name)(*arrays, material=materials, **options) == range(before, before + n)
                for i in range(n):
                    rows = [a[i] if a.ndim and len(a) == n else a for a in arrays]
                    getattr(single, name)(*rows, material=int(materials[i]), **options)
            scenes = [whole.build(), single.build()]
            assert scenes[0].shape_count == n * len(adds)
            assert scenes[0].bounds == scenes[1].bounds
            ids = np.arange(n * len(adds))
            assert np.array_equal(scenes[0].material_of(ids), np.tile(materials, len(adds)))
            assert scenes[0].material_of(3) == 1
            origins, directions = random.normal(size=(500, 3)) * 3, random.normal(size=(500, 3))
            hits = [Tracer(scene).intersect(origins, directions) for scene in scenes]
            assert np.array_equal(hits[0].t, hits[1].t) and np.array_equal(hits[0].shape_id, hits[1].shape_id)
            assert hits[0].hit.sum() > 100


def test_doubles_count_as_they_are():
    """A sphere in double is not rounded to floats."""
    for radius, found in ((np.float64(1.0 + 1e-12), True), (np.float64(1.0 - 1e-12), False)):
        builder = SceneBuilder()
        builder.add_material()
        builder.add_spheres(np.zeros((1, 3)), radius, material=0)
        assert Tracer(builder.build()).occluded([[1.0, 0, 5]], [0, 0, -1.0])[0] == found


def test_a_polygon_and_smooth_triangles():
    corners = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]], np.float32)
    builder = SceneBuilder()
    material = builder.add_material()
    assert builder.add_polygon(corners, material=material) == range(0, 2)
    assert builder.add_triangles(corners + 2, normals=np.ones_like(corners), material=material) == range(2, 4)
    tracer = Tracer(builder.build())
    crossings = tracer.crossings([[0.5, 0.5, 1], [2.5, 2.5, 3]], [0, 0, -1])
    assert crossings.counts().tolist() == [1, 2]  # where triangles of a polygon meet, one of them counts


def test_solids():
    bowl = Solid.sphere((0, 0, 0), 1) - Solid.sphere((0, 0, 0), 0.5) - Solid.half_space((0, 0, 0), (0, -1, 0))
    bowl = bowl | Solid.box((5, 0, 0), np.eye(3)) & Solid.cylinder((5, 0, 0), (0, 1, 0), 1)
    bowl = bowl | Solid.cone((0, -9, 0), (0, 1, 0), 1) | Solid.ellipsoid((0, 9, 0), np.eye(3)).of(1)
    bowl = bowl | Solid.lens((0, 20, 0), (0, 0, 1), (10, -10), 0.5, 1)
    builder = SceneBuilder()
    builder.add_material()
    builder.add_material()
    parts = builder.add_solid(bowl, material=0)
    scene = builder.build()
    assert len(parts) == 10 and set(scene.solid_of(np.arange(10)).tolist()) == {0}
    inside = Tracer(scene).contains([[0, -0.75, 0], [0, 0.75, 0], [0, 0, 0], [5.5, 0.5, 0.5], [0, 20, 0.25], [0, 9, 0]])
    assert inside.counts().tolist() == [1, 0, 0, 1, 1, 1]
    builder.add_material()
    builder.add_solid(Solid.sphere((0, 0, 0), 1).clipped(Solid.half_space((0, 0, 0), (0, 1, 0))), material=0)
    open_ = Tracer(builder.build())
    assert open_.crossings([0, 5, 0], [0, -1, 0]).t.tolist() == [6.0]


def test_what_is_not_valid_says_where():
    builder = SceneBuilder()
    material = builder.add_material()
    bad_normals = np.ones((2, 3, 3))
    bad_normals[1, 1] = 0
    checker = raylane.Pattern("checker", colors=[(0, 0, 0), (0, -1, 0)])
    for call, field in (
        (lambda: builder.add_spheres([[0, 0, 0], [1, 1, 1]], [1, -1], material=material), "1/radius"),
        (lambda: builder.add_spheres([[0, 0, 0]], 1, material=7), "0/material"),
        (lambda: builder.add_spheres([[0, 0, 0]], 1, material=-1), "material"),
        (lambda: builder.add_spheres([[0, 0, 0]], 1, material=0.5), "material"),
        (lambda: builder.add_spheres([[0, 0, 0]], 1, material="red"), "material"),
        (lambda: builder.add_spheres([[0, 0]], 1, material=material), "centers"),
        (lambda: builder.add_spheres("abc", 1, material=material), "centers"),
        (lambda: builder.add_spheres(np.zeros((4, 3)), [1, 2], material=material), "radii"),
        (lambda: builder.add_boxes(np.zeros((4, 3)), np.zeros((4, 9)), material=material), "edges"),
        (lambda: builder.add_material(reflection="hm"), "reflection"),
        (lambda: builder.add_material(color=(1, 2)), "color"),
        (lambda: builder.add_material(color=raylane.Pattern(axes="xw")), "color/axes"),
        (lambda: builder.add_material(diffuse="much"), "diffuse"),
        (lambda: builder.add_material(diffuse=-1), "diffuse"),
        (lambda: builder.add_light(kind="torch"), "kind"),
        (lambda: builder.add_material("red"), "color"),
        (lambda: Solid.sphere((0, 0), 1), "center"),
        (lambda: Solid.sphere((0, 0, 0), "wide"), "radius"),
        (lambda: Solid.lens((0, 0, 0), (0, 0, 1), (1, 2, 3), 1, 1), "radii"),
        (lambda: Solid.sphere((0, 0, 0), 1, material=-1), "material"),
        (lambda: builder.add_solid(Solid.sphere((0, 0, 0), 1), material=2**32), "material"),
        (lambda: builder.add_material(color=raylane.Pattern(colors=3)), "color/colors"),
        (lambda: builder.add_material(color=(0, 0, -1)), "color/2"),
        (lambda: builder.add_material(color=checker), "color/colors/1/1"),
        (lambda: builder.add_material(color=raylane.Pattern("gradient", start=(1, 2, 3), end=(1, 2, 3))), "color/end"),
        (lambda: builder.add_material(color=raylane.Pattern("gradient", start=(0, np.nan, 0))), "color/start/1"),
        (lambda: builder.add_material(color=raylane.Pattern("formula", formula=("x", "y +", "0"))), "color/formula/1"),
        (lambda: builder.add_material(color=raylane.Pattern("formula")), "color/formula"),
        (lambda: builder.add_material(color=raylane.Pattern("formula", formula=("x", "y"))), "color/formula"),
        (lambda: builder.add_material(color=raylane.Pattern(formula="xyz")), "color/formula"),
        (lambda: builder.add_spheres([[None, 0, 0]], 1, material=material), "centers"),
        (lambda: builder.add_spheres([[0, 0, 0], [1]], 1, material=material), "centers"),
        (lambda: builder.add_spheres(np.zeros((4, 3)), 1, material=[0, 0, 0]), "material"),
        (lambda: builder.add_polygon(np.zeros((1, 3, 3)), material=-1), "material"),
        (lambda: builder.add_polygon(np.stack([np.eye(3), np.eye(3)]), normals=bad_normals, material=0), "1/normals/1"),
        (lambda: builder.add_spheres([[0, 0, 0]], 1, material=np.uint64(2**64 - 1)), "material"),
        (lambda: builder.add_cylinders([0, 0, 0], [0, 0, 1], 1, material=material, caps="no"), "caps"),
        (lambda: builder.add_cones([0, 0, 0], [0, 0, 1], 1, material=material, caps=[]), "caps"),
        (lambda: builder.add_material(color=raylane.Pattern(kind=None)), "color/kind"),
        (lambda: Solid.sphere((0, 0, 0), 1).of(2**32 - 1), "material"),  # which means no material
        (lambda: Solid.sphere((0, 0, 0), 1, material=2**32 - 1), "material"),
        (lambda: builder.add_spheres([0, 0, 0], 1, material=np.uint32(2**32 - 1)), "material"),
    ):
        with pytest.raises(ValueError) as error:
            call()
        assert isinstance(error.value, InvalidValue) and error.value.field == field, str(error.value)
        assert error.value.expectation and str(error.value) == f"{field}: {error.value.expectation}"
    with pytest.raises(InvalidValue, match=f"got {2**64 - 1}"):
        builder.add_spheres([[0, 0, 0]], 1, material=np.uint64(2**64 - 1))
    for call in (
        lambda: builder.add_material(colour=(1, 0, 0)),
        lambda: builder.add_material(raylane.Material(), color=(1, 0, 0)),
        lambda: builder.add_spheres([0, 0, 0], material=0),
    ):
        with pytest.raises(TypeError):
            call()
    again = pickle.loads(pickle.dumps(InvalidValue("a", "must be")))
    assert (again.field, again.expectation) == ("a", "must be")


def test_masked_values_are_refused():
    """Masked entries have no values, but NumPy's C interface passes them on as if they had."""
    from numpy import ma

    def masked(shape, dtype=np.float64):
        array = ma.ones(shape, dtype)
        array[(0,) * len(array.shape)] = ma.masked
        return array

    def refused(field, call, *arguments, **named):
        with pytest.raises(InvalidValue, match=f"^{field}: must have no masked values"):
            call(*arguments, **named)

    builder = raylane.SceneBuilder()
    red = builder.add_material()
    for dtype in (np.float32, np.float64, np.int32):
        refused("centers", builder.add_spheres, masked((2, 3), dtype), 1, material=red)
        refused("radii", builder.add_spheres, np.ones((2, 3)), masked(2, dtype), material=red)
    refused("material", builder.add_spheres, np.ones((2, 3)), 1, material=masked(2, np.uint32))
    refused("centers", builder.add_spheres, [masked(3), masked(3)], 1, material=red)
    refused("radii", builder.add_spheres, np.ones((2, 3)), [1, ma.masked], material=red)
    refused("position", builder.add_light, position=masked(3))
    refused("point", raylane.Solid.half_space, masked(3), (0, 1, 0), material=red)
    refused("lower", builder.add_aligned_boxes, [masked(3), masked(3)], (2, 2, 2), material=red)
    refused("upper", raylane.Solid.aligned_box, (0, 0, 0), masked(3), material=red)
    # Masked arrays without masked entries, which netCDF4 returns, are accepted like other arrays.
    builder.add_spheres(ma.array(np.arange(6.0).reshape(2, 3), mask=False), ma.ones(2), material=red)
    builder.add_light(position=(0, 0, 9))
    scene = builder.build()
    assert scene.shape_count == 2
    refused("shapes", scene.material_of, masked(2, np.uint32))
    tracer = raylane.Tracer(scene)
    ones = np.ones((2, 3))
    refused("origins", tracer.intersect, masked((2, 3)), ones)
    refused("directions", tracer.occluded, ones, masked((2, 3)))
    refused("t_max", tracer.crossings, ones, ones, t_max=masked(2))
    refused("points", tracer.contains, masked((2, 3)))
    refused("positions", raylane.from_atoms, ["C", "O"], masked((2, 3)))
    refused("cell", raylane.from_atoms, ["C"], np.ones((1, 3)), cell=masked((3, 3)))
    image = raylane.render(scene, width=2, height=2)
    image.rgb = masked((2, 2, 3), np.float32)
    refused("rgb", image.save, "never.pfm")


def test_what_is_set_and_not_valid_says_where_and_the_builder_keeps_what_it_has():
    builder = SceneBuilder()
    material = builder.add_material()
    builder.add_light(kind="directional")
    builder.add_spheres(np.arange(6.0).reshape(2, 3), 1, material=material)
    for name, value, text in (
        ("camera", raylane.Camera(field_of_view=0), "camera/field_of_view: must be"),
        ("camera", raylane.Camera(field_of_view="0"), "camera/field_of_view: must be a number, got '0'"),
        ("camera", raylane.Camera(position=(np.nan, 0, 0)), "camera/position/0: must be a number"),
        ("camera", raylane.Camera(position=(1, 2, 3), at=(1, 2, 3)), 'camera/at: must differ from "position"'),
        ("camera", 5, "camera: must be a Camera, got 5"),
        ("fog", None, "fog: must be a Fog, got None"),
        ("fog", raylane.Fog("smoke"), 'fog/kind: must be one of "none", "linear_z", "linear", "exponential", got \'smoke\''),
        ("fog", raylane.Fog(color=(1, 2)), "fog/color: must be three numbers, got (1, 2)"),
        ("background", (1, 2), "background: must be three numbers, got (1, 2)"),
        ("background", (1, 2, -1), "background/2: must"),
        ("background", np.zeros((99, 99)), "background: must be three numbers, got array([[0., 0., 0."),
        ("settings", None, "settings: must be a Settings, got None"),
        ("settings", raylane.Settings(height=0), "settings/height: must be from 1 to 65535, got 0"),
        ("settings", raylane.Settings(height="0"), "settings/height: must be a whole number, got '0'"),
        ("settings", raylane.Settings(grid=np.float32(1.5)), "settings/grid: must be a whole number, got"),
        ("settings", raylane.Settings(width=2**40), "settings/width: must be a whole number from -2147483648 to 2147483647, got 1099511627776"),
        ("settings", raylane.Settings(width=-(10**9000)), "settings/width: must be a whole number from -2147483648 to 2147483647, got a value of the type int"),
        ("wavelengths", 500, "wavelengths: must be a list of numbers, got 500"),
        ("wavelengths", "abc", "wavelengths: must be an array of numbers"),
        ("wavelengths", None, "wavelengths: must be an array of numbers"),
        ("wavelengths", [500, 800], "wavelengths/1: must be from 380 to 780, got 800"),
    ):
        before = getattr(builder, name)
        setattr(builder, name, value)
        with pytest.raises(InvalidValue) as error:
            builder.build()
        assert str(error.value).startswith(text) and len(str(error.value)) < 200
        assert getattr(builder, name) is value and len(builder) == 2
        setattr(builder, name, before)
    builder.settings.width = np.int64(40)
    builder.wavelengths = np.array([500, 600])
    scene = builder.build()
    assert (scene.shape_count, scene.settings.width, len(scene.lights)) == (2, 40, 1)
    # An error that only the whole scene shows empties the builder.
    builder.add_spheres([0, 0, 0], 1, material=builder.add_material())
    builder.add_light(position=(0, 0, 1))
    with pytest.raises(InvalidValue, match="lights/0/position"):
        builder.build()
    assert len(builder) == 0


def test_misspelled_attributes_are_refused():
    for thing, name, meant in (
        (SceneBuilder(), "backgroud", "background"),
        (SceneBuilder().settings, "widht", "width"),
        (raylane.Outline(), "widths", "width"),
        (raylane.Material(), "colour", "color"),
        (raylane.Pattern(), "colours", "colors"),
        (raylane.Sellmeier(), "b", None),
        (raylane.Light(), "positon", "position"),
        (raylane.Fog(), "densty", "density"),
        (raylane.Camera(), "from", None),
        (raylane.Leaving(0, 0, 0), "inwards", "inward"),
        (raylane.Hits(1), "tdouble", "t_double"),
        (raylane.Image(np.zeros((1, 1, 3))), "alhpa", "alpha"),
    ):
        with pytest.raises(AttributeError) as error:
            setattr(thing, name, 1)
        suggested = f', did you mean "{meant}"?' if meant else ""
        assert str(error.value) == f'{type(thing).__name__} has no attribute "{name}"{suggested}'
        assert not hasattr(thing, name)

    class Mine(raylane.Camera):
        def __init__(self):
            super().__init__(position=(0, 0, 9))
            self.name = "mine"

    assert Mine().name == "mine" and Mine().position == (0, 0, 9)
    material = raylane.Material(color=raylane.Pattern("checker"), opacity=0.5)
    for again in (copy.copy(material), copy.deepcopy(material), pickle.loads(pickle.dumps(material))):
        assert again == material
        again.index = 1.25
        assert again != material and dataclasses.replace(again, index=1.5) == material


def test_scenes_too_large_for_a_camera():
    for radius in (2e29, 3e29, 1e30):
        builder = SceneBuilder()
        builder.add_spheres([0, 0, 0], radius, material=builder.add_material())
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            scene = builder.build()
        assert Tracer(scene).intersect([0, 0, 0], [0, 0, 1]).t == radius
        if radius < 2.5e29:
            assert not caught and scene.camera == scene.camera_on_all()
            continue
        assert len(caught) == 1 and str(caught[0].message).startswith("scene: is too large") and caught[0].filename == __file__
        assert scene.camera == raylane.Camera()
        with pytest.raises(InvalidValue, match="is too large for an automatic camera") as error:
            scene.camera_on_all()
        assert error.value.field == "scene"
        # A given camera causes no warning.
        camera = raylane.Camera(position=(0, 0, 9e29), field_of_view=60)
        builder.add_spheres([0, 0, 0], radius, material=builder.add_material())
        builder.camera = camera
        assert builder.build().camera == scene.seen_by(camera).camera == camera


def test_types_that_are_none_of_its_own():
    for call in (
        lambda: raylane.parse(5),
        lambda: raylane.parse("{}", None),
        lambda: Solid.sphere((0, 0, 0), 1) | 5,
        lambda: Solid.sphere((0, 0, 0), 1) & 5,
        lambda: Solid.sphere((0, 0, 0), 1) - 5,
        lambda: Solid.sphere((0, 0, 0), 1).clipped(5),
        lambda: SceneBuilder().add_solid(5, material=0),
        lambda: Tracer(5),
        lambda: Tracer(SceneBuilder().build()).intersect([0, 0, 5], [0, 0, 1], leaving=5),
        lambda: Tracer(SceneBuilder().build()).intersect([0, 0, 5], [0, 0, 1], out=5),
        lambda: raylane.render(5),
    ):
        with pytest.raises(TypeError) as error:
            call()
        assert "_raylane" not in str(error.value) and "arg0" not in str(error.value)
    assert raylane.parse(bytearray(b"1\n\nC 0 0 0\n"), "a.xyz").shape_count == 1


def test_files(scenes, tmp_path):
    scene = raylane.load(scenes / "birthday.json")
    text = (scenes / "birthday.json").read_text()
    for other in (raylane.load(str(scenes / "birthday.json")), raylane.parse(text), raylane.parse(text.encode(), "a.json")):
        assert other.shape_count == scene.shape_count and other.camera == scene.camera
    with pytest.raises(raylane.BadInput) as error:
        raylane.parse('{"camera": "auto",\n "objects": 3}', "a.json")
    assert isinstance(error.value, ValueError) and len(error.value.errors) >= 1
    first = error.value.errors[0]
    assert first.file == "a.json" and first.line >= 1 and first.message and first.place == "/objects"
    assert str(error.value).startswith("a.json:")
    assert pickle.loads(pickle.dumps(error.value)).errors == error.value.errors
    with pytest.raises(ValueError):
        raylane.load(tmp_path / "not there.json")
    (tmp_path / "a.xyz").write_text("2\n\nC 0 0 0\nO 0 0 1.2\n")
    assert raylane.load(tmp_path / "a.xyz").shape_count >= 2


@pytest.mark.parametrize("name", ["birthday", "lens", "protein", "cutaway", "many"])
def test_saved_and_pickled(scenes, tmp_path, name):
    if name == "many":
        builder = SceneBuilder()
        red = builder.add_material(raylane.Material(color=(1, 0, 0)))
        builder.add_spheres(np.random.default_rng(1).uniform(-9, 9, (10_000, 3)), 0.25, material=red)
        scene = builder.build()
    else:
        scene = raylane.load(scenes / f"{name}.json")
    camera = np.array(scene.camera.position)
    towards = np.array(scene.camera.at) - camera + np.random.default_rng(2).normal(size=(2000, 3)) * np.linalg.norm(camera) / 9
    expected = Tracer(scene).intersect(camera, towards, double=True)
    assert copy.copy(scene) is scene and copy.deepcopy(scene) is scene
    again = [pickle.loads(pickle.dumps(scene))]
    for ending in ("json", "rl"):
        path = tmp_path / f"a.{ending}"
        try:
            scene.save(path)
        except raylane.BadInput as error:
            assert ending == "rl" and name in ("lens", "cutaway") and "solids" in str(error) and not path.exists()
            continue
        again.append(raylane.load(path))
    assert len(again) == (2 if name in ("lens", "cutaway") else 3)
    for other in again:
        hits = Tracer(other).intersect(camera, towards, double=True)
        assert np.array_equal(hits.t, expected.t) and np.array_equal(hits.shape_id, expected.shape_id)
        assert other.camera == scene.camera and other.settings == scene.settings and other.material(0) == scene.material(0)


def test_light_goes_with_the_camera(tmp_path):
    """This holds in a scene of atoms, whether it was read, saved or pickled."""
    scene = raylane.from_atoms(["O", "H", "H"], [[0, 0, 0.1], [0, 0.77, -0.46], [0, -0.77, -0.46]])
    path = tmp_path / "a.JSON"  # in upper or lower case
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene.save(path)
        again = [raylane.load(path), pickle.loads(pickle.dumps(scene))]
        seen = scene.seen_by(scene.camera_on_all((0, -1, 0)))
        again_seen = [pickle.loads(pickle.dumps(seen))]
    size = {"width": 40, "height": 30, "quality": 0}
    camera = scene.camera_on_all((-1, 0.5, 0))
    for other in again:
        assert other.lights == scene.lights
        assert np.array_equal(other.render(camera=camera, **size).rgb, scene.render(camera=camera, **size).rgb)
    for other in again_seen:
        assert other.lights == seen.lights
        assert np.array_equal(other.render(**size).rgb, seen.render(**size).rgb)
    with pytest.warns(UserWarning, match="automatic fog"):
        seen.save(path)
    other = raylane.load(path)
    assert other.lights == seen.lights and other.fog == seen.fog
    assert np.array_equal(other.render(**size).rgb, seen.render(**size).rgb)


def test_pickles_say_what_they_lose():
    corners = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]], np.float32)
    builder = SceneBuilder()
    builder.add_polygon(corners, material=builder.add_material())
    builder.add_solid(Solid.sphere((5, 0, 0), 1) - Solid.sphere((5, 0, 1), 0.5), material=0)
    with pytest.warns(UserWarning, match="polygons made of triangles"):
        assert pickle.loads(pickle.dumps(builder.build())).shape_count == 4
    solid = Solid.sphere((0, 0, 0), 1)
    for i in range(150):
        solid = (solid - Solid.sphere((1, 0.001 * i, 0), 0.25)) | Solid.sphere((-1, 0.001 * i, 0), 0.25)
    builder.add_material()
    builder.add_solid(solid, material=0)
    with pytest.raises(raylane.BadInput, match="more than 256 levels"):
        pickle.dumps(builder.build())


def test_threads_in_the_environment(scenes, monkeypatch):
    scene = raylane.load(scenes / "sphere.json")
    monkeypatch.setenv("RAYLANE_THREADS", "abc")
    for act in (
        lambda: raylane.load(scenes / "sphere.json"),
        lambda: SceneBuilder().build(),
        lambda: raylane.render(scene, width=8, height=8),
        lambda: Tracer(scene),
    ):
        with pytest.raises(InvalidValue) as error:
            act()
        assert error.value.field == "RAYLANE_THREADS"


def test_saved_for_others(scenes, tmp_path):
    with pytest.warns(UserWarning, match="differs from the scene"):
        raylane.load(scenes / "glass-block.json").save(tmp_path / "a.nff")
    with pytest.raises(raylane.BadInput, match="must end in"):
        raylane.load(scenes / "sphere.json").save(tmp_path / "a.obj")
    with pytest.raises(raylane.SystemRefused):
        raylane.load(scenes / "sphere.json").save(tmp_path / "none" / "a.json")


def test_remarks(tmp_path):
    text = 'camera { location <0, 0, -5> look_at 0 }\nsphere { 0, 1 pigment { rgb 1 } finish { brilliance 2 } }\nlight_source { <1, 2, -3> rgb 1 }\n'
    told = []
    raylane.parse(text, "a.pov", told.append)
    assert told and all(isinstance(each, str) for each in told)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        raylane.parse(text, "a.pov")
    assert [str(each.message) for each in caught] == told

    def refuse(_):
        raise KeyError("no")

    with pytest.raises(KeyError):
        raylane.parse(text, "a.pov", refuse)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_spheres_move(random, dtype):
    def built(centers):
        builder = SceneBuilder()
        material = builder.add_material()
        builder.add_planes([0, 0, -9], [0, 0, 1], material=material)
        builder.add_spheres(centers, dtype(0.3), material=material)
        builder.add_solid(Solid.sphere((0, 0, 0), 0.5), material=material)
        return builder.build()

    before = random.normal(size=(300, 3)).astype(dtype)
    after = before + random.normal(scale=0.2, size=before.shape).astype(dtype)
    directions = random.normal(size=(2000, 3))
    truth = Tracer(built(after)).intersect([0, 0, 5], directions)
    for positions in (after, np.asfortranarray(after), np.repeat(after, 2, axis=0)[::2], after.tolist()):
        if dtype == np.float32 and isinstance(positions, list):
            continue
        hits = Tracer(built(before).with_positions(positions)).intersect([0, 0, 5], directions)
        assert np.array_equal(hits.t, truth.t) and np.array_equal(hits.shape_id, truth.shape_id)
    scene = built(before)
    wrong = after.copy()
    wrong[17, 2] = np.inf
    for positions, text in (
        (wrong, "positions/17/2: must be a number from -1e30 to 1e30, got inf"),
        (after[1:], "positions: must have one element for each of 300 spheres, got 299"),
        (after[:, :2], r"positions: must have the shape \(n, 3\), got \(300, 2\)"),
        (np.ma.masked_less(after, 0), "positions: must have no masked values"),
        ("a", "positions: must be an array of numbers"),
    ):
        with pytest.raises(InvalidValue, match=text):
            scene.with_positions(positions)


def test_one_row_is_for_all():
    builder = SceneBuilder()
    material = builder.add_material()
    assert builder.add_spheres([0, 0, 0], [1, 2, 3], material=material) == range(0, 3)
    assert builder.add_cylinders([0, 0, 0], np.eye(3), 0.5, material=material) == range(3, 6)
    assert builder.add_ellipsoids([0, 0, 0], np.eye(3), material=material) == range(6, 7)
    assert Tracer(builder.build()).crossings([0, 0, 5], [0, 0, -1]).shape_id[:3].tolist() == [2, 1, 0]


def test_one_builder_of_several_threads():
    """A builder is not meant for several threads, but must not crash."""
    builder = SceneBuilder()
    material = builder.add_material()
    places = np.random.default_rng(1).normal(size=(20_000, 3))
    threads = [threading.Thread(target=lambda: builder.add_spheres(places, 0.1, material=material)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert builder.build().shape_count == 80_000


def test_ids_that_are_none(ball):
    for shapes in (2, -1, 2**32, np.array([0, 2]), np.array([2**32]), np.array([0.5]), "a"):
        for call in (ball.material_of, ball.solid_of):
            with pytest.raises(InvalidValue) as error:
                call(shapes)
            assert error.value.field.split("/")[0] == "shapes"
    assert ball.material_of(np.array([[0, 1]])).tolist() == [[0, 1]] and ball.material_of(np.array([], int)).shape == (0,)
    for index in (-1, 2, 2**32, "a"):
        with pytest.raises(InvalidValue) as error:
            ball.material(index)
        assert error.value.field == "index"


def test_scenes_are_cheap_to_keep(ball):
    assert copy.copy(ball).shape_count == 2
    assert "2 shapes" in repr(ball)


def test_cameras(scenes):
    builder = SceneBuilder()
    material = builder.add_material()
    builder.add_spheres([[0, 0, 0], [4, 0, 0]], 0.5, material=material)
    builder.settings.alpha = True
    builder.settings.width, builder.settings.height = 60, 30
    scene = builder.build()
    seen = raylane.render(scene).alpha > 0
    assert seen.any(axis=0)[2:-2].mean() > 0.3 and not seen[:, 0].any() and not seen[0].any()
    assert scene.camera == scene.camera_on_all(aspect=2)
    above = scene.camera_on_all((0, -1, 0), 2)
    other = scene.seen_by(above)
    assert other.camera == above != scene.camera and other.shape_count == 2
    assert np.array_equal(raylane.render(scene, camera=above).rgb, raylane.render(other).rgb)
    builder.add_planes([0, 0, 0], [0, 1, 0], material=builder.add_material())
    assert builder.build().camera == raylane.Camera()
    for call, field in (
        (lambda: scene.seen_by(raylane.Camera(lens_radius=-1)), "camera/lens_radius"),
        (lambda: scene.camera_on_all((0, 0)), "direction"),
        (lambda: scene.camera_on_all(aspect=0), "aspect"),
        (lambda: scene.camera_on_all(aspect="1"), "aspect"),
        (lambda: SceneBuilder().build().camera_on_all(), "scene"),
        (lambda: scene.seen_by(raylane.Camera(lens_radius=None)), "camera/lens_radius"),
        (lambda: scene.seen_by(None), "camera"),
    ):
        with pytest.raises(InvalidValue) as error:
            call()
        assert error.value.field == field
    with pytest.raises(InvalidValue, match="aspect: must be from 0.00001 to 100000, got 0$"):
        scene.camera_on_all(aspect=0)
