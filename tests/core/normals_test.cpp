#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"

#include <cmath>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;
using ray_sets::Set;

namespace {

/// Returns whether a point is at an apex. An apex has no normal, and a rounded point next to it may
/// have any normal.
template <class Shape>
bool is_apex(const Shape& shape, const Vec3d& point, Face face) {
    return length(outward_direction(shape, point, face)) < 1e-6;
}

} // namespace

TEMPLATE_TEST_CASE("a ray enters against the outward normal and leaves along it", "",
                   RAYLANE_ALL_SHAPES) {
    using Shape = TestType;
    constexpr double grazing = 1e-4; // the cosine at which a rounded point may tell the wrong side
    Random random(20260300 + static_cast<int>(kind_of<Shape>));
    std::uint64_t widened = 0;
    int entered = 0, left = 0, wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        const bool lattice = i % 2 == 1;
        const Shape shape = ray_sets::Target<Shape>::make(random, lattice);
        for (const Set set : {Set::random, Set::inside, Set::zeros, Set::lattice}) {
            if ((set == Set::lattice) != lattice) continue;
            const Ray<float> aimed = ray_sets::make_ray(shape, set, random);
            const Ray<double> ray{convert<double>(aimed.origin),
                                  normalized(convert<double>(aimed.direction))};
            for (const Crossing<double>& crossing : solve(shape, ray, Start{}, widened)) {
                const Vec3d point = mul_add(crossing.t, ray.direction, ray.origin);
                if (is_apex(shape, point, crossing.face)) continue;
                const Vec3d normal = outward_normal(shape, point, crossing.face);
                const double cosine = dot(normal, ray.direction);
                const bool is_unit = std::abs(length(normal) - 1.0) < 1e-12;
                const bool is_outward =
                    std::abs(cosine) < grazing || crossing.entering == (cosine < 0.0);
                ++(crossing.entering ? entered : left);
                if ((!is_unit || !is_outward) && wrong++ < 3)
                    UNSCOPED_INFO("face " << int{crossing.face} << " entering " << crossing.entering
                                          << " normal " << normal.x << ' ' << normal.y << ' '
                                          << normal.z << " cosine " << cosine);
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(entered > 100);
    CHECK(left > 100);
}

TEST_CASE("the normal of a cone's body leans to its narrower end") {
    // The body goes 3 along the axis for 4 across it.
    const double along = 0.8, across = 0.6;
    const OpenCone narrowing{{0, 0, 0}, {0, 3, 0}, 4, 0}, widening{{0, 0, 0}, {0, 3, 0}, 0, 4};
    const Vec3d halfway{2, 1.5, 0};
    const Vec3d up = outward_normal(narrowing, halfway, body);
    CHECK(up.x == Approx(across));
    CHECK(up.y == Approx(along));
    const Vec3d down = outward_normal(widening, halfway, body);
    CHECK(down.x == Approx(across));
    CHECK(down.y == Approx(-along));
}
