#pragma once

#include "core/shapes/error_predicate.hpp"
#include "core/shapes/ray.hpp"

#include <utility>

namespace raylane::core {

/// The part of a line inside a convex solid, computed by clipping the line against one constraint
/// after the other. The result has an entry and an exit, or neither, so each ray that enters a
/// solid leaves it.
template <class Real>
class ClipInterval {
  public:
    explicit ClipInterval(ErrorPredicate<Real>& predicate) : predicate_(predicate) {}

    /// Restricts the inside to t >= `t`.
    void clip_front(const Real& t, Face face) {
        const Crossing<Real> front{t, face, true};
        if (!std::exchange(has_front_, true))
            front_ = front;
        else
            predicate_.keep_last(front_, front);
    }

    /// Restricts the inside to t <= `t`.
    void clip_back(const Real& t, Face face) {
        const Crossing<Real> back{t, face, false};
        if (!std::exchange(has_back_, true))
            back_ = back;
        else
            predicate_.keep_first(back_, back);
    }

    void clip_all() { empty_ = true; }

    /// Clips against 0 <= start + t slope <= end. The faces at 0 and at `end` are `low` and `high`.
    void clip_slab(const Real& start, const Real& slope, const Real& end, Face low, Face high) {
        if constexpr (requires { predicate_.is_along(start, slope, end); })
            if (predicate_.is_along(start, slope, end)) return;
        const int direction = predicate_.sign(slope);
        if (direction == 0) {
            if (predicate_.negative(start) || predicate_.less(end, start)) clip_all();
            return;
        }
        const Divisor<Real> by_slope(slope);
        const Real at_low = Real(-start) / by_slope;
        const Real at_high = Real(end - start) / by_slope;
        clip_front(direction > 0 ? at_low : at_high, direction > 0 ? low : high);
        clip_back(direction > 0 ? at_high : at_low, direction > 0 ? high : low);
    }

    /// Returns both ends if the interval is not empty. A solid is bounded, so a part of it has two
    /// ends.
    Crossings<Real> crossings() const {
        if constexpr (requires { predicate_.settle(&front_, &back_); })
            predicate_.settle(has_front_ ? &front_ : nullptr, has_back_ ? &back_ : nullptr);
        if (empty_ || !has_front_ || !has_back_ || predicate_.less(back_.t, front_.t)) return {};
        return {front_, back_};
    }

    /// Returns only the far end, for a ray that starts on the surface and goes inward: it leaves,
    /// whatever the rounding.
    Crossings<Real> exit() const {
        return has_back_ ? Crossings<Real>({not_behind(back_.t), back_.face, false})
                         : Crossings<Real>();
    }

  private:
    ErrorPredicate<Real>& predicate_;
    Crossing<Real> front_{};
    Crossing<Real> back_{};
    bool has_front_ = false;
    bool has_back_ = false;
    bool empty_ = false;
};

} // namespace raylane::core
