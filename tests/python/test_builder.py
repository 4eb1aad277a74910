"""Scenes that a builder makes with the bits that files give."""

import functools
import json
import operator

import numpy as np
import pytest
import raylane
from raylane import NO_SHAPE, AutoCamera, Group, InvalidValue, Material, SceneBuilder, Sellmeier, Solid, Tracer, Transform

BASE = {
    "image": {"width": 24, "height": 18},
    "camera": {"from": [1, 2, 9], "at": [0, 0, 0]},
    "lights": [{"type": "point", "position": [5, 9, 7]}],
    "materials": {"m": {"color": "#cc4d33"}, "n": {"color": [0.1, 0.4, 0.9], "reflectivity": 0.25}},
    "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1.5, "material": "m"}],
}


def base_builder(keys=()):
    builder = SceneBuilder()
    builder.settings.width, builder.settings.height = 24, 18
    builder.camera = raylane.Camera(position=(1, 2, 9))
    if "lights" not in keys:
        builder.add_light(position=(5, 9, 7))
    if "materials" not in keys:
        builder.add_material(color="#cc4d33", name="m")
        builder.add_material(color=(0.1, 0.4, 0.9), reflectivity=0.25, name="n")
    if "objects" not in keys:
        builder.add_spheres((0, 0, 0), 1.5, material=0)
    return builder


def check_same(builder, keys):
    """The builder makes the scene of a file with these keys in place of those of the base."""
    built = builder.build()
    whole = {**BASE, **keys}
    whole["objects"] = whole.pop("objects")  # after the definitions
    read = raylane.parse(json.dumps(whole), "a.json")
    assert built.shape_count == read.shape_count
    for id in range(built.shape_count):
        assert repr(built.shape(id)) == repr(read.shape(id))
        assert built.solid_of(id) == read.solid_of(id)
    assert built.materials == read.materials and built.lights == read.lights
    assert built.camera == read.camera and built.fog == read.fog
    names = [[scene.material_name(i) for i in range(scene.material_count)] for scene in (built, read)]
    assert names[0] == names[1]
    assert np.array_equal(built.render().rgb, read.render().rgb)


def ball(x, y, radius):
    return {"type": "sphere", "center": [x, y, 0], "radius": radius}


def test_solids_and_transforms():
    matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -0.1, 0], [0, 0, 0, -0.3]]
    keys = {
        "objects": [
            {"type": "union", "material": "m", "objects": [ball(0, 0, 1), ball(1, 0, 0.8), ball(0, 1, 0.7)]},
            {
                "type": "intersection",
                "material": "n",
                "scale": [1, 1.2, 1],
                "rotate": [10, 20, 30],
                "translate": [-1, 0, 0.1],
                "objects": [
                    {"type": "quadric", "matrix": matrix},
                    {"type": "box", "min": [-1, -1, -1], "max": [1, 1, 1.1]},
                ],
            },
            {
                "type": "difference",
                "objects": [
                    {"type": "box", "min": [1, -2, 0], "max": [2, -1.2, 1], "material": "m"},
                    {"type": "cylinder", "base": [1.5, -1.5, 0], "axis": [0, 0, 1], "radius": 0.2, "capped": False,
                     "material": "n"},
                    {"type": "cone", "base": [1.8, -1.5, 0], "axis": [0, 0, 2], "base_radius": 0.2, "capped": False,
                     "transform": [[1, 0, 0, 0], [0, 1.1, 0, 0], [0, 0, 1, 0]], "material": "n"},
                ],
            },
        ]
    }
    builder = base_builder(keys)
    union = Solid.sphere((0, 0, 0), 1) | Solid.sphere((1, 0, 0), 0.8) | Solid.sphere((0, 1, 0), 0.7)
    assert builder.add_solid(union, material=0) == range(0, 3)
    form = Solid.quadric((0, 0, 0), [1, 1, -0.1, 0, 0, 0, 0, 0, 0, -0.3])
    transform = Transform().scaled((1, 1.2, 1)).rotated((10, 20, 30)).then(Transform().translated((-1, 0, 0.1)))
    box = Solid.aligned_box((-1, -1, -1), (1, 1, 1.1))
    builder.add_solid(Solid.intersection([form, box]).transformed(transform), material=1)
    cone = Solid.cone((1.8, -1.5, 0), (0, 0, 2), 0.2, caps=False, material=1)
    stretched = cone.transformed(Transform([[1, 0, 0, 0], [0, 1.1, 0, 0], [0, 0, 1, 0]]))
    hole = Solid.cylinder((1.5, -1.5, 0), (0, 0, 1), 0.2, caps=False, material=1)
    whole = Solid.aligned_box((1, -2, 0), (2, -1.2, 1), material=0)
    builder.add_solid(Solid.difference(whole, [hole, stretched]))  # all parts have materials
    check_same(builder, keys)


def test_groups_and_instances():
    keys = {
        "definitions": {"pair": {"type": "group", "objects": [ball(0, 0, 0.4), ball(0.5, 0, 0.3)]}},
        "objects": [
            {"type": "instance", "of": "pair", "material": "m"},
            {"type": "instance", "of": "pair", "material": "n", "placements": [
                {"scale": 0.5, "rotate": [0, 0, 30], "translate": [2, 2, 0]},
                {"scale": 0.5, "rotate": [90, 0, 30], "translate": [-2, 2, 0]}]},
            {
                "type": "group",
                "material": "n",
                "rotate": [0, 0, 45],
                "objects": [
                    {"type": "instance", "of": "pair", "translate": [-1, -1, 0]},
                    {"type": "disc", "center": [0, -2, 0], "normal": [0, 1, 1], "radius": 1, "material": "m"},
                    {"type": "union", "objects": [ball(2, 1, 0.4)]},
                ],
            },
            {"type": "intersection", "material": "m", "objects": [
                {"type": "instance", "of": "pair", "translate": [-1, 1, 0]},
                {"type": "plane", "point": [0, 1, 0], "normal": [0, 1, 0]}]},
        ],
    }
    builder = base_builder(keys)
    pair = Group()
    assert pair.add_spheres([(0, 0, 0), (0.5, 0, 0)], [0.4, 0.3]) == range(0, 2)
    assert builder.add_group(pair, material=0) == range(0, 2)
    turns = [(0, 0, 30), (90, 0, 30)]
    assert builder.add_copies(pair, [(2, 2, 0), (-2, 2, 0)], rotate=turns, scale=0.5, material=1) == range(2, 6)
    group = Group()
    assert group.add_group(pair.transformed(Transform().translated((-1, -1, 0)))) == range(0, 2)
    group.add_discs((0, -2, 0), (0, 1, 1), 1, material=0)
    assert group.add_solid(Solid.sphere((2, 1, 0), 0.4)) == range(3, 4)
    assert len(group) == 4
    assert builder.add_group(group.of(1).transformed(Transform().rotated((0, 0, 45)))) == range(6, 10)
    cut = pair.solid().transformed(Transform().translated((-1, 1, 0))) & Solid.half_space((0, 1, 0), (0, 1, 0))
    builder.add_solid(cut, material=0)
    check_same(builder, keys)


@pytest.mark.parametrize("keep_from", [1, 2**22])
def test_copies_are_kept_from_a_number_of_shapes_on(keep_from):
    builder = SceneBuilder(keep_from=keep_from)
    pair = Group()
    pair.add_spheres([(-1, 0, 0), (1, 0, 0)], 0.5)
    assert builder.add_copies(pair, [(0, 0, 0), (0, 3, 0)]) == range(0, 4)
    builder.keep_from = 2**22  # of later calls
    assert builder.add_copies(pair, (0, -3, 0)) == range(4, 6)
    tracer = Tracer(builder.build())
    assert tracer.intersect([[1, 3, 5], [-1, -3, 5], [9, 9, 9]], [0, 0, -1]).shape_id.tolist() == [3, 4, NO_SHAPE]
    if keep_from == 1:
        with pytest.raises(InvalidValue, match="scene: must not keep copies of groups for closest points"):
            tracer.closest([0, 0, 0])
    else:
        assert tracer.closest([0, 0, 0]).shape_id == 0
    for wrong in (-1, 2**64, 1.5):
        with pytest.raises(InvalidValue, match="keep_from"):
            SceneBuilder(keep_from=wrong).add_copies(pair, (0, 0, 0))


def test_generators():
    keys = {
        "objects": [
            {"type": "sphereflake", "center": [0.1, 0, 0], "radius": 0.7, "depth": 2, "up": [0, 1, 0.3], "material": "m"},
            {"type": "lattice", "center": [1, 1, 0.1], "n": 3, "spacing": 0.5, "sphere_radius": 0.2, "strut_radius": 0.1,
             "material": "m", "strut_material": "n"},
            {"type": "lattice", "corner": [-2, 1, 0], "n": 2, "spacing": 0.5, "sphere_radius": 0.2, "strut_radius": 0.1,
             "material": "n"},
        ]
    }
    builder = base_builder(keys)
    assert builder.add_sphereflake((0.1, 0, 0), 0.7, 2, (0, 1, 0.3), material=0) == range(0, 91)
    center = np.float32([1, 1, 0.1])  # files round the numbers of generators
    added = builder.add_lattice(3, 0.5, 0.2, 0.1, center=center, material=0, strut_material=1)
    assert added == range(91, 91 + 27 + 54)
    builder.add_lattice(2, 0.5, 0.2, 0.1, corner=(-2, 1, 0), material=1)
    check_same(builder, keys)
    with pytest.raises(InvalidValue, match="corner: must be given, or center, but not both"):
        SceneBuilder().add_lattice(2, 0.5, 0.2, 0.1)
    with pytest.raises(InvalidValue, match="depth: must be from 0 to 8, got 9"):
        SceneBuilder().add_sphereflake((0, 0, 0), 1, 9)


@pytest.mark.parametrize("name", ["matte", "plastic", "metal", "mirror", "glass", "water", "diamond"])
def test_presets(name):
    for fields in ({}, {"reflectivity": 0.125}, {"exponent": 9}):
        keys = {"materials": {"a": {"preset": name, **fields}}, "objects": [{**ball(0, 0, 1), "material": "a"}]}
        builder = base_builder(keys)
        builder.add_spheres((0, 0, 0), 1, material=builder.add_material(Material.preset(name, **fields), name="a"))
        check_same(builder, keys)


def test_names():
    builder = SceneBuilder()
    builder.add_material(glass="N-BK7")
    builder.add_material(glass=Sellmeier.catalogue("N-BK7"))
    builder.add_material(color=raylane.Pattern("checker", ("#000000", "#ff8000")))
    builder.background = "#ffffff"
    builder.add_spheres((0, 0, 0), 1, material=0)
    scene = builder.build()
    assert scene.material(0) == scene.material(1) and scene.material(0).index == pytest.approx(1.5168, abs=1e-5)
    assert scene.background == (1, 1, 1) and scene.material(2).color.colors[1][0] == 1
    for wrong, message in (
        (lambda: Material.preset("gold"), 'preset: must be one of "matte", .*got "gold"'),
        (lambda: builder.add_material(glass="BK7"), 'glass: must be one of "N-BK7", .*got "BK7"'),
        (lambda: builder.add_material(color="red"), 'color: must be "#rrggbb", got "red"'),
    ):
        with pytest.raises(InvalidValue, match=message):
            wrong()


@pytest.mark.parametrize(
    "camera, words",
    [
        (AutoCamera(), {}),
        (AutoCamera("corner", zoom=1.5), {"view": "corner", "zoom": 1.5}),
        (AutoCamera("x", field_of_view=40, depth_cue=0.5), {"view": "x", "field_of_view": 40, "depth_cue": 0.5}),
        (AutoCamera((1, -2, -3), (0, 1, 0.5), "orthographic"), {"view": [1, -2, -3], "up": [0, 1, 0.5], "orthographic": True}),
    ],
)
def test_automatic_cameras(camera, words):
    keys = {"camera": {"type": "auto", **words}, "lights": [{"type": "camera"}]}
    builder = base_builder(keys)
    builder.camera, builder.camera_lights = camera, True
    check_same(builder, keys)


def test_an_invalid_automatic_camera_leaves_the_builder():
    for camera, message in (
        (AutoCamera("above"), 'camera/view: must be one of "front", .*got "above"'),
        (AutoCamera((0, 0, 0)), "camera/view: must not be the zero vector"),
        (AutoCamera(zoom=0), "camera/zoom: must be from 0.01 to 1000, got 0"),
        (AutoCamera(up=(0, 0, 2)), "camera/up: must not be 0 or parallel to the direction of view"),
    ):
        builder = base_builder()
        builder.camera = camera
        with pytest.raises(InvalidValue, match=message):
            builder.build()
        assert len(builder) == 1


def test_the_default_material_gets_an_index_when_it_is_used():
    builder = SceneBuilder()
    builder.add_material(color=(1, 0, 0))
    with pytest.raises(InvalidValue):
        builder.add_spheres((0, 0, 0), -1)
    builder.add_spheres((0, 0, 0), 1)
    builder.add_material(color=(0, 1, 0))
    builder.add_boxes((2, 0, 0), np.eye(3))
    builder.add_solid(Solid.sphere((5, 0, 0), 1, material=2) | Solid.sphere((5, 1, 0), 1))
    scene = builder.build()
    assert scene.material_of(np.arange(4)).tolist() == [1, 1, 2, 1]
    assert scene.material(1) == Material()


def test_a_union_of_thousands_of_solids(random):
    centers = random.uniform(0, 14, (2000, 3))
    balls = [Solid.sphere(center, 0.3) for center in centers]
    builder = SceneBuilder()
    assert builder.add_solid(Solid.union(balls)) == range(0, 2000)
    # A chain of operators is one union, too: it is not nested deeper than 1024 levels.
    assert builder.add_solid(functools.reduce(operator.or_, balls[:1500])) == range(2000, 3500)
    with pytest.raises(InvalidValue):
        builder.add_solid(Solid.union([]))


def test_a_group_that_is_invalid_adds_nothing():
    builder, group = SceneBuilder(), Group()
    group.add_spheres((0, 0, 0), 1)
    with pytest.raises(InvalidValue, match="1/radius: must be positive, got -1"):
        group.add_spheres((0, 0, 0), [1, -1])
    group.add_solid(Solid.quadric((0, 0, 0), [1, 1, 0, 0, 0, 0, 0, 0, 0, -1]))
    with pytest.raises(InvalidValue, match="objects/2: must be bounded"):
        builder.add_group(group)
    assert len(builder) == 0
    with pytest.raises(InvalidValue, match="scale: must be one number for all axes"):
        discs = Group()
        discs.add_discs((0, 0, 0), (0, 0, 1), 1)
        discs.transformed(Transform().scaled((1, 1, 2)))
    with pytest.raises(InvalidValue, match="transform: must not be singular"):
        Transform(np.zeros((3, 4)))
    with pytest.raises(TypeError):
        group.transformed(np.eye(4))
    with pytest.raises(InvalidValue, match="upper: must be more than lower"):
        builder.add_aligned_boxes((0, 0, 0), [(1, 1, 1), (1, 0, 1)])
