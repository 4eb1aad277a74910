#include "core/shapes/solve.hpp"
#include "tests/oracle/first_hit.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;

/// Lines through seams of closed shapes, where two faces meet: a line that enters also leaves.
namespace {

#ifdef RAYLANE_FEW_RAYS
constexpr int shape_count = 100;
#else
constexpr int shape_count = 1000;
#endif

struct Tally {
    int lines = 0, through = 0, odd = 0, disordered = 0, wrong = 0;
};

template <class Shape>
void check(const Shape& shape, const Ray<double>& ray, Tally& tally) {
    std::uint64_t widened = 0;
    const Crossings<double> found = solve(shape, ray, Start{}, widened);
    const auto count = static_cast<std::size_t>(found.end() - found.begin());
    const std::vector<oracle::Hit> truth = oracle::crossings(shape, ray);
    ++tally.lines;
    tally.through += truth.empty() ? 0 : 1;
    tally.odd += count % 2 == 0 ? 0 : 1;
    tally.wrong += count == truth.size() ? 0 : 1;
    if (count != 2) return;
    const Crossing<double>&in = found.begin()[0], &out = found.begin()[1];
    tally.disordered += in.entering && !out.entering && in.t <= out.t ? 0 : 1;
}

} // namespace

TEMPLATE_LIST_TEST_CASE("a line that enters a solid through a seam leaves it", "",
                        tests::AllSolids) {
    using Shape = TestType;
    CAPTURE(name_of(kind_of<Shape>));
    Random random(20260600 + static_cast<int>(kind_of<Shape>));
    Tally exact, unit, ulps;
    for (int i = 0; i < shape_count; ++i) {
        const Shape shape = tests::Seamed<Shape>::make(random);
        for (const Vec3f& seam : tests::Seamed<Shape>::seams(shape, random)) {
            const Vec3f direction = random.small_integers_not_zero(random.integer(1, 5));
            const Vec3f origin = seam - static_cast<float>(random.integer(-1, 3)) * direction;
            const Vec3d o = convert<double>(origin), d = convert<double>(direction);
            check(shape, {o, d}, exact);
            check(shape, {o, normalized(d)}, unit);
            Vec3d beside = d;
            for (int axis = 0; axis < 3; ++axis) // 0 stays 0, as the oracle's digits end at 1e-100
                beside[axis] *= 1.0 + 0x1p-52 * random.integer(-3, 3);
            check(shape, {o, beside}, ulps);
        }
    }
    for (const Tally& tally : {exact, unit, ulps}) {
        INFO(tally.lines << " lines, " << tally.through << " through the solid");
        CHECK(tally.odd == 0);
        CHECK(tally.disordered == 0);
        CHECK(tally.wrong == 0);
        CHECK(tally.through > tally.lines / 4);
    }
}
