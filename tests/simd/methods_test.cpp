#include "core/solve.hpp"
#include "simd/isa.hpp"
#include "simd/wavefront/hit_finder.hpp"
#include "tests/catch.hpp"
#include "tests/ray_sets.hpp"
#include "tests/simd/rounds.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <string>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;
using ray_sets::Set;

/// What the engine finds with each precision that promises no more than its formulas, against the
/// scalar twin of it.

namespace {

constexpr std::size_t rays_a_shape = 67; // the last packet is not full

int rounds() {
    return tests::rounds(1000);
}

template <class Real>
struct Expected {
    Real t = std::numeric_limits<Real>::infinity();
    Face face = body;
    bool entering = false;

    bool any() const { return t < std::numeric_limits<Real>::infinity(); }
};

/// One shape, and rays at it: from anywhere, or from where they have hit it.
template <class Real, class Shape>
class Round {
  public:
    Round(Precision precision, Random& random)
        : precision_(precision), lattice_(random.integer(0, 3) == 0),
          shape_(ray_sets::Target<Shape>::make(random, lattice_)), scene_(scene_of(shape_)) {
        Arena measure;
        paths_.take_from(measure, rays_a_shape, false);
        arena_ = Arena(measure.used());
        paths_.take_from(arena_, rays_a_shape, false);
        paths_.count = rays_a_shape;
        paths_.start_in_the_open(0, rays_a_shape);
        for (std::size_t lane = 0; lane < rays_a_shape; ++lane)
            add(lane, random);
    }

    const Scene& scene() const { return scene_; }
    const Paths& paths() const { return paths_; }
    const Shape& shape() const { return shape_; }
    const Ray<Real>& ray(std::size_t lane) const { return rays_[lane]; }
    const Expected<Real>& expected(std::size_t lane) const { return expected_[lane]; }

  private:
    static Scene scene_of(const Shape& shape) {
        SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        builder.add(shape, 0);
        return std::move(builder).build();
    }

    void add(std::size_t lane, Random& random) {
        const Set set = lattice_ ? Set::lattice
                                 : ray_sets::all_sets[random.integer(
                                       0, static_cast<int>(std::size(ray_sets::all_sets)) - 2)];
        const Ray<float> aimed = ray_sets::make_ray(shape_, set, random);
        Ray<Real> ray{convert<Real>(aimed.origin), unit(convert<double>(aimed.direction))};
        Start start;
        const Expected<Real> hit = solved(ray, start);
        if (hit.any() && random.integer(0, 1) == 0) {
            start = {true, hit.face, random.integer(0, 1) == 0};
            ray = {mul_add(hit.t, ray.direction, ray.origin), unit(random.direction())};
            paths_.start_on(lane, 0, SceneData(scene_).occupant_of(slot()),
                            start.face | (start.inward ? hit_entering : 0), /*through=*/true);
            paths_.departed_slot[lane] = slot();
        }
        for (int axis = 0; axis < 3; ++axis) {
            paths_.origin[axis][lane] = static_cast<double>(ray.origin[axis]);
            paths_.direction[axis][lane] = static_cast<double>(ray.direction[axis]);
        }
        rays_[lane] = ray;
        expected_[lane] = solved(ray, start);
    }

    std::uint32_t slot() const { return SceneData(scene_).slot_of(kind_of<Shape>, Slot{0, 0}); }

    static Vec3<Real> unit(const Vec3d& v) { return convert<Real>(normalized(v)); }

    Expected<Real> solved(const Ray<Real>& ray, const Start& start) const {
        std::uint64_t widened = 0;
        for (const core::Crossing<Real>& crossing : solve(shape_, ray, start, widened, precision_))
            if (crossing.t > Real(0) || (start.on_surface && crossing.t == Real(0)))
                return {crossing.t, crossing.face, crossing.entering};
        return {};
    }

    Precision precision_;
    bool lattice_;
    Shape shape_;
    Scene scene_;
    Arena arena_;
    Paths paths_{};
    std::array<Ray<Real>, rays_a_shape> rays_;
    std::array<Expected<Real>, rays_a_shape> expected_;
};

/// To the bit where lanes and scalars do the same operations: in float, where both fuse. In double
/// the lanes do not.
template <class Real>
bool is_close(double t, Real expected) {
    const auto wanted = static_cast<double>(expected);
    if constexpr (std::is_same_v<Real, float>) return t == wanted;
    return std::abs(t - wanted) <= 1e-6 * std::abs(wanted) + 1e-9;
}

template <class Real, class Shape>
void check_round(const Kernels& kernels, Precision precision, Random& random, int& hits,
                 int& different) {
    const Round<Real, Shape> round(precision, random);
    const SceneData data(round.scene());
    HitFinder finder(data, {&kernels, precision}, nullptr);
    Arena measure;
    finder.take_from(measure, rays_a_shape);
    Arena arena(measure.used());
    finder.take_from(arena, rays_a_shape);
    Counters counters;
    finder.find(round.paths(), nullptr, counters);
    CHECK(finder.left_open().empty());

    for (std::size_t lane = 0; lane < rays_a_shape; ++lane) {
        const Expected<Real>& expected = round.expected(lane);
        const bool hit =
            finder.hits().slot[lane] != no_slot && (finder.hits().hit[lane] & hit_none) == 0;
        hits += expected.any() ? 1 : 0;
        if (hit != expected.any() ||
            (hit && (!is_close(finder.hits().t[lane], expected.t) ||
                     (finder.hits().hit[lane] & hit_face) != expected.face ||
                     ((finder.hits().hit[lane] & hit_entering) != 0) != expected.entering))) {
            ++different;
            if constexpr (std::is_same_v<Real, float>) {
                CAPTURE(lane, hit, finder.hits().t[lane], expected.t, finder.hits().hit[lane]);
                FAIL("another hit than the scalar's");
            }
            continue;
        }
        if (!hit) continue;
        const Ray<Real>& ray = round.ray(lane);
        const Vec3<Real> normal = outward_normal(
            round.shape(), Vec3<Real>(mul_add(expected.t, ray.direction, ray.origin)),
            expected.face);
        for (int axis = 0; axis < 3; ++axis)
            if (!is_close(finder.hits().normal[axis][lane], normal[axis])) ++different;
    }
}

template <class Real, class Shape>
int differences(Precision precision) {
    int different = 0;
    for (const Isa isa : all_isas) {
        if (!is_available(isa)) continue;
        Random random(1 + static_cast<std::uint64_t>(kind_of<Shape>));
        int hits = 0;
        for (int i = 0; i < rounds(); ++i)
            check_round<Real, Shape>(kernels_of(isa), precision, random, hits, different);
        CHECK(hits > 3 * rounds());
    }
    return different;
}

} // namespace

TEMPLATE_TEST_CASE("the engine in float is the scalar reference in float", "", Sphere, Plane, Disc,
                   Triangle, SmoothTriangle, Box, OpenCylinder, CappedCylinder, OpenCone,
                   CappedCone, Quadric) {
    CHECK(differences<float, TestType>(Precision::fast) == 0);
    CHECK(differences<float, TestType>(Precision::robust) == 0);
}

TEMPLATE_TEST_CASE("the engine in double is the scalar reference in double, but where it rounds",
                   "", Sphere, Plane, Disc, Triangle, SmoothTriangle, Box, OpenCylinder,
                   CappedCylinder, OpenCone, CappedCone, Quadric) {
    // Tangents, rims and edges: decisions that rounding takes.
    const int rays = rounds() * static_cast<int>(rays_a_shape) * 3;
    CHECK(differences<double, TestType>(Precision::plain_double) < rays / 100);
}
