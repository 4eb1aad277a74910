"""Arrays behave as users of NumPy expect: broadcasting, shapes, masks, DLPack, and old names."""

import copy
import os
import pickle
import subprocess
import sys
import warnings

import numpy as np
import pytest
import raylane
from raylane import NO_SHAPE, Hits, InvalidValue, Leaving, Tracer

ARRAYS = ("t", "shape_id", "entering", "face", "normal", "hit")


def same(a, b):
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in ARRAYS)


def image_rays(height, width, dtype, order):
    """Returns rays in rows and columns, of which some miss, in an order of memory."""
    x, y = np.meshgrid(np.linspace(-1.5, 1.5, width), np.linspace(1.5, -1.5, height))
    directions = np.stack([x, y, np.full_like(x, -5)]).astype(dtype)
    origins = np.broadcast_to(np.array([0, 0, 5], dtype)[:, None, None], directions.shape)
    planes = [np.ascontiguousarray(planes) for planes in (origins, directions)]
    return [order(np.moveaxis(each, 0, -1)) for each in planes]


ORDERS = {
    "planes": np.asarray,
    "rows": np.ascontiguousarray,
    "Fortran": np.asfortranarray,
    "every other pixel": lambda a: np.repeat(np.repeat(a, 2, axis=0), 2, axis=1)[::2, ::2],
    "upside down": lambda a: a[::-1].copy()[::-1],
}


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("order", ORDERS)
def test_leading_axes(ball, dtype, order):
    """Rays of any shape have the hits of the same rays in one row."""
    tracer = Tracer(ball)
    height, width = 9, 14
    o, d = image_rays(height, width, dtype, ORDERS[order])
    flat = [np.ascontiguousarray(a).reshape(-1, 3) for a in (o, d)]
    expected = tracer.intersect(*flat, double=True)
    assert 0.1 < expected.hit.mean() < 0.9
    hits = tracer.intersect(o, d, double=True)
    assert hits.shape == hits.t.shape == hits.hit.shape == hits.t_double.shape == (height, width)
    assert hits.normal.shape == (height, width, 3) and len(hits) == height and hits.t.dtype == dtype
    for name in (*ARRAYS, "t_double"):
        values = getattr(expected, name)
        assert np.array_equal(getattr(hits, name), values.reshape(height, width, *values.shape[1:])), name
    assert np.array_equal(tracer.occluded(o, d), hits.hit)
    deep = tracer.intersect(o.reshape(3, 3, 2, 7, 3), d.reshape(3, 3, 2, 7, 3))
    assert deep.shape == (3, 3, 2, 7) and np.array_equal(deep.t.ravel(), expected.t)
    # Rows are in the order of C.
    rows, flat_rows = tracer.crossings(o, d, normals=True), tracer.crossings(*flat, normals=True)
    for name in ("first", "t", "shape_id", "normal"):
        assert np.array_equal(getattr(rows, name), getattr(flat_rows, name))
    assert np.array_equal(rows.counts().reshape(height, width) > 0, hits.hit)
    assert np.array_equal(tracer.path_lengths(o, d).total(), tracer.path_lengths(*flat).total())
    points = o + dtype(5) * d / np.linalg.norm(d, axis=-1, keepdims=True).astype(dtype)
    assert np.array_equal(tracer.contains(points).counts(), tracer.contains(points.reshape(-1, 3)).counts())
    # Limits and the surfaces that rays leave have leading axes, too, and so have arrays to fill.
    limit = np.where(np.arange(width) % 2 == 0, 2.0, 0.82).astype(dtype)
    limited = tracer.intersect(o, d, t_max=np.broadcast_to(limit, (height, width)))
    assert same(limited, tracer.intersect(o, d, t_max=limit)) and 0 < limited.hit.sum() < hits.hit.sum()
    out = Hits((height, width))
    assert tracer.intersect(o, d, t_max=limit, out=out) is out and same(out, limited)
    blocked = np.empty((height, width), bool)
    assert tracer.occluded(o, d, t_max=limit, out=blocked) is blocked and np.array_equal(blocked, limited.hit)
    at, leaving = hits.onward(-d)
    assert at.shape == (height, width, 3) and leaving.inward.shape == (height, width)
    met = hits.hit
    back = tracer.intersect(np.where(met[..., None], at, o), -d, leaving=leaving)
    assert back.shape == (height, width) and not back.hit[met].any()


def test_arrays_broadcast(ball):
    """Each array broadcasts with the others, as if NumPy had expanded all of them."""
    tracer = Tracer(ball)
    random = np.random.default_rng(2)
    shapes = [(), (1,), (5,), (4, 1), (1, 5), (4, 5), (3, 1, 5), (2, 3, 1, 1)]
    seen = set()
    for _ in range(60):
        o_shape, d_shape, min_shape, max_shape = (shapes[i] for i in random.integers(0, len(shapes), 4))
        o = random.normal(size=(*o_shape, 3)) * 0.3 + [0, 0, 5]
        d = random.normal(size=(*d_shape, 3)) * 0.7 - [0, 0, 5]
        t_min, t_max = random.uniform(0.5, 0.9, min_shape), random.uniform(0.7, 2, max_shape)
        shape = np.broadcast_shapes(o_shape, d_shape, min_shape, max_shape)
        whole = [np.array(np.broadcast_to(a, (*shape, *row))) for a, row in ((o, (3,)), (d, (3,)), (t_min, ()), (t_max, ()))]
        expected = tracer.intersect(*(a.reshape(-1, 3) for a in whole[:2]), t_min=whole[2].ravel(), t_max=whole[3].ravel())
        hits = tracer.intersect(o, d, t_min=t_min, t_max=t_max)
        assert hits.shape == shape and np.array_equal(hits.t.ravel(), expected.t)
        assert np.array_equal(hits.shape_id.ravel(), expected.shape_id)
        assert np.array_equal(tracer.occluded(o, d, t_min=t_min, t_max=t_max), hits.hit)
        assert np.array_equal(tracer.crossings(o, d, t_min=t_min, t_max=t_max).counts() > 0, expected.hit)
        seen.add(shape)
    assert len(seen) > 5
    # One ray and several limits; several surfaces to leave.
    assert tracer.intersect([0, 0, 5], [0, 0, -1], t_min=[0, 4, 4.5, 9]).t.tolist() == [4, 4.5, 5.5, np.inf]
    leaving = Leaving([[0], [NO_SHAPE]], 0, [[True], [False]])
    assert tracer.intersect([0, 0, 1], [[0, 0, -1], [0, 0, -2]], leaving=leaving).t.tolist() == [[0.5, 0.25]] * 2
    for call, field in (
        (lambda: tracer.intersect(np.zeros((4, 3)), np.ones((5, 3))), "directions"),
        (lambda: tracer.intersect(np.zeros((4, 1, 3)), np.ones((5, 3)), t_max=np.ones((3, 5))), "t_max"),
        (lambda: tracer.intersect(np.zeros((4, 4)), np.ones((5, 3))), "origins"),
        (lambda: tracer.contains(np.zeros((3, 4))), "points"),
        (lambda: tracer.contains(0.0), "points"),
    ):
        with pytest.raises(InvalidValue) as error:
            call()
        assert error.value.field == field
    with pytest.raises(InvalidValue, match=r"t_max: must broadcast to the shape \(4, 5\), got \(3, 5\)"):
        tracer.intersect(np.zeros((4, 1, 3)), np.ones((5, 3)), t_max=np.ones((3, 5)))
    with pytest.raises(InvalidValue, match=r"origins: must have the shape \(..., 3\), got \(4, 4\)"):
        tracer.intersect(np.zeros((4, 4)), np.ones((5, 3)))


def test_one_ray(ball):
    """A single ray has hits of the shape (), as single numbers in NumPy."""
    tracer = Tracer(ball)
    hits = tracer.intersect([0, 0, 5], [0, 0, -1], double=True)
    assert hits.shape == hits.t.shape == hits.normal.shape[:-1] == () and hits.hit
    assert float(hits.t) == 4.0 and int(hits.shape_id) == 0 and hits.normal.tolist() == [0, 0, 1]
    assert bool(tracer.occluded([0, 0, 5], [0, 0, -1])) and "1 of 1" in repr(hits)
    with pytest.raises(TypeError):
        len(hits)
    assert hits[()].shape == () and hits[None].normal.tolist() == hits[hits.hit].normal.tolist() == [[0, 0, 1]]
    at, leaving = hits.onward([0, 0, -1])
    assert at.tolist() == [0, 0, 1] and tracer.intersect(at, [0, 0, -1], leaving=leaving).t.tolist() == 0.5
    assert tracer.intersect([[0, 0, 5]], [0, 0, -1]).shape == (1,)
    assert len(tracer.crossings([0, 0, 5], [0, 0, -1])) == len(tracer.contains([0, 0, 1])) == 1


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_planes_are_read_in_place(dtype):
    def in_place(o, d, *rest):
        return raylane._raylane.Tracer.reads_in_place(o, d, (*rest, *[None] * (5 - len(rest))))

    planes = np.moveaxis(np.ones((3, 6, 8), dtype), 0, -1)
    limits, ids = np.ones((6, 8), dtype), np.zeros((6, 8), np.uint32)
    assert in_place(planes, planes, limits, limits, ids)
    camera = raylane.Camera().rays(8, 6)
    assert in_place(*camera)
    for o, d, *rest in (
        (planes.copy(), planes),
        (planes[:, ::2], planes[:, ::2]),
        (planes[::-1], planes),
        (planes, planes, np.asfortranarray(limits)),
        (planes, planes, limits[0]),
        (planes[0, 0], planes),
    ):
        assert not in_place(o, d, *rest)


def test_hits_are_indexed(ball):
    tracer = Tracer(ball)
    for dtype in (np.float32, np.float64):
        o, d = image_rays(6, 7, dtype, np.asarray)
        hits = tracer.intersect(o, d, double=True)
        indices = (
            hits.hit, ~hits.hit, 2, -1, (2, 3), slice(1, 4), (slice(None), 3), (..., 0), [0, 4, 0], None,
            (np.array([0, 5]), np.array([1, 2])), (slice(None, None, 2), slice(None, None, -1)), hits.hit[:, 0],
        )
        for index in indices:
            part = hits[index]
            assert isinstance(part, Hits) and part.shape == hits.t[index].shape
            for name in ("t", "shape_id", "entering", "face", "hit", "t_double"):
                assert np.array_equal(getattr(part, name), getattr(hits, name)[index]), name
            for axis in range(3):
                assert np.array_equal(part.normal[..., axis], hits.normal[..., axis][index])
        met = hits[hits.hit]
        assert met.hit.all() and len(met) == hits.hit.sum()
        # The rays belong to the hits that are left.
        points, leaving = met.onward(met.normal)
        whole, all_leaving = hits.onward(hits.normal)
        assert np.array_equal(points, whole[hits.hit]) and np.array_equal(leaving.inward, all_leaving.inward[hits.hit])
        assert not tracer.occluded(points, met.normal, leaving=leaving)[met.shape_id == 0].any()
        # The rays may have broadcast.
        fan = tracer.intersect([0, 0, 5], d, t_max=9)
        assert np.array_equal(fan[fan.hit].onward([0, 0, 1])[0], fan.onward([0, 0, 1])[0][fan.hit])
    assert [each.shape for each in hits] == [(7,)] * 6
    with pytest.raises(IndexError):
        hits[6]
    assert tracer.intersect(*image_rays(6, 7, np.float64, np.asarray), out=hits[:]).shape == (6, 7)
    part = pickle.loads(pickle.dumps(copy.deepcopy(hits[2:4])))
    assert same(part, hits[2:4]) and same(Hits(3)[[]], Hits(0))


def test_misses_have_no_material(ball):
    tracer = Tracer(ball)
    hits = tracer.intersect([[0, 0, 5], [0, 9, 5], [0, 0, 0.75]], [0, 0, -1])
    assert ball.material_of(hits.shape_id).tolist() == [0, -1, 1] and ball.material_of(NO_SHAPE) == -1
    assert ball.material_of(hits.shape_id).dtype == np.int64
    assert ball.solid_of(hits.shape_id).tolist() == [0, NO_SHAPE, 1] and ball.solid_of(NO_SHAPE) == NO_SHAPE
    with pytest.raises(InvalidValue):
        ball.material_of(NO_SHAPE - 1)


class OnlyDLPack:
    """An array of another library, without NumPy's protocols."""

    def __init__(self, array):
        self._array = array

    def __dlpack__(self, *values, **named):
        return self._array.__dlpack__(*values, **named)

    def __dlpack_device__(self):
        return self._array.__dlpack_device__()


@pytest.mark.skipif(not hasattr(np, "from_dlpack"), reason="NumPy before 1.23 has no from_dlpack")
def test_dlpack(ball):
    tracer = Tracer(ball)
    for dtype in (np.float32, np.float64):
        o, d = image_rays(6, 7, dtype, np.asarray)
        t_max = np.full((6, 7), 4.25, dtype)
        expected = tracer.intersect(o, d, t_max=t_max)
        hits = tracer.intersect(OnlyDLPack(o), OnlyDLPack(d), t_max=OnlyDLPack(t_max))
        assert same(hits, expected) and hits.t.dtype == dtype
        assert raylane._raylane.Tracer.reads_in_place(OnlyDLPack(o), OnlyDLPack(d), (None,) * 5)
        assert np.shares_memory(np.from_dlpack(hits.t), hits.t)
        assert np.array_equal(hits[2:].onward(OnlyDLPack(d[2:]))[0], expected.onward(d)[0][2:], equal_nan=True)
    # A limit in float64 that no float32 equals makes the rays double, as that of an array does.
    o, d = (OnlyDLPack(np.array(v, np.float32)) for v in ([0, 0, 5], [0, 0, -1]))
    assert not tracer.occluded(o, d, t_max=OnlyDLPack(np.array(4 - 1e-12)))
    builder = raylane.SceneBuilder()
    builder.add_spheres(OnlyDLPack(np.eye(3, dtype=np.float32)), OnlyDLPack(np.float32([1, 2, 3])), material=builder.add_material())
    assert np.array_equal(builder.build().spheres().center, np.eye(3))


def test_old_names_warn(ball):
    tracer = Tracer(ball)
    o, d = np.array([[0, 0, 5], [0, 9, 5], [0, 0, 0.75]]), [0, 0, -1]
    hits = tracer.intersect(o, d)
    ids = hits.shape_id
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert np.shape(hits) == hits.shape == (3,) and hits.shape[0] == 3 and hits.shape != (4,)
        assert np.zeros(hits.shape).shape == (3,) and (*hits.shape, 3) == hits.shape + (3,) == (3, 3)
        assert np.prod(hits.shape) == np.max(hits.shape) == 3 and np.array(hits.shape).tolist() == [3]
        assert hits.t.reshape(hits.shape).shape == (3,) and {hits.shape: 1}[3,] == 1 and str(hits.shape) == "(3,)"
    for use, expected in (
        (lambda: hits.shape[hits.hit], ids[hits.hit]),
        (lambda: hits.shape == 1, ids == 1),
        (lambda: hits.shape != np.uint32(NO_SHAPE), hits.hit),
        (lambda: hits.shape.tolist(), ids.tolist()),
        (lambda: hits.shape.astype(int), ids.astype(int)),
        (lambda: ball.material_of(hits.shape), ball.material_of(ids)),
        (lambda: ball.solid_of(hits.shape), ball.solid_of(ids)),
        (lambda: tracer.crossings(o, d).shape, tracer.crossings(o, d).shape_id),
        (lambda: tracer.contains(o).shape, tracer.contains(o).shape_id),
        (lambda: Leaving(shape=ids, face=0).shape_id, ids),
        (lambda: Leaving(ids, 0).shape, ids),
        (lambda: tracer.occluded(o[::2] - [[0, 0, 4], [0, 0, 0.25]], [0, 0, 1], leaving=Leaving(hits[::2].shape, 0, 0)), [False, True]),
        (lambda: ball.render(width=4, height=3, aovs=True).aovs.shape.shape, (3, 4)),
    ):
        with pytest.warns(DeprecationWarning, match="shape_id") as warned:
            assert np.array_equal(use(), expected)
        assert len(warned) == 1 and warned[0].filename == __file__
    aovs = raylane.render(ball, width=4, height=3, aovs=True).aovs
    for use, new in (
        (lambda: raylane.render(ball, width=4, height=3, layers=True).aovs.depth, "aovs=..."),
        (lambda: raylane.Image(np.zeros((3, 4, 3)), layers=aovs).aovs.depth, "Image(aovs=...)"),
        (lambda: raylane.render(ball, width=4, height=3, aovs=True).layers.depth, "aovs"),
        (lambda: raylane.Layers and aovs.depth, "Aovs"),
        (lambda: raylane.Settings(max_see_through=2).max_transparent * aovs.depth / 2, "max_transparent"),
        (lambda: raylane.render(ball, width=4, height=3, max_see_through=2, aovs=True).aovs.depth, "max_transparent"),
    ):
        with pytest.warns(DeprecationWarning) as warned:
            assert np.array_equal(use(), aovs.depth)
        assert len(warned) == 1 and new in str(warned[0].message)
    leaving = Leaving(ids, 0)
    with pytest.warns(DeprecationWarning, match="Leaving.shape is now shape_id"):
        leaving.shape = 7
    assert leaving.shape_id == 7
    assert pickle.loads(pickle.dumps(hits.shape)) == copy.deepcopy(hits.shape) == (3,)


def test_an_old_pybind11_reads_arrays_of_numpy_1_only():
    """Importing says so, instead of a crash later."""
    code = (
        "import numpy; major = int(numpy.__version__.split('.')[0]); numpy.__version__ = '2.0.0'\n"
        "try: import raylane\n"
        "except ImportError as error: assert major == 1 and 'install numpy<2' in str(error), error; print('refused')\n"
        "else: print('imported')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=os.environ.copy())
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() in ("refused", "imported")


def test_images_are_arrays():
    image = raylane.Image(np.ones((2, 3, 3), np.float32))
    assert np.asarray(image) is image.rgb and image.__array__(copy=False) is image.rgb
    assert not np.shares_memory(image.__array__(copy=True), image.rgb)
    assert np.asarray(image, np.float64).dtype == np.float64 and not np.shares_memory(np.array(image), image.rgb)
    with pytest.raises(ValueError):
        image.__array__(np.float64, copy=False)
