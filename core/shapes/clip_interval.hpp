#pragma once

#include "core/shapes/judge.hpp"
#include "core/shapes/ray.hpp"

#include <utility>

namespace raylane::core {

/// The part of a line inside a convex solid, computed by clipping the line against one constraint
/// after the other. The result has an entry and an exit, or neither, so each ray that enters a
/// solid leaves it.
template <class Real>
class ClipInterval {
  public:
    explicit ClipInterval(Judge<Real>& judge) : judge_(judge) {}

    /// Restricts the inside to t >= `t`.
    void clip_front(const Real& t, Face face) {
        const Crossing<Real> front{t, face, true};
        if (!std::exchange(has_front_, true))
            front_ = front;
        else
            judge_.keep_last(front_, front);
    }

    /// Restricts the inside to t <= `t`.
    void clip_back(const Real& t, Face face) {
        const Crossing<Real> back{t, face, false};
        if (!std::exchange(has_back_, true))
            back_ = back;
        else
            judge_.keep_first(back_, back);
    }

    void clip_all() { empty_ = true; }

    /// Clips against 0 <= start + t slope <= end. The faces at 0 and at `end` are `low` and `high`.
    void clip_slab(const Real& start, const Real& slope, const Real& end, Face low, Face high) {
        if constexpr (requires { judge_.is_along(start, slope, end); })
            if (judge_.is_along(start, slope, end)) return;
        const int direction = judge_.sign(slope);
        if (direction == 0) {
            if (judge_.negative(start) || judge_.less(end, start)) clip_all();
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
        if constexpr (requires { judge_.settle(&front_, &back_); })
            judge_.settle(has_front_ ? &front_ : nullptr, has_back_ ? &back_ : nullptr);
        if (empty_ || !has_front_ || !has_back_ || judge_.less(back_.t, front_.t)) return {};
        return {front_, back_};
    }

    /// Returns only the far end, for a ray that starts on the surface and goes inward: it leaves,
    /// whatever the rounding.
    Crossings<Real> exit() const {
        return has_back_ ? Crossings<Real>({not_behind(back_.t), back_.face, false})
                         : Crossings<Real>();
    }

  private:
    Judge<Real>& judge_;
    Crossing<Real> front_{};
    Crossing<Real> back_{};
    bool has_front_ = false;
    bool has_back_ = false;
    bool empty_ = false;
};

} // namespace raylane::core
