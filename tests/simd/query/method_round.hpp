#pragma once

#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"
#include "simd/query/as_core.hpp"
#include "simd/query/query.hpp"
#include "tests/support/catch.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

/// Compares the engine's hits in each uncertified precision with the precision's scalar twin:
/// core's formulas in numbers that do the same operations.
namespace raylane::tests {

/// A double without fused operations. With it, core's templates give the same bits as the kernels
/// in lanes of doubles.
struct Unfused {
    double value = 0.0;

    Unfused() = default;
    template <class Number>
    requires std::is_arithmetic_v<Number> Unfused(Number exact)
        : value(static_cast<double>(exact)) {} // NOLINT: implicit, exact
    explicit operator double() const { return value; }

    friend Unfused operator-(Unfused a) { return -a.value; }
    friend Unfused operator+(Unfused a, Unfused b) { return a.value + b.value; }
    friend Unfused operator-(Unfused a, Unfused b) { return a.value - b.value; }
    friend Unfused operator*(Unfused a, Unfused b) { return a.value * b.value; }
    friend Unfused operator/(Unfused a, Unfused b) { return a.value / b.value; }
    friend Unfused sqrt(Unfused a) { return std::sqrt(a.value); }
    friend bool operator<(Unfused a, Unfused b) { return a.value < b.value; }
    friend bool operator>(Unfused a, Unfused b) { return a.value > b.value; }
    friend bool operator==(Unfused a, Unfused b) { return a.value == b.value; }
};

/// Number type of a precision's twin.
template <core::Precision precision>
using Twin = std::conditional_t<core::is_single(precision), float, Unfused>;

/// Returns the crossing that stands for a miss: its t is infinite.
template <class Real>
core::Crossing<Real> nothing() {
    return {Real(std::numeric_limits<float>::infinity()), core::body, false};
}

template <class Real>
bool is_hit(const core::Crossing<Real>& crossing) {
    return static_cast<double>(crossing.t) < std::numeric_limits<double>::infinity();
}

/// One shape, and rays towards it.
template <core::Precision precision, class Shape>
class MethodRound {
  public:
    using Real = Twin<precision>;
    static constexpr std::size_t capacity = 67; // the last packet is not full

    explicit MethodRound(const Shape& shape)
        : shape_(shape), scene_(scene_of(shape)), data_(scene_),
          slot_(data_.slot_of(core::kind_of<Shape>, core::Place{0, 0})) {
        arena_ = simd::arena_for([&](simd::Arena& a) { paths_.take_from(a, capacity, false); });
        paths_.start_nowhere(0, capacity);
    }

    /// Adds a ray. `direction` has the length 1, as far as doubles can tell. `start` may be on the
    /// shape.
    void add(const core::Vec3<Real>& origin, const core::Vec3d& direction,
             const core::Start& start = {}) {
        const std::size_t lane = paths_.count++;
        const core::Ray<Real> ray{origin, core::convert<Real>(direction)};
        for (int axis = 0; axis < 3; ++axis) {
            paths_.origin[axis][lane] = static_cast<double>(ray.origin[axis]);
            paths_.direction[axis][lane] = static_cast<double>(ray.direction[axis]);
        }
        if (start.on_surface) {
            paths_.start_on(lane, slot_, data_.record_of(slot_),
                            start.face | (start.inward ? simd::hit_entering : 0),
                            /*through=*/true);
        }
        rays_[lane] = ray;
        expected_[lane] = solved(ray, start);
    }

    bool full() const { return paths_.count == capacity; }
    const core::Ray<Real>& last_ray() const { return rays_[paths_.count - 1]; }
    const core::Crossing<Real>& last_expected() const { return expected_[paths_.count - 1]; }

    /// Checks that the kernels find the same crossings as the twin. Returns how many rays hit the
    /// shape.
    int check(const simd::Kernels& kernels) const {
        simd::Query finder(data_, {&kernels, precision}, simd::Asked::floats);
        const simd::Arena arena =
            simd::arena_for([&](simd::Arena& a) { finder.take_from(a, capacity); });
        simd::EngineCounters counters;
        finder.nearest(paths_, nullptr, counters);

        std::array<bool, capacity> at_contacts{};
        for (const std::uint32_t lane : finder.at_contacts())
            at_contacts[lane] = true;
        int hits = 0;
        for (std::size_t lane = 0; lane < paths_.count; ++lane) {
            if (at_contacts[lane])
                check_left_open(kernels, lane);
            else
                check_lane(kernels, finder.hits(), lane);
            hits += is_hit(expected_[lane]) ? 1 : 0;
        }
        return hits;
    }

  private:
    static core::Scene scene_of(const Shape& shape) {
        core::SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        builder.add(shape, 0);
        return std::move(builder).build();
    }

    /// Returns the first crossing ahead, or a miss if its t overflows.
    core::Crossing<Real> solved(const core::Ray<Real>& ray, const core::Start& start) const {
        core::ErrorPredicate<Real> predicate(precision);
        const Real zero(0.0F);
        for (const core::Crossing<Real>& crossing : core::crossings(shape_, ray, start, predicate))
            if (crossing.t > zero || (start.on_surface && crossing.t == zero))
                return is_hit(crossing) ? crossing : nothing<Real>();
        return nothing<Real>();
    }

    /// Only a t that no float can hold may be left open.
    void check_left_open(const simd::Kernels& kernels, std::size_t lane) const {
        using Limits = std::numeric_limits<float>;
        const double t = static_cast<double>(expected_[lane].t);
        const bool holds = t > 2.0 * static_cast<double>(Limits::min()) &&
                           t < 0.5 * static_cast<double>(Limits::max());
        if (core::is_single(precision) || holds) complain(kernels, lane, "left open");
    }

    void complain(const simd::Kernels& kernels, std::size_t lane, const char* what) const {
        CAPTURE(std::string(kernels.name), std::string(core::name_of(precision)), lane);
        CAPTURE(static_cast<double>(expected_[lane].t));
        FAIL_CHECK(what);
    }

    /// Returns whether the ray hits the shape in real arithmetic. Otherwise bounds may reject the
    /// ray.
    bool is_there(std::size_t lane) const {
        if (paths_.origin_slot[lane] == slot_) return true; // bounds are not tested
        const core::Ray<double> ray = simd::ray_of(paths_, lane);
        std::uint64_t widened = 0;
        for (const core::Crossing<double>& crossing : core::solve(shape_, ray, {}, widened))
            if (crossing.t > 0.0) return true;
        return false;
    }

    void check_lane(const simd::Kernels& kernels, const simd::Hits& found, std::size_t lane) const {
        const core::Crossing<Real>& expected = expected_[lane];
        const bool hit = found.slot[lane] != simd::no_slot;
        if (hit != is_hit(expected) && (hit || is_there(lane)))
            complain(kernels, lane, hit ? "a hit" : "a miss");
        if (!hit || !is_hit(expected)) return;
        const std::uint32_t bits = expected.face | (expected.entering ? simd::hit_entering : 0);
        if (found.t[lane] != static_cast<double>(expected.t) || found.hit[lane] != bits)
            complain(kernels, lane, "another crossing");
        const core::Ray<Real>& ray = rays_[lane];
        const core::Vec3<Real> normal = core::outward_normal(
            shape_, core::Vec3<Real>(core::mul_add(expected.t, ray.direction, ray.origin)),
            expected.face);
        for (int axis = 0; axis < 3; ++axis) {
            const double wanted = static_cast<double>(normal[axis]), got = found.normal[axis][lane];
            if (!(got == wanted || (std::isnan(got) && std::isnan(wanted))))
                complain(kernels, lane, "another normal");
        }
    }

    Shape shape_;
    core::Scene scene_;
    simd::SceneData data_;
    std::uint32_t slot_;
    simd::Arena arena_;
    simd::Paths paths_{};
    std::array<core::Ray<Real>, capacity> rays_;
    std::array<core::Crossing<Real>, capacity> expected_;
};

} // namespace raylane::tests
