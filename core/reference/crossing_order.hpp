#pragma once

#include "core/numbers/bounded.hpp"
#include "core/numbers/double_double.hpp"
#include "core/numbers/exact_root.hpp"
#include "core/reference/counters.hpp"
#include "core/reference/origin_surfaces.hpp"

#include <optional>

/// Orders a ray's crossings with any shapes as real arithmetic does. Two crossings have the same t
/// only if real arithmetic says so.
namespace raylane::core {

/// A ray that starts on no surface, or on known ones.
struct LeavingRay {
    const Ray<double>& ray;
    const OriginSurfaces<double>& origins;
};

/// A crossing whose t can be computed more accurately on demand.
class SharpHit {
  public:
    SharpHit(const Hit<double>& hit) : hit_(hit) {} // NOLINT: implicit
    /// A hit whose t is known in 106 bits, if that has a smaller error.
    SharpHit(const Hit<double>& hit, const DoubleDouble& t, double error) : hit_(hit) {
        if (!(error < hit.error)) return;
        is_wide_ = true;
        t_ = t;
        t_error_ = error;
    }

    const Hit<double>& hit() const { return hit_; }
    /// Computes t in 106 bits, if that has a smaller error.
    void widen(const Scene& scene, const LeavingRay& from) const;
    /// Returns the hit with t rounded from 106 bits, if it has been widened and if that is more
    /// accurate.
    Hit<double> sharpened() const {
        const Bounded<double> t = in_double(wide_t());
        Hit<double> result = hit_;
        if (!(t.error < hit_.error)) return result;
        result.t = t.value;
        result.error = t.error;
        return result;
    }
    /// Returns t as accurately as it is known.
    Bounded<DoubleDouble> wide_t() const {
        return is_wide_ ? Bounded<DoubleDouble>(t_, t_error_)
                        : Bounded<DoubleDouble>(hit_.t, hit_.error);
    }
    /// Returns t as an exact root.
    const ExactRoot& root(const Scene& scene, const LeavingRay& from) const;

    /// Returns true if this hit is certainly before `other`. Both must have been widened.
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
    /// Counts comparisons if `counters` is not null.
    CrossingOrder(const Scene& scene, const LeavingRay& from, OrderCounters* counters = nullptr)
        : scene_(scene), from_(from), counters_(counters) {}

    /// Compares by t: -1 if a comes first, 0 if both are at the same t, 1 if b comes first.
    int compare(const SharpHit& a, const SharpHit& b) const;
    /// Returns true if a comes before b. At the same t, entering comes before leaving, then the
    /// lower shape id comes first.
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
