#include "core/scene/method_choice.hpp"
#include "core/shapes/displacement.hpp"
#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"
#include "tests/catch.hpp"
#include "tests/core/little_scene.hpp"
#include "tests/ray_sets.hpp"
#include "tests/simd/rounds.hpp"

#include <cmath>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;
using ray_sets::Set;

namespace {

const int rounds = tests::fixed_rounds(1'500, 1'000, 5'000);

/// From a point to the farthest of a shape's bounds.
template <class Shape>
double reach_of(const Shape& shape, const Vec3d& from) {
    const Bounds bounds = bounds_of(shape);
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double far = std::max(std::abs(from[axis] - static_cast<double>(bounds.lower[axis])),
                                    std::abs(from[axis] - static_cast<double>(bounds.upper[axis])));
        squared += far * far;
    }
    return std::sqrt(squared);
}

/// The nearest crossing that is ahead.
template <class Real, class Shape>
double nearest(const Shape& shape, const Ray<Real>& ray, Precision precision) {
    std::uint64_t widened = 0;
    double t = infinity<double>;
    for (const Crossing<Real>& crossing : solve(shape, ray, Start{}, widened, precision))
        if (crossing.t > Real(0)) t = std::min(t, static_cast<double>(crossing.t));
    return t;
}

/// True if a ray passes a disc that is seen edge on, and no thicker than `off`.
template <class Shape>
bool is_on_a_line(const Shape& shape, const Ray<double>& ray, double off) {
    if constexpr (kind_of<Shape> == Kind::disc) {
        const Vec3d to_center = convert<double>(shape.center) - ray.origin;
        const double slope = dot(ray.direction, normalized(convert<double>(shape.normal)));
        return std::abs(slope) * static_cast<double>(shape.radius) < off &&
               length(cross(to_center, ray.direction)) < static_cast<double>(shape.radius) + off;
    }
    return false;
}

/// True if rays beside this one disagree with it on hit or miss.
template <class Shape>
bool is_at_an_edge(const Shape& shape, const Ray<double>& ray, bool hits, double off) {
    const Vec3d u = normalized(
        cross(ray.direction, std::abs(ray.direction.x) < 0.7 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)));
    const Vec3d v = cross(ray.direction, u);
    for (int i = 0; i < 16; ++i)
        for (double by = off; by > 0x1p-8 * off; by *= 0.75) {
            const double angle = i * (3.14159265358979 / 8.0);
            const Ray<double> beside{
                Vec3d(ray.origin + by * std::cos(angle) * u + by * std::sin(angle) * v),
                ray.direction};
            if ((nearest(shape, beside, Precision::exact) < infinity<double>) != hits) return true;
        }
    return false;
}

struct Seen {
    int bounded = 0, flipped = 0;
    double worst = 0.0; ///< error to bound
};

template <class Shape>
Seen look_at(Precision precision) {
    Random random(static_cast<std::uint64_t>(kind_of<Shape>) + 77);
    Seen seen;
    for (int i = 0; i < rounds; ++i) {
        const Shape shape = ray_sets::Target<Shape>::make(random, false);
        const Set sets[] = {Set::random, Set::grazing, Set::far, Set::zeros};
        const Ray<float> ray = ray_sets::make_ray(shape, sets[i % 4], random);
        const Ray<double> right{convert<double>(ray.origin), convert<double>(ray.direction)};
        const double stretch = length(right.direction);
        const double off = displacement(shape, precision, reach_of(shape, right.origin));
        if (!(off < infinity<double>) || !(stretch > 0.0)) continue;
        ++seen.bounded;

        const Ray<double> unit{right.origin, right.direction / stretch};
        const double drawn = nearest(shape, ray, precision) * stretch;
        const bool hits = nearest(shape, unit, Precision::exact) < infinity<double>;
        if ((drawn < infinity<double>) != hits) {
            ++seen.flipped;
            INFO("shape " << name_of(kind_of<Shape>) << ", round " << i << ", off " << off);
            REQUIRE((is_on_a_line(shape, unit, off) || is_at_an_edge(shape, unit, hits, off)));
        } else if (hits) {
            // Half of what moves along the ray counts as displacement.
            const double distance =
                tests::distance_to_face(shape, body, mul_add(drawn, unit.direction, unit.origin));
            seen.worst = std::max(seen.worst, distance / (2.0 * off));
            if (distance > 2.0 * off) {
                INFO("shape " << name_of(kind_of<Shape>) << ", round " << i << ", off " << off);
                REQUIRE(distance <= 2.0 * off);
            }
        }
    }
    return seen;
}

Scene lone(const Sphere& sphere, const Vec3f& from) {
    little_scene::Builder builder;
    builder.camera.from = from;
    builder.camera.at = sphere.center;
    builder.camera.field_of_view = 2.0F;
    builder.add_shape(sphere, Material{});
    return builder.finish();
}

Quadric ellipsoid(const Vec3f& center) {
    return {center, 1, 2, 3, 0, 0, 0, 0, 0, 0, -1, Vec3f(-1.1F), Vec3f(1.1F)};
}

Scene with_ellipsoids(std::initializer_list<Vec3f> centers, float distance, float field_of_view,
                      const Material& material = {}) {
    little_scene::Builder builder;
    builder.camera.from = {0, 0, distance};
    builder.settings.width = builder.settings.height = 400;
    builder.camera.field_of_view = field_of_view;
    for (const Vec3f& center : centers)
        builder.add_shape(ellipsoid(center), material);
    return builder.finish();
}

const MethodEstimate& estimate(const MethodChoice& choice, Precision precision) {
    for (const MethodEstimate& method : choice.considered)
        if (method.precision == precision) return method;
    throw std::logic_error("not considered");
}

} // namespace

TEST_CASE("no surface is displaced by more than what bounds it") {
    for (const Precision precision : {Precision::fast, Precision::robust})
        for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
            if constexpr (tests::Nature<Shape>::has_displacement) {
                const Seen seen = look_at<Shape>(precision);
                CAPTURE(name_of(kind_of<Shape>), name_of(precision));
                CAPTURE(seen.bounded, seen.flipped, seen.worst);
                CHECK(seen.bounded > rounds / 40);
                // Or it is no bound worth having.
                CHECK(seen.worst > (rounds > 2'000 ? 0.001 : 0.0001));
            }
        });
    // Rays that graze are taken wrongly, or nothing has been shown.
    CHECK(look_at<Sphere>(Precision::fast).flipped > 0);
}

TEST_CASE("what has no bound is told so") {
    const double reach = 10.0;
    for (const Precision precision : {Precision::fast, Precision::robust}) {
        for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
            Random random(78);
            if (!tests::Nature<Shape>::has_displacement)
                CHECK(displacement(ray_sets::Target<Shape>::make(random, false), precision,
                                   reach) == infinity<double>);
        });
        // A cone as a quadric has an apex.
        const Quadric cone{{0, 0, 0}, 1, -1, 1, 0, 0, 0, 0, 0, 0, 0, Vec3f(-1), Vec3f(1)};
        CHECK(displacement(cone, precision, reach) == infinity<double>);
        const Quadric cut{{0, 0, 0}, 1, -1, 1, 0, 0, 0, 0, 0, 0, 0, {-1, 0.25F, -1}, Vec3f(1)};
        CHECK((displacement(cut, precision, reach) < infinity<double>) ==
              (precision == Precision::robust)); // A may vanish
        // It touches its box, where some of it or all may be cut off.
        const Quadric ball{{0, 0, 0}, 1, 1, 1, 0, 0, 0, 0, 0, 0, -1, Vec3f(-1), Vec3f(1)};
        CHECK(displacement(ball, precision, reach) == infinity<double>);
        CHECK(displacement(Sphere{{0, 0, 0}, 1}, precision, 1e9) == infinity<double>);
    }
}

TEST_CASE("auto takes float where that is cheaper and cannot be seen") {
    const Scene scene = with_ellipsoids({{-1.5F, 0, 0}, {1.5F, 0, 0}}, 6, 60);
    const MethodChoice choice = choose_method(scene, scene.settings());
    CAPTURE(estimate(choice, Precision::fast).pixels, estimate(choice, Precision::fast).objection);
    CHECK(choice.precision == Precision::fast);
    CHECK(choice.considered.size() == 4);
    CHECK(choice.considered.front().precision == Precision::fast);
    CHECK(estimate(choice, Precision::exact).cost == 1.0);
    CHECK(estimate(choice, Precision::exact).pixels == 0.0);

    SECTION("which depends on the size of a pixel") {
        Settings settings = scene.settings();
        settings.width = settings.height = 60'000;
        CHECK(choose_method(scene, settings).precision == Precision::exact);
    }
}

TEST_CASE("auto stays exact where float might show") {
    const auto objection = [](const Scene& scene) {
        const MethodChoice choice = choose_method(scene, scene.settings());
        CHECK(choice.precision == Precision::exact);
        return estimate(choice, Precision::fast).objection;
    };
    const std::string far = "it may displace what is seen by a tenth of a pixel or more";
    // 300 units away under a small angle.
    CHECK(objection(with_ellipsoids({{0, 0, 0}}, 300, 0.5F)) == far);
    // The camera inside.
    CHECK(objection(with_ellipsoids({{0, 0, 0}}, 0.5F, 30)) == far);
    CHECK(objection(with_ellipsoids({{0, 0, 0}, {2.2F, 0, 0}}, 6, 60)) ==
          "shapes touch or nearly do, and it may take one for another");
    CHECK(objection(with_ellipsoids({{0, 0, 0}}, 6, 60, little_scene::mirror(0.5F))) ==
          "reflections and refractions magnify its errors");
    CHECK(objection(with_ellipsoids({{0, 0, 0}}, 6, 60, little_scene::ruler({0, 0.001F, 0}))) ==
          "patterns are read where it takes the surface to be");
    little_scene::Builder builder;
    builder.add_shape(Plane{{0, -2, 0}, {0, 1, 0}}, Material{});
    builder.add_shape(ellipsoid({0, 0, 0}), Material{});
    CHECK(objection(builder.finish()) == "planes have no end, nor has its error there");
}

TEST_CASE("auto stays exact where that is the cheapest") {
    const Scene scene = lone({{0, 0, 0}, 1}, {0, 0, 40});
    const MethodChoice choice = choose_method(scene, scene.settings());
    CHECK(choice.precision == Precision::exact);
    CHECK(choice.considered.front().precision == Precision::exact);
    CHECK(estimate(choice, Precision::robust).objection.empty());
    CHECK(estimate(choice, Precision::robust).pixels > 0.0);
    CHECK(estimate(choice, Precision::robust).pixels < estimate(choice, Precision::fast).pixels);
}
