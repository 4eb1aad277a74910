#pragma once

#include "core/reference/counters.hpp"
#include "core/reference/origin_surfaces.hpp"
#include "core/shapes/solve.hpp"

#include <optional>
#include <utility>

/// Order of a ray's crossings, whatever they are crossings with: as real arithmetic says. Two are
/// at the same t where that says so, and nowhere else.
namespace raylane::core {

/// A ray that starts on no surface, or on known ones.
struct LeavingRay {
    const Ray<double>& ray;
    const OriginSurfaces<double>& origins;
};

/// The crossing as a root of its surface's equation along the ray. For a start on that surface, of
/// which t = 0 is one root, of what is left of it (as the solvers have it); behind the start it is
/// there: not_behind().
template <class Shape>
ExactRoot root_of(const Shape& shape, const LeavingRay& from, const Hit<double>& hit) {
    if (hit.at_start) return ExactRoot::at(0.0);
    const ExactRay ray{convert<Dyadic>(from.ray.origin), convert<Dyadic>(from.ray.direction)};
    const Start start = from.origins.start_on(hit.shape);
    ExactQuadratic form = form_along(shape, ray, hit.face);
    if (!start.on_surface || start.face != hit.face) return {std::move(form), !hit.entering};
    ExactRoot root({0.0, 0.5 * form.A, form.B + form.B}, true);
    return root.sign() > 0 ? root : ExactRoot::at(0.0);
}

/// A crossing of which more is found out where there is need.
class SharpHit {
  public:
    SharpHit(const Hit<double>& hit) : hit_(hit) {} // NOLINT: implicit
    /// Hit of which t has been found out in 106 bits, if its error is less.
    SharpHit(const Hit<double>& hit, const DoubleDouble& t, double error) : hit_(hit) {
        if (!(error < hit.error)) return;
        is_wide_ = true;
        t_ = t;
        t_error_ = error;
    }

    const Hit<double>& hit() const { return hit_; }
    /// Finds out t in 106 bits, if that is more.
    void widen(const Scene& scene, const LeavingRay& from) const {
        if (std::exchange(is_wide_, true) || hit_.at_start) return;
        t_ = hit_.t;
        t_error_ = hit_.error;
        with_table(scene.shapes(), hit_.kind,
                   [&](const auto& table) { widen(table.get(hit_.place), from); });
    }
    /// Hit with a t that is off by no more than double cannot help, if it has been widened.
    Hit<double> sharpened() const {
        const Bounded<double> t = in_double(wide_t());
        Hit<double> result = hit_;
        if (!(t.error < hit_.error)) return result;
        result.t = t.value;
        result.error = t.error;
        return result;
    }
    /// t as well as it is known.
    Bounded<DoubleDouble> wide_t() const {
        return is_wide_ ? Bounded<DoubleDouble>(t_, t_error_)
                        : Bounded<DoubleDouble>(hit_.t, hit_.error);
    }
    /// Exactly.
    const ExactRoot& root(const Scene& scene, const LeavingRay& from) const {
        if (!root_)
            with_table(scene.shapes(), hit_.kind, [&](const auto& table) {
                root_ = root_of(table.get(hit_.place), from, hit_);
            });
        return *root_;
    }

    /// True if it surely comes before; both have been widened.
    bool is_surely_before(const SharpHit& other) const {
        const Bounded<DoubleDouble> difference =
            Bounded<DoubleDouble>(other.t_, other.t_error_) - Bounded<DoubleDouble>(t_, t_error_);
        return difference.value.high > difference.error * (1.0 + 0x1p-50);
    }
    bool is_surely_at(const SharpHit& other) const {
        return t_error_ == 0.0 && other.t_error_ == 0.0 && t_.high == other.t_.high &&
               t_.low == other.t_.low;
    }

  private:
    template <class Shape>
    void widen(const Shape& shape, const LeavingRay& from) const {
        using Wide = Bounded<DoubleDouble>;
        Judge<Wide> judge;
        const Ray<Wide> wide{convert<Wide>(from.ray.origin), convert<Wide>(from.ray.direction)};
        const Crossings<Wide> found =
            crossings(shape, wide, from.origins.start_on(hit_.shape), judge);
        if (judge.doubt()) return; // the formulas may be others' then
        for (const Crossing<Wide>& crossing : found) {
            if (crossing.face != hit_.face || crossing.entering != hit_.entering) continue;
            if (!(crossing.t.error < hit_.error)) continue;
            t_ = crossing.t.value;
            t_error_ = crossing.t.error;
        }
    }

    Hit<double> hit_;
    mutable bool is_wide_ = false;
    mutable DoubleDouble t_;
    mutable double t_error_ = 0.0;
    mutable std::optional<ExactRoot> root_;
};

/// Orders the crossings of one ray: by intervals, then in double-double, then exactly.
class CrossingOrder {
  public:
    /// Counts comparisons if there are counters.
    CrossingOrder(const Scene& scene, const LeavingRay& from, OrderCounters* counters = nullptr)
        : scene_(scene), from_(from), counters_(counters) {}

    /// -1 if a comes first by its t, 0 if both are at the same t.
    int compare(const SharpHit& a, const SharpHit& b) const {
        if (a.hit().is_surely_before(b.hit())) return decided(&OrderCounters::by_bounds, -1);
        if (b.hit().is_surely_before(a.hit())) return decided(&OrderCounters::by_bounds, 1);
        a.widen(scene_, from_);
        b.widen(scene_, from_);
        if (a.is_surely_before(b)) return decided(&OrderCounters::by_digits, -1);
        if (b.is_surely_before(a)) return decided(&OrderCounters::by_digits, 1);
        if (a.is_surely_at(b)) return decided(&OrderCounters::by_digits, 0);
        return decided(&OrderCounters::exactly,
                       core::compare(a.root(scene_, from_), b.root(scene_, from_)));
    }
    /// Order of two hits. At the same t, what is entered comes before what is left, then the lower
    /// shape.
    bool is_before(const SharpHit& a, const SharpHit& b) const {
        const int order = compare(a, b);
        return order != 0 ? order < 0 : a.hit().precedes(b.hit());
    }

  private:
    int decided(std::uint64_t OrderCounters::*by, int order) const {
        if (counters_ != nullptr) ++(counters_->*by);
        return order;
    }

    const Scene& scene_;
    LeavingRay from_;
    OrderCounters* counters_;
};

} // namespace raylane::core
