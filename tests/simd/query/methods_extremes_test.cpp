#include "core/shapes/invalid_value.hpp"
#include "simd/isa/isa.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/simd/query/method_round.hpp"
#include "tests/support/placing.hpp"
#include "tests/support/rounds.hpp"

#include <cmath>

/// Shapes and rays with numbers that overflow, underflow or are 0.
using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;

namespace {

/// Returns a float of any size. Zero and the largest floats are frequent.
float any_float(Random& random) {
    const float sign = random.integer(0, 1) == 0 ? 1.0F : -1.0F;
    switch (random.integer(0, 7)) {
    case 0:
        return sign * 0.0F;
    case 1:
        return sign * std::numeric_limits<float>::max();
    case 2:
        return sign * std::numeric_limits<float>::denorm_min();
    default:
        return sign *
               std::ldexp(static_cast<float>(random.uniform(0.5, 1.0)), random.integer(-148, 127));
    }
}

/// Returns a direction with components of any size, or one almost along a special direction of the
/// shape.
template <class Shape>
Vec3d any_direction(const Shape& shape, Random& random) {
    if (random.integer(0, 3) == 0) {
        const Vec3d along = normalized(ray_sets::Target<Shape>::special(shape, random));
        return normalized(along + ray_sets::across(along, random) * random.log_uniform(1e-45, 1.0));
    }
    while (true) {
        const auto component = [&] {
            return random.integer(0, 2) == 0 ? static_cast<double>(any_float(random)) * 0x1p-128
                                             : random.uniform(-1.0, 1.0);
        };
        const Vec3d v(component(), component(), component());
        if (length(v) > 0x1p-300) return normalized(v);
    }
}

/// Returns a point near the shape, in proportion to its size, or anywhere.
Vec3f any_origin(const Vec3f& near, float size, Random& random) {
    if (random.integer(0, 2) == 0) return {any_float(random), any_float(random), any_float(random)};
    const Vec3f origin = near + size * ray_sets::rounded(random.cube(4.0));
    const auto finite = [](float a) { return std::isfinite(a) ? a : 0.0F; };
    return {finite(origin.x), finite(origin.y), finite(origin.z)};
}

template <class Shape>
bool is_valid(const Shape& shape) {
    SceneBuilder builder;
    builder.wants_light = false;
    builder.add_material({});
    try {
        builder.add(shape, 0);
    } catch (const InvalidValue&) {
        return false;
    }
    return true;
}

template <Precision precision, class Shape>
void check(int& hits) {
    using Real = tests::Twin<precision>;
    const int rounds = tests::rounds(600);
    Random random(41 + static_cast<std::uint64_t>(kind_of<Shape>));
    for (int i = 0; i < rounds; ++i) {
        const bool lattice = random.integer(0, 1) == 0;
        const float scale = std::ldexp(1.0F, random.integer(-140, 98));
        const Shape shape =
            tests::Placing(Vec3f(0.0F), scale)(ray_sets::Target<Shape>::make(random, lattice));
        if (!is_valid(shape)) continue;
        const Vec3f center = convert<float>(ray_sets::Target<Shape>::center(shape));
        tests::MethodRound<precision, Shape> round(shape);
        while (!round.full()) {
            round.add(convert<Real>(any_origin(center, scale, random)),
                      any_direction(shape, random));
            const Crossing<Real> hit = round.last_expected();
            if (!tests::is_hit(hit) || round.full()) continue;
            const Ray<Real> ray = round.last_ray();
            const Vec3<Real> point = mul_add(hit.t, ray.direction, ray.origin);
            round.add(point, any_direction(shape, random),
                      {true, hit.face, random.integer(0, 1) == 0});
        }
        for (const simd::Isa isa : simd::available_isas())
            hits += round.check(simd::kernels_of(isa));
    }
}

} // namespace

TEMPLATE_TEST_CASE("shapes that are huge or tiny or 0 are hit at a finite distance or missed", "",
                   RAYLANE_ALL_SHAPES) {
    int hits = 0;
    check<Precision::fast, TestType>(hits);
    check<Precision::robust, TestType>(hits);
    check<Precision::plain_double, TestType>(hits);
    CHECK(hits > tests::rounds(600));
}
