#include "tests/meetings/gathering.hpp"
#include "tests/scenes/api/exam_in_double.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <cmath>
#include <limits>

/// Tests of rays whose doubles are far outside of the range of floats, against the oracle.
using namespace raylane;
using namespace raylane::tests;
using core::Vec3d;

namespace {

constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// Returns shapes of all kinds with faces, edges, rims, tips or tangent planes at the origin. There
/// a coordinate of any size decides.
std::vector<AnyShapeInDouble> shapes_at_origin() {
    using core::Ends;
    return {
        core::SphereOf<double>{{1, 0, 0}, 1},
        core::SphereOf<double>{{0, 0, 3}, 1},
        core::EllipsoidOf<double>{{0, 2, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 1}},
        core::PlaneOf<double>{{0, 0, -2}, {0, 0, 1}},
        core::PlaneOf<double>{{0, 0, 0}, {0, -1, 1}},
        core::DiscOf<double>{{-1, 0, 1}, {0, 0, 1}, 1},
        core::TriangleOf<double>{{0, 0, 2}, {-2, 0, 2}, {0, -2, 2}},
        core::SmoothTriangleOf<double>{
            {0, 0, 4}, {2, 0, 4}, {0, 2, 5}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
        core::BoxOf<double>{{0, 0, -1}, {-2, 0, 0}, {0, -2, 0}, {0, 0, 1}},
        core::CylinderOf<double, Ends::open>{{0, 1, -1}, {0, 0, 2}, 1},
        core::CylinderOf<double, Ends::capped>{{-1, 0, 0}, {0, 0, 2}, 1},
        core::ConeOf<double, Ends::open>{{0, 0, 2}, {0, 0, -2}, 1, 0},
        core::ConeOf<double, Ends::capped>{{0, 0, -2}, {0, 0, 2}, 1, 0},
        core::QuadricOf<double>{{0, 0, 0}, 1, 1, 0, 0, 0, 0, 0, 0, -1, 0, {-2, -2, -2}, {2, 2, 2}},
        core::QuadricOf<double>{{0, 0, 0}, 1, -1, 0, 0, 0, 0, 0, 0, 0, 0, {-2, -2, -2}, {2, 2, 2}},
    };
}

double sign_of(Random& random) {
    return random.integer(0, 1) == 0 ? -1.0 : 1.0;
}

/// Returns a number that no float has for its size.
double tiny(Random& random, double most) {
    const int way = random.integer(0, 3);
    return sign_of(random) * (way == 0   ? smallest * random.integer(1, 3)
                              : way == 1 ? random.log_uniform(0x1p-1074, 0x1p-1000)
                                         : random.log_uniform(0x1p-1000, most));
}

/// Changes some components of a ray, or all of its direction, to numbers beyond the range of
/// floats.
core::Ray<double> changed(core::Ray<double> ray, Random& random) {
    const int way = random.integer(0, 6);
    for (int axis = 0; axis < 3; ++axis) {
        double &o = ray.origin[axis], &d = ray.direction[axis];
        if ((way == 0 || way == 3) && (o == 0.0 || random.integer(0, 2) == 0))
            o = tiny(random, 0x1p-150);
        if ((way == 1 || way == 3) && (d == 0.0 || random.integer(0, 3) == 0))
            d = tiny(random, 0x1p-280);
    }
    if (way == 2 || way == 4) { // a direction of any length
        const int exponent = random.integer(-1060, 1020);
        for (int axis = 0; axis < 3; ++axis)
            ray.direction[axis] = std::ldexp(ray.direction[axis], exponent);
    }
    if (way == 4 || way == 5) { // one component of another size
        double& d = ray.direction[random.integer(0, 2)];
        d = random.integer(0, 1) == 0 ? tiny(random, 0x1p-150) : sign_of(random) * 0x1p1000;
    }
    if (way == 6) { // from far away, along an axis
        const int along = random.integer(0, 2);
        ray.direction = Vec3d(0.0);
        ray.direction[along] = sign_of(random) * random.log_uniform(0x1p-1074, 0x1p1000);
        ray.origin[along] =
            -std::copysign(random.log_uniform(0x1p128, 0x1p1023), ray.direction[along]);
    }
    if (ray.direction == Vec3d(0.0)) ray.direction.x = smallest;
    return ray;
}

core::Ray<double> lattice_ray(Random& random) {
    core::Ray<double> ray;
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = random.integer(-3, 3) * random.integer(0, 1);
        ray.direction[axis] = random.integer(-1, 1);
    }
    return ray;
}

void check(const DoubleFaults& faults) {
    CAPTURE(faults.rays, faults.hits, faults.shape, faults.t, faults.t_double, faults.side,
            faults.normal, faults.occlusion, faults.crossings, faults.first);
    CHECK(faults.all() == 0);
}

} // namespace

TEST_CASE("rays of tiny and huge doubles have the answers of real arithmetic", "[meetings]") {
    Random random(seed(20261129));
    const std::vector<AnyShapeInDouble> shapes = shapes_at_origin();
    DoubleFaults of_each, of_all;
    for (int round = 0; round < rounds(2, 1); ++round) {
        for (const AnyShapeInDouble& shape : shapes) {
            std::vector<core::Ray<double>> rays;
            for (int i = 0; i < 30; ++i)
                rays.push_back(changed(lattice_ray(random), random));
            ask(std::vector{shape}, rays, of_each);
        }
        std::vector<core::Ray<double>> rays;
        for (int i = 0; i < 120; ++i)
            rays.push_back(changed(lattice_ray(random), random));
        ask(shapes, rays, of_all);
    }
    check(of_each);
    check(of_all);
    CHECK(of_each.hits > of_each.rays / 4);
    CHECK(of_all.hits > of_all.rays / 4);
}

TEST_CASE("rays of tiny and huge doubles are exact where shapes meet", "[meetings]") {
    Random random(seed(20261130));
    DoubleFaults faults;
    for (int round = 0; round < rounds(1, 1); ++round)
        for (const meetings::Kind& kind : meetings::gatherings) {
            if (kind.least > 60) continue;
            const meetings::Meeting meeting = kind.make(kind.least, random, 12);
            std::vector<core::Ray<double>> rays;
            for (const core::Ray<float>& ray : meeting.rays)
                rays.push_back(changed(
                    {core::convert<double>(ray.origin), core::convert<double>(ray.direction)},
                    random));
            ask(meeting.shapes, rays, faults);
        }
    check(faults);
    CHECK(faults.hits > 100);
}

TEST_CASE("a direction's power of two scales t alone") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene);
    DoubleRays rays, scaled;
    for (std::size_t i = 0; i < setup.rays.size() && i < 400; ++i) {
        core::Ray<double> ray = setup.rays.ray(i);
        rays.add(ray, 0.0, endless);
        for (int axis = 0; axis < 3; ++axis)
            ray.direction[axis] = std::ldexp(ray.direction[axis], -700);
        scaled.add(ray, 0.0, endless);
    }
    const DoubleAnswers expected(tracer, rays), found(tracer, scaled);
    CHECK(found.hits.shape == expected.hits.shape);
    CHECK(found.hits.nx == expected.hits.nx);
    CHECK(found.blocked == expected.blocked);
    CHECK(found.rows.shape_id == expected.rows.shape_id);
    for (std::size_t i = 0; i < found.rows.t.size(); ++i)
        CHECK(found.rows.t[i] == std::ldexp(expected.rows.t[i], 700));
    LengthRows lengths, as_expected;
    tracer.path_lengths(scaled.span(), lengths);
    tracer.path_lengths(rays.span(), as_expected);
    REQUIRE(lengths.first == as_expected.first);
    for (std::size_t i = 0; i < lengths.length.size(); ++i)
        CHECK(lengths.length[i] == Approx(as_expected.length[i]).epsilon(0x1p-52));
}

TEST_CASE("lengths of rays of tiny and huge doubles are those of real arithmetic") {
    Random random(seed(20261131));
    for (const AnyShapeInDouble& shape : shapes_at_origin()) {
        const bool is_solid = std::visit(
            []<class Shape>(const Shape&) { return core::is_solid<core::InFloat<Shape>>; }, shape);
        if (!is_solid) continue;
        const Tracer tracer(scene_of(std::vector{shape}), {.threads = 1});
        const oracle::Neighbours neighbours(std::vector{shape});
        DoubleRays rays;
        std::vector<oracle::Number> expected;
        for (int i = 0; i < 60; ++i) {
            const core::Ray<double> ray = changed(lattice_ray(random), random);
            const oracle::Sight sight(std::vector{shape}, neighbours, ray,
                                      [](ShapeId, bool) { return true; });
            oracle::Number t = 0, last = 0;
            for (const oracle::Found& found : sight.all()) {
                t += found.hit.entering ? -found.hit.t : found.hit.t;
                last = found.hit.t;
            }
            const bool is_touched =
                sight.all().size() == 2 && compare(sight.all()[0].hit, sight.all()[1].hit) == 0;
            if (is_touched) t = 0;
            if (!is_touched && last > 0 && t < last * 1e-60) continue; // the digits cancel
            rays.add(ray, 0.0, endless);
            const oracle::Vector d = oracle::vector(ray.direction);
            expected.push_back(t * sqrt(oracle::Number(oracle::inner(d, d))));
        }
        LengthRows lengths;
        tracer.path_lengths(rays.span(), lengths);
        CHECK(rays.size() > 20);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            CAPTURE(shape.index(), rays.origin[0][i], rays.origin[1][i], rays.origin[2][i],
                    rays.direction[0][i], rays.direction[1][i], rays.direction[2][i], expected[i]);
            const bool is_inside = lengths.first[i + 1] != lengths.first[i];
            REQUIRE(is_inside == (expected[i] > 0));
            if (!is_inside) continue;
            const oracle::Number off =
                oracle::Number(lengths.length[lengths.first[i]]) - expected[i];
            CHECK(abs(off) <= expected[i] * oracle::Number(0x1p-52) + oracle::Number(smallest));
        }
    }
}
