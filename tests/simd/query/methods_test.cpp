#include "simd/isa/isa.hpp"
#include "tests/simd/query/method_round.hpp"
#include "tests/support/ray_sets.hpp"
#include "tests/support/rounds.hpp"

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;
using ray_sets::Set;

namespace {

/// Adds rays from anywhere, or from where they hit the shape.
template <Precision precision, class Shape>
void add_rays(tests::MethodRound<precision, Shape>& round, const Shape& shape, bool lattice,
              Random& random) {
    using Real = tests::Twin<precision>;
    while (!round.full()) {
        const Ray<float> aimed =
            ray_sets::make_ray(shape, lattice ? Set::lattice : ray_sets::any_set(random), random);
        round.add(convert<Real>(aimed.origin), normalized(convert<double>(aimed.direction)));
        const Crossing<Real> hit = round.last_expected();
        if (!tests::is_hit(hit) || round.full() || random.integer(0, 1) != 0) continue;
        const Ray<Real> ray = round.last_ray();
        round.add(mul_add(hit.t, ray.direction, ray.origin), random.direction(),
                  {true, hit.face, random.integer(0, 1) == 0});
    }
}

template <Precision precision, class Shape>
void check() {
    const int rounds = tests::rounds(1000);
    Random random(1 + static_cast<std::uint64_t>(kind_of<Shape>));
    int hits = 0;
    for (int i = 0; i < rounds; ++i) {
        const bool lattice = random.integer(0, 3) == 0;
        const Shape shape = ray_sets::Target<Shape>::make(random, lattice);
        tests::MethodRound<precision, Shape> round(shape);
        add_rays(round, shape, lattice, random);
        for (const simd::Isa isa : simd::available_isas())
            hits += round.check(simd::kernels_of(isa));
    }
    CHECK(hits > 3 * rounds);
}

} // namespace

TEMPLATE_TEST_CASE("every lane equals the scalar formulas in float", "", RAYLANE_ALL_SHAPES) {
    check<Precision::fast, TestType>();
    check<Precision::robust, TestType>();
}

TEMPLATE_TEST_CASE("every lane in double equals the scalar formulas in double without fusing", "",
                   RAYLANE_ALL_SHAPES) {
    check<Precision::plain_double, TestType>();
}
