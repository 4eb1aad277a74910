#include "core/shapes/shapes.hpp"
#include "core/solids/placement.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

using namespace raylane::core;
using raylane::ray_sets::Random;

namespace {

/// Returns a number that is a float, a double, a small integer or 0.
double any_number(Random& random) {
    switch (random.integer(0, 4)) {
    case 0:
        return 0.0;
    case 1:
        return random.integer(-5, 5);
    case 2:
        return static_cast<double>(static_cast<float>(random.uniform(-100.0, 100.0)));
    case 3:
        return random.uniform(-1.0, 1.0) * random.log_uniform(1e-20, 1e20);
    default:
        return random.uniform(-100.0, 100.0);
    }
}

Vec3d any_vector(Random& random) {
    return {any_number(random), any_number(random), any_number(random)};
}

Placement any_placement(Random& random) {
    Placement placement{any_vector(random), {}, random.log_uniform(1e-3, 1e3)};
    for (int axis = 0; axis < 3; ++axis)
        placement.rotate[axis] = random.integer(0, 2) == 0   ? 90.0 * random.integer(-4, 4)
                                 : random.integer(0, 2) == 0 ? 0.0
                                                             : random.uniform(-400.0, 400.0);
    if (random.integer(0, 2) == 0) placement.scale = 1.0;
    if (random.integer(0, 2) == 0) placement.rotate = Vec3d(0.0);
    return placement;
}

/// Returns true if both have the same bits.
template <class Shape>
bool are_same(const Shape& a, const Shape& b) {
    const auto x = numbers_of(a), y = numbers_of(b);
    for (std::size_t i = 0; i < x.size(); ++i)
        if (std::bit_cast<std::uint64_t>(x[i]) != std::bit_cast<std::uint64_t>(y[i])) return false;
    return true;
}

} // namespace

TEST_CASE("a placed shape has the bits of the transformed one") {
    Random random(41);
    for (int i = 0; i < 20'000; ++i) {
        const Placement placement = any_placement(random);
        const Placer placer(placement);
        const Transform transform = transform_of(placement);
        const auto expect = [&]<class Shape>(const Shape& shape) {
            INFO(i);
            REQUIRE(are_same(placer(shape), std::get<Shape>(transform(of_shape(shape)).shape)));
        };
        const double radius = random.log_uniform(1e-3, 1e3);
        expect(SphereOf<double>{any_vector(random), radius});
        const Vec3d base = any_vector(random), axis = any_vector(random);
        expect(CylinderOf<double, Ends::open>{base, axis, radius});
        expect(CylinderOf<double, Ends::capped>{base, axis, radius});
    }
}

TEST_CASE("the rows of a placement's map are those of its transform within 4 ulps of the scale") {
    Random random(42);
    for (int i = 0; i < 20'000; ++i) {
        Placement placement = any_placement(random);
        placement.translate = Vec3d(0.0);
        if (random.integer(0, 9) == 0) placement.rotate = 1e20 * any_vector(random);
        const Placer placer(placement);
        const auto rows = rows_of(placement);
        for (int column = 0; column < 3; ++column) {
            SphereOf<double> at{Vec3d(0.0), 1.0};
            at.center[column] = 1.0;
            const Vec3d placed = placer(at).center;
            for (int row = 0; row < 3; ++row)
                REQUIRE(std::abs(rows[static_cast<std::size_t>(row)][column] - placed[row]) <=
                        4.0 * 0x1p-52 * placement.scale);
        }
    }
}

TEST_CASE("invalid placements are refused") {
    const auto field_of = [](const Placement& placement) -> std::string {
        try {
            validate(placement);
        } catch (const InvalidValue& invalid) {
            return invalid.field;
        }
        return "none";
    };
    CHECK(field_of({}) == "none");
    CHECK(field_of({{0, 1e31, 0}, {}, 1}) == "translate/1");
    CHECK(field_of({{}, {0, 0, std::nan("")}, 1}) == "rotate/2");
    CHECK(field_of({{}, {}, 0}) == "scale");
    CHECK(field_of({{}, {}, -1}) == "scale");
}
