#include "core/shapes/solve.hpp"
#include "tests/catch.hpp"
#include "tests/oracle.hpp"
#include "tests/targets.hpp"

#include <array>
#include <cmath>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;

/// Closed shapes where two of their faces meet: what enters leaves.
namespace {

#ifdef RAYLANE_FEW_RAYS
constexpr int shape_count = 100;
#else
constexpr int shape_count = 1000;
#endif

/// On small integers as far as there are any: where cap and wall, or two walls, meet, or the wall
/// ends in a point.
std::array<Vec3f, 4> seams(const Sphere& s, Random&) {
    const float r = s.radius; // a multiple of 5
    return {s.center + Vec3f(r, 0, 0), s.center - Vec3f(0, r, 0),
            s.center + r / 5.0F * Vec3f(3, 4, 0), s.center + r / 5.0F * Vec3f(0, -4, 3)};
}
std::array<Vec3f, 4> seams(const Box& box, Random& random) {
    const auto share = [&] { return static_cast<float>(random.integer(0, 4)) / 4.0F; };
    return {box.corner + share() * box.edge_u, box.corner + box.edge_u + share() * box.edge_w,
            box.corner + box.edge_v + box.edge_w + share() * box.edge_u,
            box.corner + box.edge_u + box.edge_v + box.edge_w};
}
/// The axis is along x, y or z.
std::array<Vec3f, 4> rims(const Vec3f& base, const Vec3f& axis, float r0, float r1) {
    const int along = axis.x != 0.0F ? 0 : axis.y != 0.0F ? 1 : 2;
    const auto out = [&](float u, float v) {
        Vec3f p{0.0F};
        p[(along + 1) % 3] = u / 5.0F;
        p[(along + 2) % 3] = v / 5.0F;
        return p;
    };
    return {base + r0 * out(3, 4), base + r0 * out(-5, 0), base + axis + r1 * out(4, -3),
            base + axis + r1 * out(0, 5)};
}
std::array<Vec3f, 4> seams(const CappedCylinder& c, Random&) {
    return rims(c.base, c.axis, c.radius, c.radius);
}
std::array<Vec3f, 4> seams(const CappedCone& c, Random&) {
    return rims(c.base, c.axis, c.base_radius, c.top_radius);
}

template <class Shape>
Shape make(Random& r) {
    const auto five_times = [&](int least) { return static_cast<float>(5 * r.integer(least, 2)); };
    Vec3f axis{0.0F};
    axis[r.integer(0, 2)] = static_cast<float>(r.integer(1, 6) * (r.integer(0, 1) == 0 ? 1 : -1));
    if constexpr (kind_of<Shape> == Kind::sphere) return {r.small_integers(3), five_times(1)};
    if constexpr (kind_of<Shape> == Kind::capped_cylinder)
        return {r.small_integers(3), axis, five_times(1)};
    if constexpr (kind_of<Shape> == Kind::capped_cone) {
        const float base_radius = five_times(0);
        return {r.small_integers(3), axis, base_radius, five_times(base_radius == 0.0F ? 1 : 0)};
    }
    if constexpr (kind_of<Shape> == Kind::box) return ray_sets::Target<Box>::make(r, true);
}

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

TEMPLATE_TEST_CASE("what enters a solid through a seam of its surface leaves it", "", Sphere, Box,
                   CappedCylinder, CappedCone) {
    using Shape = TestType;
    Random random(20260600 + static_cast<int>(kind_of<Shape>));
    Tally exact, unit, ulps;
    for (int i = 0; i < shape_count; ++i) {
        const auto shape = make<Shape>(random);
        for (const Vec3f& seam : seams(shape, random)) {
            const Vec3f direction = random.small_integers_not_zero(random.integer(1, 5));
            const Vec3f origin = seam - static_cast<float>(random.integer(-1, 3)) * direction;
            const Vec3d o = convert<double>(origin), d = convert<double>(direction);
            check(shape, {o, d}, exact);
            check(shape, {o, normalized(d)}, unit);
            Vec3d beside = d;
            for (int axis = 0; axis < 3; ++axis) // 0 stays: the oracle's digits end at 1e-100
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
