"""Scenes give their shapes back, and cameras the rays of their images."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest
import raylane
from raylane import NO_SHAPE, InvalidValue, SceneBuilder, Solid, Tracer

COEFFICIENTS = [1.0, 2, 3, 0.25, 0.5, 0.125, 0.5, 0, 0.25, -1]


def arrays(random, n, dtype):
    """Returns the arrays of n shapes of each kind: the builder's method, its arguments, and the scene's method."""

    def some(*shape):
        return random.normal(size=(n, *shape)).astype(dtype)

    radii = random.uniform(0.1, 1, n).astype(dtype)
    coefficients = np.tile(np.array(COEFFICIENTS, dtype), (n, 1))
    corners = some(3, 3)
    return [
        ("add_spheres", {"centers": some(3), "radii": radii}, lambda scene: scene.spheres()),
        ("add_ellipsoids", {"centers": some(3), "axes": some(3, 3)}, lambda scene: scene.ellipsoids()),
        ("add_planes", {"points": some(3), "normals": some(3)}, lambda scene: scene.planes()),
        ("add_discs", {"centers": some(3), "normals": some(3), "radii": radii}, lambda scene: scene.discs()),
        ("add_triangles", {"corners": corners}, lambda scene: scene.triangles()),
        ("add_triangles", {"corners": corners, "normals": some(3, 3)}, lambda scene: scene.triangles(smooth=True)),
        ("add_boxes", {"corners": some(3), "edges": some(3, 3)}, lambda scene: scene.boxes()),
        ("add_cylinders", {"bases": some(3), "axes": some(3), "radii": radii}, lambda scene: scene.cylinders()),
        ("add_cylinders", {"bases": some(3), "axes": some(3), "radii": radii, "caps": False}, lambda scene: scene.cylinders(caps=False)),
        ("add_cones", {"bases": some(3), "axes": some(3), "base_radii": radii, "top_radii": 2 * radii}, lambda scene: scene.cones()),
        ("add_cones", {"bases": some(3), "axes": some(3), "base_radii": radii, "top_radii": 0 * radii, "caps": False}, lambda scene: scene.cones(caps=False)),
        ("add_quadrics", {"centers": some(3), "coefficients": coefficients, "lower": some(3) - 9, "upper": some(3) + 9}, lambda scene: scene.quadrics()),
    ]


NAMES = {"centers": "center", "radii": "radius", "points": "point", "bases": "base", "base_radii": "base_radius", "top_radii": "top_radius"}
SINGULAR_IN = {"plane": {"normals": "normal"}, "disc": {"normals": "normal"}, "box": {"corners": "corner"}}


def name_in(shapes, argument):
    """Returns the name of an argument in Shapes."""
    if shapes.kind.endswith(("cylinder", "cone")) and argument == "axes":
        return "axis"
    return SINGULAR_IN.get(shapes.kind, {}).get(argument, NAMES.get(argument, argument))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("merge", [True, False])
def test_a_scene_gives_back_what_it_was_given(random, dtype, merge):
    """Each number of each kind of shape, in the order of ids, also if equal shapes count as one."""
    n = 40
    builder, kinds = SceneBuilder(merge_duplicates=merge), arrays(random, n, dtype)
    materials = random.integers(0, 3, n)
    for _ in range(3):
        builder.add_material()
    again = np.concatenate([np.arange(n), random.integers(0, n, 10)])  # with duplicates
    given = [[] for _ in kinds]
    for rows in np.array_split(again, 5):  # kinds take turns, so that ids of a kind have gaps
        for number, (method, arguments, _) in enumerate(kinds):
            part = {name: a if name == "caps" else a[rows] for name, a in arguments.items()}
            given[number] += getattr(builder, method)(**part, material=materials[rows])
    scene = builder.build()
    moved = scene.with_positions(scene.spheres().center)
    for scene in (scene, moved, pickle.loads(pickle.dumps(scene))):
        for ids, (_, arguments, get) in zip(given, kinds):
            shapes = get(scene)
            assert shapes.shape_id.tolist() == ids and shapes.material.tolist() == materials[again].tolist()
            assert len(shapes) == len(ids) and shapes.kind in repr(shapes)
            for argument, values in arguments.items():
                if argument == "caps":
                    continue
                found = getattr(shapes, name_in(shapes, argument))
                assert found.dtype == dtype and found.flags.c_contiguous
                assert found.tobytes() == values[again].tobytes(), (shapes.kind, argument)
                for i in (0, 7, len(ids) - 1):
                    one = scene.shape(ids[i])
                    assert one.kind == shapes.kind and one.shape_id == ids[i] and one.material == shapes.material[i]
                    assert np.array_equal(getattr(one, name_in(one, argument)), found[i])


def test_a_builder_takes_what_a_scene_gives(random):
    builder, kinds = SceneBuilder(), arrays(random, 30, np.float64)
    for _ in range(2):
        builder.add_material()
    for method, arguments, _ in kinds:
        getattr(builder, method)(**arguments, material=random.integers(0, 2, 30))
    scene = builder.build()
    whole, single = SceneBuilder(), SceneBuilder()
    for each in (whole, single):
        for material in scene.materials:
            each.add_material(material)
    for _, _, get in kinds:
        shapes = get(scene)
        assert list(whole.add(shapes)) == shapes.shape_id.tolist()
    for id in range(scene.shape_count):
        assert single.add(scene.shape(id)) == range(id, id + 1)
    o, d = random.normal(size=(2000, 3)) * 3, random.normal(size=(2000, 3))
    expected = Tracer(scene).intersect(o, d)
    for other in (whole.build(), single.build()):
        hits = Tracer(other).intersect(o, d)
        assert np.array_equal(hits.t, expected.t) and np.array_equal(hits.shape_id, expected.shape_id)
        ids = np.arange(other.shape_count)
        assert np.array_equal(other.material_of(ids), scene.material_of(ids))
    # The arrays may be changed, copied and pickled.
    balls = scene.spheres()
    for again in (copy.deepcopy(balls), pickle.loads(pickle.dumps(balls))):
        again.radius = 2 * again.radius
        again.material = 1
        whole.add_material(), whole.add_material()
        whole.add(again)
        bigger = whole.build()
        assert np.array_equal(bigger.spheres().radius, 2 * balls.radius) and set(bigger.spheres().material) == {1}
    with pytest.raises(TypeError):
        SceneBuilder().add(5)
    with pytest.raises(InvalidValue, match="0/material"):
        SceneBuilder().add(balls)


def test_one_shape(ball):
    inner = ball.shape(1)
    assert (inner.kind, inner.shape_id, inner.material, float(inner.radius)) == ("sphere", 1, 1, 0.5)
    assert inner.center.tolist() == [0, 0, 0] and inner.radius.dtype == np.float32
    assert repr(inner) == "<raylane.Shapes: sphere 1 of material 1, center [0. 0. 0.], radius 0.5>"
    assert ball.shape(np.uint32(0)).radius == 1
    assert len(ball.boxes()) == 0 and ball.boxes().edges.shape == (0, 3, 3)
    for wrong in (2, -1, NO_SHAPE, 2**40, 0.5, "a", None):
        with pytest.raises(InvalidValue) as error:
            ball.shape(wrong)
        assert error.value.field == "id"


def test_parts_of_solids(random):
    """A part has an id and a shape, but is not among the scene's spheres."""
    builder = SceneBuilder()
    materials = [builder.add_material(), builder.add_material()]
    builder.add_spheres([9, 0, 0], 1, material=materials[1])
    solid = Solid.sphere((0.1, 0, 0), 1) & Solid.half_space((0, 0.1, 0), (0, 1, 0.5), material=materials[1])
    solid = solid - Solid.box((0, 0, 0), np.eye(3) * 0.3) - Solid.cone((0, -1, 0), (0, 0.7, 0), 0.25)
    parts = builder.add_solid(solid, material=materials[0])
    builder.add_spheres([-9, 0, 0], 2, material=materials[0])
    scene = builder.build()
    assert scene.spheres().shape_id.tolist() == [0, parts[-1] + 1] and scene.spheres().radius.tolist() == [1, 2]
    assert len(scene.planes()) == len(scene.quadrics()) == len(scene.boxes()) == len(scene.cones()) == 0
    sphere, plane, box, cone = (scene.shape(id) for id in parts)
    assert (sphere.kind, sphere.center.tolist(), sphere.radius) == ("sphere", [0.1, 0, 0], 1)
    assert (plane.kind, plane.point.tolist(), plane.normal.tolist()) == ("plane", [0, 0.1, 0], [0, 1, 0.5])
    assert plane.material == materials[1] and sphere.material == materials[0]
    assert (box.kind, box.edges.tolist()) == ("box", (np.eye(3) * 0.3).tolist())
    assert (cone.kind, cone.base_radius, cone.top_radius) == ("capped cone", 0.25, 0)


def test_spheres_move_to_where_a_scene_says(random):
    """Rows of spheres() are those of with_positions(), and moved spheres have the new numbers."""
    builder = SceneBuilder()
    material = builder.add_material()
    builder.add_boxes([0, 0, 9], np.eye(3), material=material)
    before = np.repeat(random.normal(size=(50, 3)), 2, axis=0)  # each twice
    builder.add_spheres(before, 0.1, material=material)
    builder.add_solid(Solid.sphere((0, 0, 0), 0.5), material=material)
    builder.add_boxes([[0, 0, 9], [0, 0, 9]], np.eye(3), material=material)
    scene = builder.build()
    for _ in range(3):
        after = scene.spheres().center + random.normal(scale=0.1, size=before.shape)
        scene = scene.with_positions(after)
        balls = scene.spheres()
        assert balls.center.tobytes() == after.tobytes() and set(balls.radius) == {0.1}
        assert balls.shape_id.tolist() == list(range(1, 101)) and scene.shape(7).center.tolist() == after[6].tolist()
        assert scene.boxes().shape_id.tolist() == [0, 102, 103] and scene.shape(103).corner.tolist() == [0, 0, 9]


def test_shapes_of_files(scenes):
    scene = raylane.load(scenes / "birthday.json")
    kinds = [scene.spheres(), scene.ellipsoids(), scene.planes(), scene.discs(), scene.triangles(), scene.triangles(smooth=True)]
    kinds += [scene.boxes(), scene.quadrics()] + [get(caps=caps) for get in (scene.cylinders, scene.cones) for caps in (True, False)]
    ids = np.concatenate([shapes.shape_id for shapes in kinds])
    own = scene.solid_of(np.arange(scene.shape_count))
    in_solids = {i for i in range(scene.shape_count) if (own == own[i]).sum() > 1}
    assert sorted(ids) == [i for i in range(scene.shape_count) if i not in in_solids]
    for shapes in kinds:
        for i in range(0, len(shapes), 97):
            assert scene.shape(shapes.shape_id[i]).kind == shapes.kind


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_camera_rays_are_those_of_images(scenes, projection):
    """Their hits have the depths, ids and normals that rendering finds, to the bit."""
    scene = raylane.load(scenes / "birthday.json")
    camera = dataclasses.replace(scene.camera, projection=projection, height=4.0, lens_radius=0.0)
    scene = scene.seen_by(camera)
    size = {"width": 61, "height": 40}
    aovs = scene.render(**size, grid=1, samples="regular", filter="box", quality=0, aovs=True).aovs
    origins, directions = scene.camera.rays(**size)
    assert origins.shape == directions.shape == (40, 61, 3) and directions.dtype == np.float64
    assert np.allclose(np.linalg.norm(directions, axis=-1), 1, rtol=1e-15)
    if projection == "perspective":
        assert (origins == camera.position).all()
    hits = Tracer(scene).intersect(origins, directions)
    assert 0.3 < hits.hit.mean()
    # Surfaces that are visible from one side, or only partly, are not in the aovs.
    opaque = np.array([m.opacity == 1 and m.visible == "both" for m in scene.materials])
    plain = ~hits.hit | opaque[scene.material_of(hits.shape_id)]
    assert plain.mean() > 0.9
    assert np.array_equal(hits.t.astype(np.float32)[plain], aovs.depth[plain])
    assert np.array_equal(hits.shape_id[plain], aovs.shape_id[plain])


def test_rays_of_an_automatic_camera():
    """The camera that a builder fits gives rays of which the outer ones miss the scene's only sphere."""
    builder = SceneBuilder()
    builder.add_spheres([7, 0, 0], 2, material=builder.add_material())
    scene = builder.build()
    hits = Tracer(scene).intersect(*scene.camera.rays(50, 50))
    assert hits.hit[25, 25] and hits.hit.mean() > 0.5
    assert not (hits.hit[0].any() or hits.hit[-1].any() or hits.hit[:, 0].any() or hits.hit[:, -1].any())
    # Row 0 is the upper edge.
    up = raylane.Camera(position=(0, 0, 5)).rays(3, 3)[1]
    assert (up[0, :, 1] > 0).all() and (up[:, 0, 0] < 0).all() and up[1, 1].tolist() == [0, 0, -1]


def test_rays_of_a_lens():
    """They start on the lens and meet those of its centre in the plane of focus."""
    thin = raylane.Camera(position=(0, 0, 5), lens_radius=0.25, focus_distance=4.0)
    origins, directions = thin.rays(20, 10)
    _, through_centre = dataclasses.replace(thin, lens_radius=0.0).rays(20, 10)
    aside = np.linalg.norm(origins - [0, 0, 5], axis=-1)
    assert (aside <= 0.25).all() and np.ptp(aside) > 0.1 and np.allclose(origins[..., 2], 5)
    at = origins + (4 / -directions[..., 2:]) * directions
    assert np.allclose(at, [0, 0, 5] + (4 / -through_centre[..., 2:]) * through_centre)


def test_rays_that_are_none():
    camera = raylane.Camera()
    for call, field in (
        (lambda: camera.rays(0, 5), "width"),
        (lambda: camera.rays(5, -1), "height"),
        (lambda: camera.rays(65536, 5), "width"),
        (lambda: camera.rays(65535, 65535), "width"),
        (lambda: camera.rays(2.5, 5), "width"),
        (lambda: camera.rays(5, "5"), "height"),
        (lambda: raylane.Camera(field_of_view=0).rays(5, 5), "camera/field_of_view"),
        (lambda: raylane.Camera(at=(0, 0, 5)).rays(5, 5), "camera/at"),
        (lambda: raylane.Camera(position=None).rays(5, 5), "camera/position"),
    ):
        with pytest.raises(InvalidValue) as error:
            call()
        assert error.value.field == field
