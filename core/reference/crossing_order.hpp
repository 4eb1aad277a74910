#pragma once

#include "core/numbers/bounded.hpp"
#include "core/numbers/double_double.hpp"
#include "core/numbers/exact_root.hpp"
#include "core/reference/counters.hpp"
#include "core/reference/origin_surfaces.hpp"

#include <optional>

/// Order of a ray's crossings, whatever they are crossings with: as real arithmetic says. Two are
/// at the same t where that says so, and nowhere else.
namespace raylane::core {

/// A ray that starts on no surface, or on known ones.
struct LeavingRay {
    const Ray<double>& ray;
    const OriginSurfaces<double>& origins;
};

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
    void widen(const Scene& scene, const LeavingRay& from) const;
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
    const ExactRoot& root(const Scene& scene, const LeavingRay& from) const;

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
    void widen(const Shape& shape, const LeavingRay& from) const;

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
    int compare(const SharpHit& a, const SharpHit& b) const;
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
