#include "raylane/raylane.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <span>
#include <vector>

/// Failures of other programs in double, reported in the field, as rays and shapes. `t` is the
/// value that the report expects or that real arithmetic gives.
using namespace raylane;

namespace {

CrossingRows crossings(const Scene& scene, const double (&from)[3], const double (&along)[3]) {
    const std::span<const double> x(&from[0], 1), y(&from[1], 1), z(&from[2], 1);
    const std::span<const double> dx(&along[0], 1), dy(&along[1], 1), dz(&along[2], 1);
    CrossingRows rows;
    Tracer(scene).crossings(DoubleRaySpan{x, y, z, dx, dy, dz}, rows);
    return rows;
}

template <class Shape>
Scene scene_of(const Shape& shape) {
    SceneBuilder builder;
    builder.add(shape, builder.add_material({}));
    return builder.build();
}

} // namespace

/// Celeritas, cylinders: rays nearly along the axis never left (t infinite), or left at
/// 1370730.96944.
TEST_CASE("Celeritas: a ray nearly along a cylinder leaves it") {
    const Scene scene = scene_of(OpenCylinder{{0, 0, -2e8F}, {0, 0, 4e8F}, 30});
    const struct {
        double slope, t;
    } cases[] = {{1e-5, 1370731.006182}, {1e-6, 13707310.0604622}, {1e-7, 137073100.604486}};
    for (const auto& [slope, t] : cases) {
        const double length = std::sqrt(2.0 * slope * slope + 1.0);
        const CrossingRows rows =
            crossings(scene, {7, 8, 9}, {slope / length, slope / length, 1.0 / length});
        REQUIRE(rows.t.size() == 1);
        CHECK(rows.t[0] == Approx(t).epsilon(1e-12));
        CHECK(rows.entering[0] == 0);
    }
}

/// Celeritas: no crossing was found.
TEST_CASE("Celeritas: a ray nearly along a cylinder about x leaves it") {
    const CrossingRows rows =
        crossings(scene_of(OpenCylinder{{-4e6F, 0, 0}, {8e6F, 0, 0}, 3}), {0.123, 0.345, 0.456},
                  {9.9999999999940814e-1, 4.09517743700767399e-7, 1.00812588415826643e-6});
    REQUIRE(rows.t.size() == 1);
    CHECK(rows.t[0] == Approx(2246088.24926342).epsilon(1e-14));
}

/// Optiland #559: a paraboloid, R = -100, k = -1: the quadratic term of a ray along the axis
/// vanishes.
TEST_CASE("Optiland: a ray along the axis meets a paraboloid once") {
    Quadric paraboloid{}; // x^2 + y^2 + 200 z = 0
    paraboloid.xx = paraboloid.yy = 1;
    paraboloid.z = 100;
    paraboloid.lower = {-20, -20, -3};
    paraboloid.upper = {20, 20, 1};
    const CrossingRows rows = crossings(scene_of(paraboloid), {10, 0, -50}, {0, 0, 1});
    REQUIRE(rows.t.size() == 1);
    CHECK(rows.t[0] == 49.5);
}

/// Optiland #559 again, with a conic constant next to -1: the quadratic term is nearly zero.
TEST_CASE("Optiland: a ray along the axis meets a near paraboloid at the same distance") {
    for (const double k : {std::nextafter(-1.0, 0.0), std::nextafter(-1.0, -2.0)}) {
        QuadricOf<double> conic{}; // x^2 + y^2 + (1 + k) z^2 + 200 z = 0
        conic.xx = conic.yy = 1;
        conic.zz = 1 + k;
        conic.z = 100;
        conic.lower = {-20, -20, -3};
        conic.upper = {20, 20, 1};
        const CrossingRows rows = crossings(scene_of(conic), {10, 0, -50}, {0, 0, 1});
        REQUIRE(rows.t.size() == 1);
        CHECK(rows.t[0] == 49.5);
    }
}

/// Optiland #787: rays hit the wrong one of a hyperboloid's two sheets, at t = 1.3023936.
TEST_CASE("Optiland: rays from a point meet the sheet of a hyperboloid that is a lens") {
    const double radius = 1 / 0.3396, k = -2.5073;
    QuadricOf<double> hyperboloid{}; // x^2 + y^2 + (1 + k) z^2 - 2 R z = 0, z > -1
    hyperboloid.xx = hyperboloid.yy = 1;
    hyperboloid.zz = 1 + k;
    hyperboloid.z = -radius;
    hyperboloid.lower = {-50, -50, -1};
    hyperboloid.upper = {50, 50, 50};
    const Scene scene = scene_of(hyperboloid);
    for (int i = -20; i <= 20; ++i) {
        const double angle = 42.0 / 20 * i * std::acos(-1.0) / 180;
        const CrossingRows rows =
            crossings(scene, {0, 0, -5}, {0, std::sin(angle), std::cos(angle)});
        REQUIRE(rows.t.size() == 1);
        const double y = rows.t[0] * std::sin(angle), z = rows.t[0] * std::cos(angle) - 5;
        CHECK(z >= 0.0);
        CHECK(std::abs(y * y + (1 + k) * z * z - 2 * radius * z) < 1e-13 * (1 + y * y));
        if (i != -20) continue;
        CHECK(rows.t[0] == Approx(16.4386329).epsilon(1e-8));
        CHECK(z == Approx(7.2163).epsilon(1e-5));
    }
}

/// optika #224: a ray that starts on a paraboloid of f = -0.65, 76 from its axis, was moved to its
/// exit, 1662.7455 further on.
TEST_CASE("optika: a ray next to a paraboloid meets it there") {
    QuadricOf<double> paraboloid{}; // x^2 + y^2 - 4 f z = 0
    paraboloid.xx = paraboloid.yy = 1;
    paraboloid.z = -2 * -0.65;
    paraboloid.lower = {-100, -100, -4000};
    paraboloid.upper = {100, 100, 1};
    const Scene scene = scene_of(paraboloid);
    const double angle = -3.94 * std::acos(-1.0) / 180, x = 76, z = 76.0 * 76 / (4 * -0.65);
    const double along[3] = {std::sin(angle), 0, std::cos(angle)};
    const CrossingRows rows = crossings(scene, {x - along[0], 0, z - along[2]}, along);
    REQUIRE(rows.t.size() == 2);
    CHECK(rows.t[0] == Approx(1.0).epsilon(1e-11));
    CHECK(rows.t[1] == Approx(1.0 + 1662.7455).epsilon(1e-7));
}

/// OpenMC #260: two equal cylinders of different cells.
TEST_CASE("OpenMC: a ray meets equal cylinders at one point") {
    SceneBuilder builder;
    const CappedCylinderOf<double> pin{{0.1, 0.2, -3}, {0, 0, 6}, 0.7};
    builder.add(pin, builder.add_material({}));
    builder.add(pin, builder.add_material({}));
    const CrossingRows rows = crossings(builder.build(), {-5, 0.3, 0.4}, {1, 0.01, -0.02});
    CHECK(rows.shape_id == std::vector<ShapeId>{0, 1, 0, 1});
    CHECK(rows.tied == std::vector<std::uint8_t>{0, 1, 0, 1});
    REQUIRE(rows.t.size() == 4);
    CHECK(rows.t[0] == rows.t[1]);
    CHECK(rows.t[2] == rows.t[3]);
}

/// OpenMC #81, in which a coincidence tolerance of 1e-12 decides which comes first. Here the
/// decision is exact.
TEST_CASE("OpenMC: a sphere and a plane that a ray meets at one point are tied") {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    builder.add(Sphere{{0, 0, 0}, 2.5F}, material);
    builder.add(OpenCylinder{{0, 0, -8}, {0, 0, 16}, 4}, material);
    builder.add(Plane{{0, 0, 1.5F}, {0, 0, 1}}, material);
    builder.add(Plane{{0, 0, -1.5F}, {0, 0, 1}}, material);
    const Scene scene = builder.build();
    const CrossingRows rows = crossings(scene, {0, 0, 0}, {4, 0, 3});
    CHECK(rows.t == std::vector<double>{0.5, 0.5, 1.0});
    CHECK(rows.shape_id == std::vector<ShapeId>{0, 2, 1});
    CHECK(rows.tied == std::vector<std::uint8_t>{0, 1, 0});
    // An ulp steeper, the plane comes first.
    const CrossingRows beside = crossings(scene, {0, 0, 0}, {4, 0, std::nextafter(3.0, 4.0)});
    CHECK(beside.t == std::vector<double>{std::nextafter(0.5, 0.0), 0.5, 1.0});
    CHECK(beside.shape_id == std::vector<ShapeId>{2, 0, 1});
    CHECK(beside.tied == std::vector<std::uint8_t>{0, 0, 0});
}
