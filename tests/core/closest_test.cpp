#include "core/reference/closest.hpp"
#include "core/shapes/closest_point.hpp"
#include "core/shapes/shapes.hpp"
#include "tests/oracle/closest.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"
#include "tests/support/rounds.hpp"

#include <bit>
#include <limits>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using oracle::Number;
using oracle::OnSurface;
using ray_sets::Random;
using ray_sets::Target;

/// Closest points of scenes, against all shapes one by one in 100 digits.
namespace {

/// Returns whether a double is the one nearest to a number, ties to even, or within the rounding
/// errors of the oracle at this scale.
bool is_nearest(double got, const Number& wanted, const Number& scale) {
    if (!std::isfinite(got)) return false;
    const Number off = abs(Number(got) - wanted);
    if (off <= oracle::digits_lost() * scale) return true;
    for (const double towards : {-infinity<double>, infinity<double>}) {
        const double other = std::nextafter(got, towards);
        if (!std::isfinite(other)) continue;
        const Number difference = abs(Number(other) - wanted) - off;
        if (abs(difference) <= oracle::digits_lost() * scale) {
            if ((std::bit_cast<std::uint64_t>(got) & 1) != 0) return false;
        } else if (difference < 0) {
            return false;
        }
    }
    return true;
}

using AnyDouble = tests::AnyShapeInDouble;

struct TestScene {
    std::vector<AnyDouble> shapes;

    Scene scene() const {
        SceneBuilder builder;
        builder.wants_light = false;
        builder.merge_duplicates = false;
        const MaterialIndex material = builder.add_material({});
        for (const AnyDouble& any : shapes)
            std::visit([&](const auto& shape) { builder.add(shape, material); }, any);
        return std::move(builder).build();
    }
};

/// Checks an answer against the closest points of each shape.
void check(const TestScene& expected_scene, const Vec3d& point, const Closest& got) {
    std::vector<oracle::OnSurfaces> each;
    for (const AnyDouble& any : expected_scene.shapes)
        each.push_back(std::visit(
            [&]<class Shape>(const Shape& shape) {
                if constexpr (kind_of<Shape> == Kind::quadric)
                    return oracle::OnSurfaces();
                else
                    return oracle::closest_of(shape, point);
            },
            any));
    const oracle::Place from = oracle::place(point);
    std::size_t best = 0;
    for (std::size_t i = 1; i < each.size(); ++i) {
        const OnSurface &a = each[i][0], &b = each[best][0];
        if (a.distance + oracle::distance_error(a, from) <
            b.distance - oracle::distance_error(b, from))
            best = i;
    }
    const oracle::OnSurfaces& wanted = each[best];
    const Number scale = oracle::size_of(from) + oracle::size_of(wanted[0].point);
    CAPTURE(point.x, point.y, point.z, best, got.shape, got.distance, int(got.face));
    CHECK(got.shape == best);
    CHECK((got.distance == 0.0) == (wanted[0].distance == 0));
    CHECK(is_nearest(got.distance, wanted[0].distance, scale));
    CHECK(int(got.face) == int(wanted[0].face));
    CAPTURE(got.point.x, got.point.y, got.point.z);
    if (wanted[0].is_one_of_many) {
        const Number off = oracle::distance(oracle::place(got.point), from);
        CHECK(abs(off - wanted[0].distance) <= 4e-16 * scale);
        return;
    }
    CHECK(std::any_of(wanted.begin(), wanted.end(), [&](const OnSurface& one) {
        bool is_it = one.face == got.face;
        for (int axis = 0; axis < 3; ++axis)
            is_it = is_it &&
                    is_nearest(got.point[axis], one.point[static_cast<std::size_t>(axis)], scale);
        return is_it;
    }));
}

/// Returns a shape whose numbers have all bits of doubles, or those of floats.
template <class Shape>
InDouble<Shape> any_double(Random& r, bool lattice) {
    const InDouble<Shape> shape = to_doubles(Target<Shape>::make(r, lattice));
    if (lattice || r.integer(0, 1) == 0) return shape;
    auto numbers = numbers_of(shape);
    for (double& number : numbers)
        number *= 1.0 + r.uniform(0.0, 0x1p-24);
    return shape_of<InDouble<Shape>>(numbers);
}

/// Returns a point at, near or far from a shape.
template <class Shape>
Vec3d any_point(const Shape& shape, Random& r, bool lattice) {
    using T = Target<InFloat<Shape>>;
    const InFloat<Shape> in_float = to_floats(shape);
    const ray_sets::SurfacePoint on = T::surface(in_float, r);
    const Vec3d center = T::center(in_float);
    switch (r.integer(0, lattice ? 8 : 6)) {
    case 0:
        return r.cube(20.0);
    case 1:
        return on.point;
    case 2:
        return on.point + on.normal * (r.uniform(-1.0, 1.0) * r.log_uniform(1e-18, 1.0));
    case 3:
        return center + (on.point - center) * r.uniform(-1.0, 2.0);
    case 4:
        return r.integer(0, 1) == 0 ? center : Vec3d(0.5) * (center + on.point);
    case 5:
        return on.point + r.direction() * r.log_uniform(1e3, 1e30);
    case 6:
        return convert<double>(ray_sets::rounded(on.point));
    default:
        return Vec3d(0.5) * convert<double>(r.small_integers(16));
    }
}

template <class Shape>
void check_one_kind(Random& r, bool lattice) {
    const InDouble<Shape> shape = any_double<Shape>(r, lattice);
    const TestScene shapes{{shape}};
    const Scene scene = shapes.scene();
    ClosestSearcher searcher(scene);
    for (int i = 0; i < 8; ++i) {
        const Vec3d point = any_point(shape, r, lattice);
        check(shapes, point, searcher.find(point, infinity<double>));
    }
}

AnyDouble any_shape(Random& r, bool lattice) {
    const auto kind = static_cast<Kind>(r.integer(0, kind_count - 1));
    return with_shape_type(kind, [&]<class Shape>(std::type_identity<Shape>) -> AnyDouble {
        if constexpr (kind_of<Shape> != Kind::quadric)
            return any_double<Shape>(r, lattice);
        else
            return any_double<Sphere>(r, lattice);
    });
}

} // namespace

TEMPLATE_TEST_CASE("the closest point of a shape is that of 100 digits", "", Sphere, Plane, Disc,
                   Triangle, SmoothTriangle, Box, OpenCylinder, CappedCylinder, OpenCone,
                   CappedCone, Ellipsoid) {
    Random r(tests::seed(7));
    for (int i = 0; i < tests::rounds(60, 10, 1000); ++i)
        for (const bool lattice : {false, true})
            check_one_kind<TestType>(r, lattice);
}

TEST_CASE("the closest of many shapes is that of 100 digits") {
    Random r(tests::seed(8));
    for (int i = 0; i < tests::rounds(8, 2, 100); ++i)
        for (const bool lattice : {false, true}) {
            TestScene shapes;
            for (int k = 0; k < 40; ++k)
                shapes.shapes.push_back(any_shape(r, lattice));
            const Scene scene = shapes.scene();
            ClosestSearcher searcher(scene);
            for (const AnyDouble& any : shapes.shapes) {
                const Vec3d point = std::visit(
                    [&](const auto& shape) { return any_point(shape, r, lattice); }, any);
                check(shapes, point, searcher.find(point, infinity<double>));
            }
        }
}

TEST_CASE("a distance halfway between two doubles is rounded to the even one") {
    const auto check_one = [](const auto& shape, const Vec3d& point, double even) {
        const TestScene shapes{{shape}};
        const Scene scene = shapes.scene();
        const Closest closest = ClosestSearcher(scene).find(point, infinity<double>);
        CHECK(closest.distance == even);
        check(shapes, point, closest);
    };
    // Normal and axis have the length 3, so that the distance is a third of a sum.
    check_one(PlaneOf<double>{Vec3d(-2, 3, 0), Vec3d(-2, 1, 2)},
              Vec3d(0x1.bd443ebe6d298p+3, -0x1.e0a0497c836bfp+3, -0x1.fa6b0dcc689a2p+3),
              0x1.b2aa7b185d288p+4);
    check_one(CylinderOf<double, Ends::capped>{Vec3d(1, -2, 2), Vec3d(-2, -2, 1), 5.0},
              Vec3d(-0x1.b74dc5f1bd23ep-3, -0x1.5694b0a876f98p+1, 0x1.009b8082076f2p+2),
              0x1.11ce989ddd06ep+0);
}

TEST_CASE("a cap in a plane and the plane tie next to them") {
    const TestScene shapes{
        {CylinderOf<double, Ends::capped>{Vec3d(-1, 3, 3), Vec3d(-2, -2, -2), 3.0},
         PlaneOf<double>{Vec3d(1, -1, -1), Vec3d(1, 1, 1)}}};
    const Scene scene = shapes.scene();
    const Vec3d point(-0x1.3cc1c8e00b1c5p+1, 0x1.4cd46f4aed4d1p+1, -0x1.20254cd5c461dp+0);
    const Closest closest = ClosestSearcher(scene).find(point, infinity<double>);
    CHECK(closest.shape == 0);
    CHECK(closest.face == top_cap);
    check(shapes, point, closest);
}

TEST_CASE("a limit of the distance compares with the answer") {
    const TestScene shapes{{SphereOf<double>{Vec3d(0.0), 1.0}}};
    const Scene scene = shapes.scene();
    ClosestSearcher searcher(scene);
    for (const Vec3d point : {Vec3d(0.3, 0.7, 1.9), Vec3d(1e-3, 0.2, 0.1), Vec3d(5.0, 0.0, 0.0)}) {
        const double distance = searcher.find(point, infinity<double>).distance;
        CHECK(searcher.find(point, distance).shape == 0);
        const Closest none = searcher.find(point, std::nextafter(distance, 0.0));
        CHECK(none.shape == no_shape);
        CHECK(none.distance == infinity<double>);
        CHECK(std::isnan(none.point.x));
    }
    CHECK(searcher.find(Vec3d(0.0, 1.0, 0.0), 0.0).shape == 0);
    CHECK(searcher.find(Vec3d(0.0, 1.0, 0.0), -1.0).shape == no_shape);
}

TEST_CASE("distances at the ends of the range of doubles are not rounded to 0 or infinity") {
    const TestScene shapes{{PlaneOf<double>{Vec3d(0.0), Vec3d(0.0, 0.0, 1.0)},
                            SphereOf<double>{Vec3d(0.0, 0.0, -1e30), 1e29}}};
    const Scene scene = shapes.scene();
    ClosestSearcher searcher(scene);
    const double least = std::numeric_limits<double>::denorm_min();
    const double most = std::numeric_limits<double>::max();
    CHECK(searcher.find(Vec3d(1.0, 2.0, least), infinity<double>).distance == least);
    CHECK(searcher.find(Vec3d(1.0, 2.0, -most), infinity<double>).distance == most);
    CHECK(searcher.find(Vec3d(most, most, most), infinity<double>).distance == most);
    const TestScene sphere{{SphereOf<double>{Vec3d(0.0, 0.0, 0.0), 1e29}}};
    const Scene alone = sphere.scene();
    CHECK(ClosestSearcher(alone).find(Vec3d(most, most, most), infinity<double>).distance == most);
}

TEST_CASE("mirrored spheres tie, and an ulp of their distance decides") {
    Random r(tests::seed(9));
    for (int i = 0; i < 200; ++i) {
        const Vec3d center(r.uniform(1.0, 5.0), r.uniform(-3.0, 3.0), r.uniform(-3.0, 3.0));
        const double radius = r.uniform(0.1, 0.9);
        const int ulps = r.integer(-1, 1); // by which the mirrored one is farther
        const double x = ulps == 0 ? center.x : std::nextafter(center.x, ulps * infinity<double>);
        const SphereOf<double> one{center, radius}, other{Vec3d(-x, center.y, center.z), radius};
        const bool is_first = r.integer(0, 1) == 0;
        const TestScene shapes{{is_first ? one : other, is_first ? other : one}};
        const Scene scene = shapes.scene();
        const Vec3d point(0.0, r.uniform(-3.0, 3.0), r.uniform(-3.0, 3.0));
        const ShapeId wanted = ulps == 0 || (ulps > 0) == is_first ? 0 : 1;
        CHECK(ClosestSearcher(scene).find(point, infinity<double>).shape == wanted);
    }
}

TEST_CASE("scenes with copies or constructed solids have no closest points") {
    const Solid ball = of_shape(SphereOf<double>{Vec3d(0.0), 1.0});
    const auto scene_of = [&](const auto& add) {
        SceneBuilder builder;
        builder.wants_light = false;
        builder.keep_from = 0;
        Solid member = ball;
        member.material = builder.add_material({});
        add(builder, member);
        return std::move(builder).build();
    };
    const Scene copies = scene_of([](SceneBuilder& builder, const Solid& member) {
        builder.add_copies({&member, 1}, {{}, {Vec3d(3.0, 0.0, 0.0)}});
    });
    REQUIRE(copies.copies() != nullptr);
    CHECK_THROWS_WITH(require_closest_points(copies),
                      "scene: must not keep copies of groups for closest points; build() it with "
                      "shapes in their place");
    const Scene solids = scene_of([](SceneBuilder& builder, const Solid& member) {
        Solid both{.made = Made::by_union, .parts = {member, member}};
        std::get<SphereOf<double>>(both.parts[1].shape).center.x = 1.0;
        builder.add_solid(both, member.material);
    });
    CHECK_THROWS_WITH(require_closest_points(solids),
                      "scene: must have no constructed solids: closest points on them are not "
                      "supported");
    const Scene shapes = scene_of([](SceneBuilder& builder, const Solid& member) {
        builder.add_group({&member, 1});
    });
    CHECK_NOTHROW(require_closest_points(shapes));
}
