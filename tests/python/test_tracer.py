"""Rays: the form of the input does not change the answers."""

import copy
import pickle
import re
import sys
import threading
import warnings

import numpy as np
import pytest
import raylane
from raylane import NO_SHAPE, Hits, InvalidValue, Leaving, Solid, Tracer


@pytest.fixture(scope="module")
def crowd():
    random = np.random.default_rng(5)
    builder = raylane.SceneBuilder()
    materials = [builder.add_material(color=(i, 1, 1)) for i in range(3)]
    n = 2000
    builder.add_spheres(random.uniform(-5, 5, (n, 3)).astype(np.float32), random.uniform(0.1, 0.5, n).astype(np.float32), material=np.arange(n) % 3)
    builder.add_boxes(random.uniform(-5, 5, (50, 3)), random.normal(size=(50, 3, 3)), material=materials[0])
    return builder.build()


def rays(n, dtype=np.float32, seed=1):
    random = np.random.default_rng(seed)
    return random.uniform(-6, 6, (n, 3)).astype(dtype), random.normal(size=(n, 3)).astype(dtype)


ORDERS = {
    "rows": np.ascontiguousarray,
    "columns": np.asfortranarray,
    "every other": lambda a: np.repeat(a, 2, axis=0)[::2],
    "backwards": lambda a: a[::-1].copy()[::-1],
    "of a wider table": lambda a: np.hstack([a, np.zeros_like(a)])[:, : a.shape[1]],
    "in another order of bytes": lambda a: a.astype(a.dtype.newbyteorder()),
    "not aligned": lambda a: np.frombuffer(b"x" + a.tobytes(), np.uint8)[1:].view(a.dtype).reshape(a.shape),
    "list": lambda a: a.tolist(),
}


def test_crossings_tell_how_comparisons_were_decided():
    builder = raylane.SceneBuilder(merge_duplicates=False)
    builder.add_spheres([[0, 0, 0], [0, 0, 0], [0, 0, 3]], 1)
    tracer = Tracer(builder.build())
    n = 40_000  # more than a part
    with pytest.warns(RuntimeWarning, match="1 ray is refused"):
        rows = tracer.crossings([[0, 0, 9]] * n, np.vstack([np.tile([0.1, 0, -1], (n - 1, 1)), [[0, 0, 0]]]))
    counts = rows.statistics
    assert counts.refused == 1
    assert counts.by_bounds >= n - 1
    assert counts.by_digits + counts.exactly >= n - 1  # of the two equal spheres
    assert tracer.crossings([0, 0, 9], [0, 9, 0]).statistics == raylane.CrossingStatistics(0, 0, 0, 0, 0)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("threads", [1, 3])
def test_any_order_of_memory(crowd, dtype, order, threads):
    tracer = Tracer(crowd, threads)
    n = 20_000 if order != "list" else 100
    origins, directions = rays(n, dtype)
    t_max = np.linspace(1, 9, n).astype(dtype)
    expected = Tracer(crowd, 1).intersect(np.asfortranarray(origins), np.asfortranarray(directions), t_max=t_max, double=True)
    assert 0.2 < expected.hit.mean() < 0.98
    o, d, t = (ORDERS[order](a) for a in (origins, directions, t_max[:, None]))
    t = np.asarray(t)[:, 0]
    hits = tracer.intersect(o, d, t_max=t, double=True)
    same = order != "list" or dtype == np.float64
    for name in ("shape_id", "t_double", "t", "normal", "entering", "face"):
        if same:
            assert np.array_equal(getattr(hits, name), getattr(expected, name)), name
    assert np.array_equal(tracer.occluded(o, d, t_max=t), hits.hit)
    rows = tracer.crossings(o, d, t_max=t, normals=True)
    reached = rows.counts() > 0
    assert np.array_equal(reached, hits.hit)
    first = rows.first[:-1][reached].astype(int)
    assert np.array_equal(rows.shape_id[first], hits.shape_id[reached])
    assert np.array_equal(rows.t[first], hits.t_double[reached])
    assert np.array_equal(rows.normal[first], hits.normal[reached])
    assert np.array_equal(tracer.path_lengths(o, d, t_max=t).total() > 0, tracer.path_lengths(o, d, t_max=t).counts() > 0)


def test_more_rays_than_are_asked_at_once(crowd):
    """Rows of several parts are joined, and hits of several parts are at their places."""
    n = (1 << 18) + 1000
    origins, directions = rays(n)
    tracer = Tracer(crowd)
    some = slice(n - 1500, n)
    whole, part = tracer.crossings(origins, directions, most=2), tracer.crossings(origins[some], directions[some], most=2)
    assert len(whole) == n and whole.first[-1] == len(whole.t)
    assert np.array_equal(whole.counts()[some], part.counts())
    assert np.array_equal(whole.t[-len(part.t):], part.t)
    inside, tail = tracer.contains(origins), tracer.contains(origins[some])
    assert len(inside) == n and np.array_equal(inside.shape_id[-len(tail.shape_id):], tail.shape_id)
    lengths, end = tracer.path_lengths(origins, directions), tracer.path_lengths(origins[some], directions[some])
    assert np.array_equal(lengths.total()[some], end.total())
    hits = tracer.intersect(origins, directions)
    assert np.array_equal(hits.hit, whole.counts() > 0)


def test_no_rays(ball):
    tracer = Tracer(ball)
    nothing = np.empty((0, 3))
    assert len(tracer.intersect(nothing, [0, 0, 1])) == 0
    assert tracer.occluded(nothing, nothing).shape == (0,)
    for rows in (tracer.crossings(nothing, nothing, normals=True), tracer.contains(nothing), tracer.path_lengths(nothing, nothing)):
        assert len(rows) == 0 and rows.first.tolist() == [0]
    assert tracer.path_lengths(nothing, nothing).total().shape == (0,)


def test_one_origin_or_direction_for_all(ball):
    tracer = Tracer(ball)
    assert tracer.intersect([0, 0, 5], [[0, 0, -1], [0, 0, 1], [0, 0, -2]]).t.tolist() == [4.0, np.inf, 2.0]
    assert tracer.intersect([[0, 0, 5], [0, 0, 3]], [0, 0, -1]).t.tolist() == [4.0, 2.0]
    assert tracer.intersect([0, 0, 5], [0, 0, -1]).t.tolist() == 4.0


def test_answers(ball):
    tracer = Tracer(ball)
    hits = tracer.intersect([[0, 0, 5], [0, 0, 5], [0, 0, 0]], [[0, 0, -1], [0, 1, 0], [1, 0, 0]], double=True)
    assert hits.shape_id.tolist() == [0, NO_SHAPE, 1] and hits.hit.tolist() == [True, False, True]
    assert hits.entering.tolist() == [True, False, False]
    assert hits.normal.tolist() == [[0, 0, 1], [0, 0, 0], [1, 0, 0]]
    assert hits.t_double.tolist() == [4.0, np.inf, 0.5]
    assert "2 of 3" in repr(hits)
    rows = tracer.crossings([0, 0, 5], [0, 0, -1], normals=True)
    assert rows.t.tolist() == [4, 4.5, 5.5, 6] and rows.shape_id.tolist() == [0, 1, 1, 0]
    assert rows.entering.tolist() == [True, True, False, False] and rows.of().tolist() == [0] * 4
    assert tracer.crossings([0, 0, 5], [0, 0, -1], most=3).t.tolist() == [4, 4.5, 5.5]
    assert tracer.contains([[0, 0, 1], [0, 0, 0.5]]).shape_id.tolist() == [0, 0, 1]
    assert tracer.contains([[0, 0, 1], [0, 0, 0.5]]).on_surface.tolist() == [True, False, True]
    lengths = tracer.path_lengths([[0, 0, 5], [0, 0, 9]], [0, 0, -1], t_max=[np.inf, 8.25])
    assert lengths.total(0).tolist() == [2, 0.25] and lengths.total(1).tolist() == [1, 0]
    assert lengths.total().tolist() == [3, 0.25]


def test_what_goes_on_from_a_hit(ball):
    """A ray that leaves a surface does not hit it again, however its numbers were rounded."""
    tracer = Tracer(ball)
    n = 2000
    random = np.random.default_rng(3)
    origins = (5 * random.normal(size=(n, 3))).astype(np.float32)
    origins *= 3 / np.linalg.norm(origins, axis=1, keepdims=True).astype(np.float32)
    directions = -origins + random.uniform(-0.9, 0.9, (n, 3)).astype(np.float32)
    hits = tracer.intersect(origins, directions)
    there = hits.hit & (hits.shape_id == 0)
    assert there.sum() > n / 2
    at = origins + hits.t[:, None] * directions
    onwards = tracer.intersect(at[there], hits.normal[there], leaving=Leaving(hits.shape_id[there], hits.face[there], 0))
    assert not onwards.hit.any()
    inwards = tracer.intersect(at[there], -hits.normal[there], leaving=Leaving(hits.shape_id[there], hits.face[there], np.ones(there.sum(), bool)))
    assert inwards.hit.all() and (inwards.shape_id == 1).all()


def test_arrays_are_filled_again(ball):
    tracer = Tracer(ball)
    out = Hits(2)
    assert tracer.intersect([[0, 0, 5], [0, 0, 3]], [0, 0, -1], out=out) is out
    assert out.t.tolist() == [4, 2]
    for wrong in (Hits(3), Hits(1), Hits((1, 2)), Hits(())):
        with pytest.raises(InvalidValue, match="out.t"):
            tracer.intersect([[0, 0, 5], [0, 0, 3]], [0, 0, -1], out=wrong)
    answer = np.empty(2, bool)
    assert tracer.occluded([[0, 0, 5], [0, 0, 3]], [0, 0, 1], out=answer) is answer
    assert answer.tolist() == [False, False]
    with pytest.raises(InvalidValue):
        tracer.occluded([[0, 0, 5], [0, 0, 3]], [0, 0, 1], out=np.empty(4, bool)[::2])
    frozen = np.empty(2, bool)
    frozen.setflags(write=False)
    with pytest.raises(ValueError):
        tracer.occluded([[0, 0, 5], [0, 0, 3]], [0, 0, 1], out=frozen)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_which_arrays_are_read_where_they_are(dtype):
    def in_place(o, d, *rest):
        return raylane._raylane.Tracer.reads_in_place(o, d, (*rest, *[None] * (5 - len(rest))))

    n = 100
    columns, rows, limits = np.zeros((3, n), dtype).T, np.zeros((n, 3), dtype), np.ones(n, dtype)
    ids, faces = np.zeros(n, np.uint32), np.zeros(n, np.uint8)
    assert in_place(columns, columns) and in_place(columns, np.asfortranarray(rows), limits, limits, ids, faces)
    for o, d, *rest in ((rows, columns), (columns, rows), (columns[::2], columns[::2]), (columns, columns, limits[::-1])):
        assert not in_place(o, d, *rest)
    pickled = pickle.loads(pickle.dumps(columns))
    assert in_place(pickled, columns)


def test_what_cannot_be_asked_says_why(ball):
    tracer = Tracer(ball)
    o, d = np.zeros((4, 3)), np.ones((4, 3))
    for call, field in (
        (lambda: tracer.intersect(o[:, :2], d), "origins"),
        (lambda: tracer.intersect(o, d[:3]), "directions"),
        (lambda: tracer.intersect(o, np.zeros((4, 2, 3))), "directions"),
        (lambda: tracer.intersect(o, np.zeros((4, 1, 2))), "directions"),
        (lambda: tracer.intersect("rays", d), "origins"),
        (lambda: tracer.intersect(o, None), "directions"),
        (lambda: tracer.intersect(o, d, t_max=[1, 2]), "t_max"),
        (lambda: tracer.intersect(o, d, t_min="soon"), "t_min"),
        (lambda: tracer.intersect(o, d, leaving=Leaving([0, 0], 0, 0)), "leaving.shape_id"),
        (lambda: tracer.contains(np.zeros(4)), "points"),
        (lambda: tracer.intersect([[0, 0, 5]], [[0, 0, -1], [1]]), "directions"),
        (lambda: tracer.crossings([[0, 0, 5]], [[0, 0, -1], [1]]), "directions"),
        (lambda: tracer.crossings([[0, 0, 5], [1]], [0, 0, 1]), "origins"),
        (lambda: tracer.intersect(o + 1j, d), "origins"),
        (lambda: tracer.intersect([["0", "0", "5"]], d[:1]), "origins"),
        (lambda: tracer.intersect([[None, 0, 5]], d[:1]), "origins"),
        (lambda: tracer.intersect(o.astype(np.longdouble), d), "origins"),
        (lambda: tracer.intersect(np.zeros(4, "f4,f4,f4"), d), "origins"),
        (lambda: tracer.crossings(o, d, most=-1), "most"),
        (lambda: tracer.intersect(o, d, leaving=Leaving(np.full(4, 2**32), 0, 0)), "leaving.shape_id/0"),
        (lambda: tracer.intersect(o, d, leaving=Leaving([0, 0, -1, 0], 0, 0)), "leaving.shape_id/2"),
        (lambda: tracer.intersect(o, d, leaving=Leaving(0, 300, 0)), "leaving.face"),
        (lambda: tracer.intersect(o, d, leaving=Leaving(0, 0, 3)), "leaving.inward"),
        (lambda: tracer.intersect(o, d, leaving=Leaving(0, 0, [0, 1, 2, 3])), "leaving.inward/3"),
        (lambda: tracer.intersect(o, d, leaving=Leaving(0.5, 0, 0)), "leaving.shape_id"),
        (lambda: tracer.occluded(o[:1], d[:1], out=np.empty(1, np.uint8)), "out"),
        (lambda: tracer.occluded(o, d, out=[True] * 4), "out"),
        (lambda: tracer.occluded(o, d, out=np.empty(3, bool)), "out"),
        (lambda: Tracer(ball, 5000), "threads"),
        (lambda: Tracer(ball, -1), "threads"),
        (lambda: Tracer(ball, precision="best"), "precision"),
        (lambda: Tracer(ball, "2"), "threads"),
        (lambda: Tracer(ball, 2**40), "threads"),
        (lambda: Tracer(ball, precision=None), "precision"),
        (lambda: tracer.crossings([0, 0, 5], [0, 0, -1], most=-1), "most"),
        (lambda: tracer.crossings([0, 0, 5], [0, 0, -1], most=2**64), "most"),
        (lambda: tracer.crossings([0, 0, 5], [0, 0, -1], most="2"), "most"),
        (lambda: tracer.crossings([0, 0, 5], [0, 0, -1], normals="yes"), "normals"),
        (lambda: tracer.crossings([0, 0, 5], [0, 0, -1], normals_double="yes"), "normals_double"),
        (lambda: tracer.cells(np.zeros(4)), "points"),
        (lambda: tracer.count_crossings(o, d[:3]), "directions"),
        (lambda: tracer.solid_lengths(o, d, t_max=[1, 2]), "t_max"),
    ):
        with pytest.raises(InvalidValue) as error:
            call()
        assert error.value.field == field, str(error.value)


def test_limits_at_hits_in_either_order_of_bytes(crowd):
    """Floats with swapped bytes are floats: each hit is within a limit at its own rounded t."""
    tracer = Tracer(crowd)
    origins, directions = rays(2000)
    hits = tracer.intersect(origins, directions)
    met = hits.hit
    o, d, t, shape = origins[met], directions[met], hits.t[met], hits.shape_id[met]
    swapped = [a.astype(a.dtype.newbyteorder()) for a in (o, d, t)]
    assert np.array_equal(tracer.intersect(o, d, t_max=t).shape_id, shape)
    again = tracer.intersect(swapped[0], swapped[1], t_max=swapped[2])
    assert np.array_equal(again.shape_id, shape) and np.array_equal(again.t, t)
    assert tracer.occluded(swapped[0], swapped[1], t_max=swapped[2]).all()
    # With one array of doubles, all numbers count as doubles. A limit that was rounded is then
    # before about half of the hits.
    assert 0.2 < tracer.intersect(o.astype(">f8"), d, t_max=t).hit.mean() < 0.8


def test_limits_count_as_they_are(ball):
    """A limit in double is not rounded to the rays' floats."""
    tracer = Tracer(ball)
    o, d = np.array([[0, 0, 5]], np.float32), np.array([[0, 0, -1]], np.float32)
    assert not tracer.occluded(o, d, t_max=np.array([4 - 1e-12]))[0]
    assert tracer.occluded(o, d, t_max=np.array([4], np.float32))[0] and tracer.occluded(o, d, t_max=4)[0]
    assert not tracer.occluded(o, d, t_max=np.float64(4 - 1e-12))[0]


def test_hits_may_be_copied(ball):
    tracer = Tracer(ball)
    hits = tracer.intersect([[0, 0, 5]], [0, 0, -1])
    for other in (copy.deepcopy(hits), pickle.loads(pickle.dumps(hits))):
        assert tracer.intersect([[5, 0, 0]], [-1, 0, 0], double=True, out=other) is other
        assert other.normal.tolist() == [[1, 0, 0]] and other.t_double.tolist() == [4.0]
    assert hits.normal.tolist() == [[0, 0, 1]]
    with pytest.raises(AttributeError):
        hits.normal = np.zeros((1, 3))
    assert tracer.crossings([0, 0, 5], [0, 0, -1]) != tracer.crossings([0, 0, 5], [0, 0, -1])  # no comparison of arrays


def test_whatever_the_rounding_of_the_process(ball):
    """For example, a library that was built with -ffast-math may have disabled denormal numbers for the process."""
    import ctypes
    import ctypes.util

    libm = ctypes.CDLL(ctypes.util.find_library("m"))
    origins, directions = rays(20_000)
    expected = Tracer(ball, 1).intersect(origins, directions, double=True)
    tracer = Tracer(ball, 3)
    try:
        assert libm.fesetround(0x800) == 0  # upward
        first = tracer.intersect(origins, directions, double=True)
    finally:
        libm.fesetround(0)
    for hits in (first, tracer.intersect(origins, directions, double=True)):
        assert np.array_equal(hits.t_double, expected.t_double) and np.array_equal(hits.normal, expected.normal)


def test_precisions(crowd):
    origins, directions = rays(2000)
    exact = Tracer(crowd).intersect(origins, directions)
    for precision in ("fast", "robust", "double"):
        hits = Tracer(crowd, precision=precision).intersect(origins, directions)
        assert (hits.shape_id == exact.shape_id).mean() > 0.99


def test_the_interpreter_goes_on_meanwhile(crowd):
    """Calls release the interpreter's lock, and several threads may use one tracer."""
    tracer = Tracer(crowd, 1)
    origins, directions = rays(100_000)
    expected = tracer.intersect(origins, directions).t
    may_run, has_run = threading.Event(), threading.Event()

    def run():
        may_run.wait()
        has_run.set()

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e6)  # a thread waits until another one releases the lock
    try:
        other = threading.Thread(target=run)
        other.start()
        may_run.set()
        while not has_run.is_set():
            tracer.intersect(origins, directions)
        other.join()
    finally:
        sys.setswitchinterval(interval)
    found = []
    threads = [
        threading.Thread(target=lambda: found.append(tracer.intersect(origins, directions).t)) for _ in range(3)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 3 and all(np.array_equal(t, expected) for t in found)


def test_finite_doubles_of_any_size_are_traced():
    builder = raylane.SceneBuilder()
    builder.add_spheres([[0, 0, 0]], 1.0, material=builder.add_material())
    tracer = Tracer(builder.build())
    for k in range(107, 1070, 107):
        tiny = 2.0**-k * 0.7
        for o, d in (([[tiny, 0, 5]], [0, 0, -1]), ([[0, 0, 5]], [tiny, 0, -7.0]), ([[0, 0, 5]], [0, 0, -tiny])):
            hits = tracer.intersect(o, np.array(d, float), t_max=np.float64(np.inf))
            assert hits.hit[0] and tracer.occluded(o, d)[0], (k, o, d)
            rows = tracer.crossings(o, np.array(d, float))
            assert rows.shape_id.tolist() == [0, 0] and rows.t[0] == hits.t[0]
            assert hits.t[0] == pytest.approx(4 / np.abs(d).max())
            assert tracer.path_lengths(o, np.array(d, float)).total()[0] == pytest.approx(2, rel=1e-15)
    # Which side of x = 0 decides whether a line meets the ball that x = 0 touches.
    builder = raylane.SceneBuilder()
    builder.add_spheres([[1, 0, 0]], 1.0, material=builder.add_material())
    touched = Tracer(builder.build())
    x = np.array([-5e-324, -1e-200, 0.0, 5e-324, 1e-200])
    origins = np.stack([x, 0 * x, 0 * x + 5], 1)
    assert touched.crossings(origins, [0, 0, -1]).counts().tolist() == [0, 0, 2, 2, 2]
    assert touched.occluded(origins, [0, 0, -1]).tolist() == [False, False, True, True, True]


def test_refused_rays_are_counted(ball):
    tracer = Tracer(ball)
    o = np.array([[0, 0, 5], [0, np.nan, 5], [0, 0, 5], [0, 0, 5]], float)
    d = np.array([[0, 0, -1], [0, 0, -1], [0, 0, 0], [0, 0, np.inf]], float)
    calls = (tracer.intersect, tracer.occluded, tracer.crossings, tracer.path_lengths, tracer.solid_lengths)
    for call in (*calls, tracer.count_crossings):
        for dtype in (np.float32, np.float64):
            with pytest.warns(RuntimeWarning, match="^3 rays are refused") as warned:
                call(o.astype(dtype), d.astype(dtype))
            assert len(warned) == 1 and warned[0].filename == __file__
        with pytest.warns(RuntimeWarning, match="^4 rays"):
            call(o, d, t_min=np.nan)
        with pytest.warns(RuntimeWarning, match="^1 ray is refused, and hits nothing: a component"):
            call(o[:2], d[:2])
    for ask in (tracer.contains, tracer.cells):
        with pytest.warns(RuntimeWarning, match="^1 point is refused, and is in no solid: a coordinate") as warned:
            ask(o)
        assert len(warned) == 1 and warned[0].filename == __file__
        with pytest.warns(RuntimeWarning, match="^2 points are refused, and are in no solid: a coordinate"):
            ask(o[[1, 1]])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tracer.intersect(o[:1], d[:1], t_min=2.0, t_max=1.0)  # an interval without t is no fault


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_limits_compare_t_as_it_is_returned(crowd, dtype):
    tracer = Tracer(crowd, 1)
    o, d = rays(3000, dtype, 7)
    hits = tracer.intersect(o, d, double=True)
    assert hits.t.dtype == dtype and hits.t_double.dtype == np.float64
    o, d, t = o[hits.hit], d[hits.hit], hits.t[hits.hit]
    assert len(t) > 500
    limits = [t, t.astype(np.float64)] + ([hits.t_double[hits.hit]] if dtype == np.float64 else [])
    for limit in limits:
        behind = tracer.intersect(o, d, t_min=limit)
        assert (behind.t > t).all()
        assert np.array_equal(tracer.intersect(o, d, t_max=limit).t, t)
        assert tracer.occluded(o, d, t_max=limit).all()
        assert not tracer.occluded(o, d, t_max=np.nextafter(t, dtype(0))).any()
    # Step by step, each crossing is found once.
    rows = tracer.crossings(o[:100].astype(np.float64), d[:100].astype(np.float64))
    after, found = np.zeros(100), [[] for _ in range(100)]
    while True:
        step = tracer.intersect(o[:100].astype(np.float64), d[:100].astype(np.float64), t_min=after)
        if not step.hit.any():
            break
        for i in np.flatnonzero(step.hit):
            found[i].append(step.t[i])
        after = np.where(step.hit, step.t, np.inf)
    for i in range(100):
        assert found[i] == list(dict.fromkeys(rows.t[rows.first[i] : rows.first[i + 1]]))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_rays_go_on_from_hits(crowd, dtype):
    tracer = Tracer(crowd)
    o, d = rays(2000, dtype, 3)
    hits = tracer.intersect(o, d)
    away = rays(2000, dtype, 4)[1]
    points, leaving = hits.onward(away)
    assert points.dtype == dtype and points.shape == (2000, 3)
    assert np.isnan(points[~hits.hit]).all() and np.isfinite(points[hits.hit]).all()
    with pytest.warns(RuntimeWarning, match=f"^{(~hits.hit).sum()} rays"):
        after = tracer.intersect(points, away, leaving=leaving)
    here = hits.hit
    side = np.einsum("ij,ij->i", hits.normal, away) < 0
    clear = here & (np.abs(np.einsum("ij,ij->i", hits.normal, away)) > 1e-6 * np.linalg.norm(away, axis=1))
    assert clear.sum() > 0.99 * here.sum() and np.array_equal(leaving.inward[clear], side[clear])
    # Without a side, the direction decides; where it is nearly a tangent, both may differ.
    steep = here & (np.abs(np.einsum("ij,ij->i", hits.normal, away)) > 1e-3 * np.linalg.norm(away, axis=1))
    given = tracer.intersect(points[steep], away[steep], leaving=Leaving(hits.shape_id[steep], hits.face[steep]))
    assert np.array_equal(given.t, after.t[steep]) and np.array_equal(given.shape_id, after.shape_id[steep])
    with pytest.raises(ValueError):
        Hits(3).onward([0, 0, 1])


def test_a_tangent_goes_to_the_side_that_exact_arithmetic_finds():
    builder = raylane.SceneBuilder()
    material = builder.add_material()
    below, ball = raylane.Solid.half_space([0, 0, 0], [1, 2, 3]), raylane.Solid.sphere([0, 0, 0], 50)
    builder.add_solid(below & ball, material=material)
    tracer = Tracer(builder.build())
    off = np.array([-(2.0**-40), 0, 2.0**-40])
    away = np.array([[2.0, -1, 0], [3, 0, -1], [0, 3, -2], [-2, 1, 0]])[:, None] + off[:, None] * [1.0, 0, 0]
    hits = tracer.intersect(np.array([0, 0, 55.0]), np.array([0, 0, -1.0]) + 0 * away)
    points, leaving = hits.onward(away)
    assert (leaving.inward == 2).all()
    assert (hits.onward([0, 0, 1.0])[1].inward == 0).all() and (hits.onward([0, 0, -1.0])[1].inward == 1).all()
    inside = tracer.path_lengths(points, away, leaving=leaving).total().reshape(4, 3)
    assert np.array_equal(inside > 0, np.broadcast_to(off < 0, (4, 3)))


def test_normals_in_double(crowd):
    tracer = Tracer(crowd)
    for dtype in (np.float32, np.float64):
        o, d = rays(3000, dtype, 11)
        hits = tracer.intersect(o, d, normals_double=True)
        assert hits.normal_double.dtype == np.float64 and hits.normal_double.shape == (3000, 3)
        assert np.abs(hits.normal_double - hits.normal).max() <= 2.0**-25
        assert np.abs(np.linalg.norm(hits.normal_double[hits.hit], axis=1) - 1).max() < 4e-16
        assert not hits.normal_double[~hits.hit].any()
        assert tracer.intersect(o, d).normal_double is None
        some = hits[hits.hit]
        assert np.array_equal(some.normal_double, hits.normal_double[hits.hit])
        rows = tracer.crossings(o, d, normals_double=True)
        assert rows.normal is None and rows.normal_double.shape == (len(rows.t), 3)
        first = rows.first[:-1][hits.hit].astype(int)
        assert np.array_equal(rows.normal_double[first], some.normal_double)
        assert np.array_equal(tracer.crossings(o, d, most=1, normals_double=True).normal_double, some.normal_double)
        # Arrays that are filled again get the normals in double, and keep them.
        out = Hits(3000)
        for asked in (True, False):
            tracer.intersect(o, d, normals_double=asked, out=out)
            assert np.array_equal(out.normal_double, hits.normal_double)
    ball = raylane.SceneBuilder()
    ball.add_spheres([0, 0, 0], 1, material=ball.add_material())
    hit = Tracer(ball.build()).intersect(np.array([0.1, 0, 5]), np.array([0, 0, -1.0]), normals_double=True)
    assert hit.normal_double.tolist() == [0.1, 0, np.sqrt(0.99)]


def test_crossings_are_counted(crowd):
    tracer = Tracer(crowd)
    for order in (np.ascontiguousarray, np.asfortranarray):
        o, d = (order(a) for a in rays(20_000))
        rows = tracer.crossings(o, d, t_min=0.25, t_max=6.0)
        counts = tracer.count_crossings(o, d, t_min=0.25, t_max=6.0)
        assert counts.dtype == np.int64 and np.array_equal(counts, rows.counts()) and counts.max() > 4
    assert tracer.count_crossings(o[:6].reshape(2, 3, 3), d[0]).shape == (2, 3)
    assert tracer.count_crossings(o[0], d[0]).shape == ()
    hits = tracer.intersect(o, d)
    points, leaving = hits.onward(d)
    there = hits.hit
    onward = Leaving(leaving.shape_id[there], leaving.face[there])
    assert np.array_equal(
        tracer.count_crossings(points[there], d[there], leaving=onward),
        tracer.crossings(points[there], d[there], leaving=onward).counts(),
    )


def test_lengths_of_solids_and_from_surfaces(ball):
    tracer = Tracer(ball)
    rows = tracer.solid_lengths([[0, 0, 5], [0, 0.75, 5], [0, 5, 5]], [0, 0, -1], t_max=[np.inf, 5, 9])
    assert rows.shape_id.tolist() == [0, 1, 0] and rows.counts().tolist() == [2, 1, 0]
    assert rows.length.tolist() == [2, 1, np.sqrt(1 - 0.75**2)]
    assert rows.total().tolist() == [3, rows.length[2], 0] and rows.total(1).tolist() == [1, 0, 0]
    # A ray that leaves the outer surface inwards, from a point that is rounded to the outside.
    origin, direction = [[0, 0, 1.00001]], [0, 0, -1.0]
    assert tracer.path_lengths(origin, direction).total(0)[0] == pytest.approx(2, abs=1e-12)
    leaving = Leaving(0, 0, 1)
    for lengths in (tracer.path_lengths, tracer.solid_lengths):
        assert lengths(origin, direction, leaving=leaving).total(0)[0] == pytest.approx(2.00002, abs=1e-12)  # from the exact surface
        assert lengths(origin, [0, 0, 1.0], leaving=Leaving(0, 0, 0)).total().tolist() == [0]
        with pytest.raises(InvalidValue, match="leaving.shape_id/0"):
            lengths([[0, 0, 9.0]], direction, leaving=leaving)
        with pytest.warns(RuntimeWarning, match="^1 ray is refused"):
            assert lengths([[0, 0, 9.0]], direction, t_max=np.nan, leaving=leaving).counts().tolist() == [0]


def test_cells(ball):
    tracer = Tracer(ball)
    points = np.array([[[0, 0, 0.75], [0, 0, 0.25], [0, 0, 3]], [[0, 0, 1], [0, 0, 0.5], [0, 0, -0.5]]])
    cells = tracer.cells(points)
    assert cells.shape_id.tolist() == [[0, 1, NO_SHAPE], [0, 1, 1]]
    assert cells.material.tolist() == [[0, 1, -1], [0, 1, 1]]
    assert cells.on_surface.tolist() == [[False, False, False], [True, True, True]]
    assert tracer.cells([0, 0, 0.75]).shape_id.shape == () and len(tracer.cells(np.empty((0, 3))).material) == 0
    many = np.random.default_rng(1).uniform(-1.2, 1.2, (1 << 18, 3))
    rows, cells = tracer.contains(many), tracer.cells(many)
    inside = rows.counts() > 0
    assert np.array_equal(cells.shape_id[inside], rows.shape_id[rows.first[1:][inside].astype(int) - 1])
    assert (cells.shape_id[~inside] == NO_SHAPE).all()


def test_points_of_faces_follow_the_rule_of_lines():
    builder = raylane.SceneBuilder()
    builder.add_solid(Solid.aligned_box((0, 0, 0), (2, 2, 2)) - Solid.cylinder((1, 1, 0), (0, 0, 2), 0.5))
    tracer = Tracer(builder.build())
    points = [[1.5, 1, 1], [1.75, 1, 1], [2, 1, 1], [1, 1, 1]]  # on the hole, in the box, on the box, in the hole
    solids = tracer.contains(points)
    assert solids.counts().tolist() == [1, 1, 1, 0]
    assert solids.on_surface.tolist() == [True, False, True] and solids.inside.tolist() == [False, True, True]
    assert solids.inside.dtype == bool
    assert tracer.cells(points).shape_id.tolist() == [NO_SHAPE, 0, 0, NO_SHAPE]
    assert tracer.solid_lengths(points, [0, 0, 1]).total().tolist() == [0, 1, 1, 0]


def test_a_ray_must_start_on_the_shape_that_it_leaves(ball):
    tracer = Tracer(ball)
    on, into = np.array([[0, 0, 9.0], [0, 0, 1.0]]), [0, 0, -1]
    shapes = [NO_SHAPE, 0]
    calls = (tracer.intersect, tracer.occluded, tracer.crossings, tracer.path_lengths, tracer.solid_lengths)
    for call in (*calls, tracer.count_crossings):
        for leaving, field in (
            (Leaving(shapes, 0, 0), "leaving.inward/1: must be 1"),
            (Leaving(shapes, 77, 1), "leaving.face/1: must be less than"),
            (Leaving(0, 0, 1), "leaving.shape_id/0: must be a shape that the origin is on"),
        ):
            for order in (np.asarray, np.asfortranarray):
                with pytest.raises(InvalidValue, match=re.escape(field)):
                    call(order(on), into, leaving=leaving)
        call(on, into, leaving=Leaving(shapes, 0, 1))
    # The number is that among all rays, also if they are copied in parts.
    many = np.zeros((20000, 3)) + [0, 0, 1.0]
    many[17000] = [0, 0, 50]
    with pytest.raises(InvalidValue, match="leaving.shape_id/17000:"):
        tracer.intersect(many, into, leaving=Leaving(0, 0))


def test_equal_shapes_stay_apart_if_asked_to():
    for merge in (True, False):
        builder = raylane.SceneBuilder(merge_duplicates=merge)
        builder.add_spheres(np.zeros((3, 3)), 1, material=builder.add_material())
        tracer = Tracer(builder.build())
        every = [0] if merge else [0, 1, 2]
        assert tracer.crossings([[0, 0, 5]], [0, 0, -1.0]).shape_id.tolist() == every * 2
        assert tracer.contains([[0, 0, 0]]).shape_id.tolist() == every
        assert tracer.intersect([[0, 0, 5]], [0, 0, -1.0]).shape_id.tolist() == [0]


def test_a_polygon_must_be_flat():
    builder = raylane.SceneBuilder()
    material = builder.add_material()
    square = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0], [0, 1, 0]]], float)
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    assert len(builder.add_polygon((square @ turn + 3).astype(np.float32), material=material)) == 2
    with pytest.raises(InvalidValue, match="^[01]: must be in one plane"):
        builder.add_polygon(square + [[[0], [0], [0]], [[0], [0.01], [0]]] * np.array([0, 0, 1.0]), material=material)
