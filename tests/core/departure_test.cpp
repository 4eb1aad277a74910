#include "core/shapes/departure.hpp"
#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"
#include "tests/oracle/first_hit.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;
using ray_sets::Set;

/// Rays that start on a surface: solvers skip the start instead of finding it again.
namespace {

/// A ray's hit point on a shape, in double: at most `error` off the surface.
struct Hitpoint {
    Vec3d point;
    Vec3d normal;
    Face face;
    double error;
};

/// Returns the first crossing ahead of the origin if the ray enters there.
template <class Shape>
std::optional<Hitpoint> hit(const Shape& shape, const Ray<float>& aimed) {
    const Ray<double> ray{convert<double>(aimed.origin),
                          normalized(convert<double>(aimed.direction))};
    std::uint64_t widened = 0;
    for (const Crossing<double>& crossing : solve(shape, ray, Start{}, widened)) {
        if (!(crossing.t > 0.0)) continue;
        if (!crossing.entering) return std::nullopt;
        const Vec3d point = mul_add(crossing.t, ray.direction, ray.origin);
        const double rounding = 0x1p-51 * (length(ray.origin) + crossing.t);
        return Hitpoint{point, outward_normal(shape, point, crossing.face), crossing.face,
                        crossing.error + rounding};
    }
    return std::nullopt;
}

/// Visits points that rays of each set but `far` hit on random shapes.
template <class Shape, class Visit>
void for_each_hitpoint(int shapes, Random& random, const Visit& visit) {
    for (int i = 0; i < shapes; ++i) {
        const bool lattice = i % 2 == 1;
        const Shape shape = ray_sets::Target<Shape>::make(random, lattice);
        for (const Set set : ray_sets::all_sets) {
            if ((set == Set::lattice) != lattice || set == Set::far) continue;
            if (const auto at = hit(shape, ray_sets::make_ray(shape, set, random)))
                visit(shape, *at);
        }
    }
}

/// Returns a random inward direction, from steep to almost along the surface.
Vec3d inward_direction(const Vec3d& normal, Random& random) {
    Vec3d direction = random.direction();
    if (dot(direction, normal) > 0.0) direction = -direction;
    if (random.integer(0, 2) != 0) return direction;
    const double flattened = 1.0 - random.log_uniform(1e-6, 1.0);
    return normalized(Vec3d(direction - normal * (flattened * dot(direction, normal))));
}

double to_double(const oracle::Number& number) {
    return number.template convert_to<double>();
}

/// Returns the tolerance for t of a ray whose origin is `at.error` off the surface. It grows as the
/// ray gets closer to the surface's plane.
double tolerance(const Hitpoint& at, const Vec3d& direction, double t) {
    return 4.0 * at.error / std::abs(dot(at.normal, direction)) + needed_accuracy * t;
}

#ifdef RAYLANE_FEW_RAYS
constexpr int shape_count = 100;
#else
constexpr int shape_count = 1000;
#endif

} // namespace

TEMPLATE_LIST_TEST_CASE("a ray that enters a solid leaves it at the oracle's point and face", "",
                        tests::AllSolids) {
    using Shape = TestType;
    CAPTURE(name_of(kind_of<Shape>));
    Random random(20260400 + static_cast<int>(kind_of<Shape>));
    std::uint64_t widened = 0;
    int starts = 0, lost = 0, misplaced = 0, wrong_face = 0;
    for_each_hitpoint<Shape>(shape_count, random, [&](const Shape& shape, const Hitpoint& at) {
        const Vec3d direction = inward_direction(at.normal, random);
        const Ray<double> ray{at.point, direction};
        const Crossings<double> found = solve(shape, ray, Start{true, at.face, true}, widened);
        ++starts;
        const bool one = found.end() - found.begin() == 1;
        if (!one || found.begin()->entering) {
            if (lost++ < 3)
                UNSCOPED_INFO("lost from face " << int{at.face} << ", cosine "
                                                << dot(at.normal, direction));
            return;
        }
        const Crossing<double>& exit = *found.begin();

        double truth = 0.0; // the point may be slightly outside, and the ray may miss the solid
        for (const oracle::Hit& hit : oracle::crossings(shape, ray))
            truth = std::max(truth, to_double(hit.t));
        const double allowed = tolerance(at, direction, truth);
        if (!(std::abs(exit.t - truth) <= allowed) && misplaced++ < 3)
            UNSCOPED_INFO("from face " << int{at.face} << " to face " << int{exit.face} << " at "
                                       << exit.t << " instead of " << truth);

        const Vec3d end = mul_add(exit.t, direction, at.point);
        const bool on_face = tests::distance_to_face(shape, exit.face, end) <=
                             allowed + at.error + 1e-14 * length(end);
        if (!on_face && wrong_face++ < 3)
            UNSCOPED_INFO("from face " << int{at.face} << " not to face " << int{exit.face});
    });
    CHECK(lost == 0);
    CHECK(misplaced == 0);
    CHECK(wrong_face == 0);
    CHECK(starts > shape_count);
}

TEMPLATE_LIST_TEST_CASE("a ray that leaves a solid does not meet it again", "", tests::AllSolids) {
    using Shape = TestType;
    CAPTURE(name_of(kind_of<Shape>));
    Random random(20260500 + static_cast<int>(kind_of<Shape>));
    std::uint64_t widened = 0;
    int starts = 0, met = 0;
    for_each_hitpoint<Shape>(shape_count, random, [&](const Shape& shape, const Hitpoint& at) {
        const Ray<double> ray{at.point, -inward_direction(at.normal, random)};
        const Crossings<double> found = solve(shape, ray, Start{true, at.face, false}, widened);
        ++starts;
        met += found.begin() != found.end() ? 1 : 0;
    });
    CHECK(met == 0);
    CHECK(starts > shape_count);
}

TEMPLATE_LIST_TEST_CASE("a ray that leaves a flat surface does not meet it again", "",
                        tests::AllFlat) {
    using Shape = TestType;
    CAPTURE(name_of(kind_of<Shape>));
    Random random(20260600 + static_cast<int>(kind_of<Shape>));
    std::uint64_t widened = 0;
    int starts = 0, met = 0;
    for_each_hitpoint<Shape>(shape_count, random, [&](const Shape& shape, const Hitpoint& at) {
        const Vec3d inward = inward_direction(at.normal, random);
        for (const bool goes_inside : {true, false}) {
            const Ray<double> ray{at.point, goes_inside ? inward : -inward};
            const auto found = solve(shape, ray, Start{true, at.face, goes_inside}, widened);
            ++starts;
            met += found.begin() != found.end() ? 1 : 0;
        }
    });
    CHECK(met == 0);
    CHECK(starts > shape_count / 4);
}

// A ray that leaves a bowl's inside may meet the bowl again. On a hyperboloid, rays from its
// outside may do so, too.
TEMPLATE_LIST_TEST_CASE(
    "a ray that leaves a curved surface meets the rest of it where the oracle does", "",
    tests::AllCurved) {
    using Shape = TestType;
    CAPTURE(name_of(kind_of<Shape>));
    Random random(20260700 + static_cast<int>(kind_of<Shape>));
    std::uint64_t widened = 0;
    int starts = 0, wrong = 0;
    std::array<int, 2> met = {0, 0};
    for_each_hitpoint<Shape>(shape_count, random, [&](const Shape& shape, const Hitpoint& at) {
        const Vec3d inward = inward_direction(at.normal, random);
        // Along the surface, or next to an apex, the start and the second crossing coincide.
        if (!(dot(at.normal, inward) < -0.01)) return;
        for (const bool goes_inside : {true, false}) {
            const Vec3d direction = goes_inside ? inward : -inward;
            const Ray<double> ray{at.point, direction};
            const auto found = solve(shape, ray, Start{true, at.face, goes_inside}, widened);
            ++starts;

            std::optional<oracle::Hit> truth;
            for (const oracle::Hit& hit : oracle::crossings(shape, ray))
                if (to_double(hit.t) > 1e-6) truth = hit;
            const bool any = found.begin() != found.end() && found.begin()->t > 1e-6;
            met[goes_inside] += any ? 1 : 0;
            const double t = truth ? to_double(truth->t) : 0.0;
            const bool right =
                any == truth.has_value() &&
                (!any || (found.begin()->entering == truth->entering &&
                          std::abs(found.begin()->t - t) <= tolerance(at, direction, t)));
            if (!right && wrong++ < 3)
                UNSCOPED_INFO((goes_inside ? "inward to " : "outward to ")
                              << (any ? found.begin()->t : -1.0) << " instead of "
                              << (truth ? t : -1.0));
        }
    });
    CHECK(wrong == 0);
    CHECK(starts > shape_count / 2);
    CHECK(met[true] > starts / 20);
    if (tests::Nature<Shape>::may_come_back) CHECK(met[false] > starts / 100);
}

// Rounding may turn a ray that was sent inward along a face outward by a tiny angle. The ray must
// still not leave through the face that it starts on.
TEMPLATE_TEST_CASE("a ray along a flat face leaves the solid at the far end", "", float, double) {
    using Real = TestType;
    const Box box{{-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    const CappedCylinder cylinder{{0, 0, 0}, {0, 2, 0}, 1};
    const CappedCone cone{{0, 0, 0}, {0, 2, 0}, 1, 2};
    const auto end_of = [](const auto& shape, bool top, Face face, Real hair) {
        std::uint64_t widened = 0;
        const Ray<Real> ray{{Real(-0.5), Real(top ? 2 : 0), Real(0)},
                            {Real(1), top ? hair : -hair, Real(0)}};
        const Crossings<Real> found = solve(shape, ray, Start{true, face, true}, widened);
        REQUIRE(found.end() - found.begin() == 1);
        CHECK_FALSE(found.begin()->entering);
        return static_cast<double>(found.begin()->t);
    };
    for (const Real hair : {Real(-1e-12), Real(1e-12)}) {
        CHECK(end_of(box, false, 2, hair) == Approx(1.5));
        CHECK(end_of(box, true, 3, hair) == Approx(1.5));
        CHECK(end_of(cylinder, false, base_cap, hair) == Approx(1.5));
        CHECK(end_of(cylinder, true, top_cap, hair) == Approx(1.5));
        CHECK(end_of(cone, false, base_cap, hair) == Approx(1.5));
        CHECK(end_of(cone, true, top_cap, hair) == Approx(2.5));
    }
}

TEMPLATE_TEST_CASE("a departure that few operations decide is the one of all digits", "", Sphere,
                   OpenCylinder, CappedCylinder, OpenCone, CappedCone, Ellipsoid, Box, Disc, Plane,
                   Triangle, SmoothTriangle) {
    Random random(47);
    int asked = 0, clear = 0, tangents = 0, off = 0;
    for_each_hitpoint<TestType>(
        shape_count, random, [&](const TestType& shape, const Hitpoint& at) {
            const Vec3d inward = inward_direction(at.normal, random);
            const Vec3d tangent = cross(at.normal, random.direction());
            const Vec3d beside = at.point + random.log_uniform(1e-17, 10.0) * random.direction();
            const Ray<double> rays[] = {
                {at.point, inward},           {at.point, -1e30 * inward},
                {at.point, tangent},          {at.point, 0x1p-149 * tangent},
                {beside, random.direction()}, {beside, 1e-200 * inward}};
            for (const Ray<double>& ray : rays) {
                const double share = random.integer(0, 1) == 0 ? 0x1p-6 : 0x1p-10;
                const int side = clear_side_of_departure(to_doubles(shape), ray, at.face, share);
                asked += &ray < rays + 2 ? 1 : 0;
                clear += &ray < rays + 2 && side != 0 ? 1 : 0;
                tangents += (&ray == rays + 2 || &ray == rays + 3) && side == 0 ? 1 : 0;
                if (side == 0) continue;
                off += &ray >= rays + 4 ? 1 : 0;
                CHECK(side_of_departure(to_doubles(shape), ray, at.face) == side);
                CHECK(may_start_on(to_doubles(shape), ray.origin, at.face, share));
            }
        });
    CHECK(clear > 0.98 * asked);
    CHECK(tangents > 0);
    CHECK(off > 0);
}

TEMPLATE_TEST_CASE("few operations leave departures at a cone's tip open", "", OpenCone,
                   CappedCone) {
    const InDouble<TestType> cone{{0, 0, 0}, {0, 0, 1}, 0.0, 1.0};
    CHECK(clear_side_of_departure(cone, {{1e-170, 0, 0}, {-1, 0, 0}}, body, 0x1p-6) == 0);
    // The true width is below 0, the computed one is that of the last bit of the height.
    const InDouble<TestType> wide{
        {0, 0, 0}, {1.2890441417694092, 0, 0.13700653612613678}, 65536.0, 0.0};
    const Ray<double> beyond{{0x1.49fecc0000140p+0, 0x1.fdcf4c1b8e899p-38, 0x1.1896e1fffa1eap-3},
                             {0, -1, 0}};
    CHECK(clear_side_of_departure(wide, beyond, body, 0x1p-6) == 0);
    CHECK(side_of_departure(wide, beyond, body) == 1);
}

TEST_CASE("rays start on an ellipsoid whose normals underflow when squared") {
    for (const double size : {0x1p-112, 0x1p-60, 1.0}) {
        const EllipsoidOf<double> ball{Vec3d(0.0), {size, 0, 0}, {0, size, 0}, {0, 0, size}};
        const Ray<double> ray{{size * (1 + 0x1p-30), 0, 0}, {-1, 0, 0}};
        CAPTURE(size);
        CHECK(clear_side_of_departure(ball, ray, body, 0x1p-10) == -1);
        CHECK(may_start_on(ball, ray.origin, body, 0x1p-10));
        CHECK_FALSE(may_start_on(ball, 1.5 * ray.origin, body, 0x1p-10));
    }
}

TEMPLATE_TEST_CASE("a ray from a cone's tip goes inside where the cone is around it", "", OpenCone,
                   CappedCone) {
    const Vec3d tip(1, 2, 3);
    for (const double length : {0.125, 1.0, 8.0}) { // flat, right-angled, sharp
        InDouble<TestType> cone{Vec3d(1, 2, 3 - length), Vec3d(0, 0, length), 1.0, 0.0};
        InDouble<TestType> turned{tip, Vec3d(0, 0, -length), 0.0, 1.0};
        for (const auto& shape : {cone, turned})
            for (const double beyond : {0.0, 1e-9}) {
                const auto side = [&](const Vec3d& direction) {
                    return side_of_departure(
                        shape, Ray<double>{tip + Vec3d(0, 0, beyond), direction}, body);
                };
                CAPTURE(length, beyond);
                CHECK(side(Vec3d(0, 0, 1)) == 1);
                CHECK(side(Vec3d(0, 0, -1)) == -1);
                CHECK(side(Vec3d(1, 0, 0)) == 1);
                CHECK(side(Vec3d(0.5, 0, -length)) == -1);
                CHECK(side(Vec3d(0, 1, -length)) == 0);
                CHECK(side(Vec3d(0, 1 + 0x1p-52, -length)) == 1);
                CHECK(side(Vec3d(0, -1 + 0x1p-53, -length)) == -1);
                CHECK(side(Vec3d(2, 0, -length)) == 1);
                CHECK(side(Vec3d(0.5, 0, length)) == 1);
            }
    }
}
