"""Closest points: the answers have the shape of the points, and are those of geometry."""

import numpy as np
import pytest
import raylane
from raylane import NO_SHAPE, InvalidValue, Tracer


@pytest.fixture(scope="module")
def balls():
    builder = raylane.SceneBuilder()
    builder.add_spheres([[0, 0, 0], [4, 0, 0]], [1.0, 0.5], material=builder.add_material())
    return builder.build()


def test_closest_of_two_balls(balls):
    closest = Tracer(balls).closest([[3, 0, 0], [0, 0, 5], [0.25, 0, 0]])
    assert closest.distance.tolist() == [0.5, 4, 0.75]
    assert closest.point.tolist() == [[3.5, 0, 0], [0, 0, 1], [1, 0, 0]]
    assert closest.shape_id.tolist() == [1, 0, 0]
    assert closest.face.tolist() == [0, 0, 0]
    assert balls.material_of(closest.shape_id).tolist() == [0, 0, 0]


def test_any_leading_axes_and_limits_that_broadcast(balls):
    tracer = Tracer(balls, 1)
    points = np.random.default_rng(3).normal(size=(4, 5, 3)) * 3
    whole = tracer.closest(points)
    assert whole.distance.shape == (4, 5) and whole.point.shape == (4, 5, 3)
    norms = np.minimum(abs(np.linalg.norm(points, axis=-1) - 1), abs(np.linalg.norm(points - [4, 0, 0], axis=-1) - 0.5))
    assert np.allclose(whole.distance, norms, rtol=1e-14)
    assert np.allclose(np.linalg.norm(whole.point - points, axis=-1), whole.distance, rtol=1e-12)
    single = tracer.closest(points[1, 2])
    assert single.distance.shape == () and single.point.shape == (3,)
    assert single.distance == whole.distance[1, 2] and (single.point == whole.point[1, 2]).all()
    limited = tracer.closest(points, np.array([[0.5], [1], [2], [np.inf]]))
    near = whole.distance <= np.array([[0.5], [1], [2], [np.inf]])
    assert ((limited.shape_id != NO_SHAPE) == near).all() and (limited.distance[near] == whole.distance[near]).all()
    assert np.isinf(limited.distance[~near]).all() and np.isnan(limited.point[~near]).all()
    many = tracer.closest([3, 0, 0], max_distance=[0.25, 0.5])
    assert many.shape_id.tolist() == [NO_SHAPE, 1]
    floats = points.astype(np.float32)
    assert (tracer.closest(floats).distance == tracer.closest(floats.astype(np.float64)).distance).all()


def test_points_and_scenes_that_are_refused(balls):
    tracer = Tracer(balls)
    with pytest.warns(RuntimeWarning, match="2 points are refused, and have no closest point"):
        assert tracer.closest([[0, 0, np.nan], [np.inf, 0, 0], [0, 0, 2]]).shape_id.tolist() == [NO_SHAPE, NO_SHAPE, 0]
    with pytest.warns(RuntimeWarning, match="1 point is refused"):
        tracer.closest([0, 0, 2], np.nan)
    for call, field in (
        (lambda: tracer.closest(np.zeros(4)), "points"),
        (lambda: tracer.closest(np.zeros((3, 3)), [1, 2]), "max_distance"),
        (lambda: tracer.closest(np.zeros((3, 3)), "far"), "max_distance"),
    ):
        with pytest.raises(InvalidValue) as error:
            call()
        assert error.value.field == field, str(error.value)
    builder = raylane.SceneBuilder()
    builder.add_solid(raylane.Solid.sphere([0, 0, 0], 1) - raylane.Solid.sphere([1, 0, 0], 1))
    with pytest.raises(InvalidValue, match="constructed solids") as error:
        Tracer(builder.build()).closest([0, 0, 2])
    assert error.value.field == "scene"
