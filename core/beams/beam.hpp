#pragma once

#include "core/numbers/affine.hpp"
#include "core/numbers/float4.hpp"
#include "core/shapes/bounds.hpp"
#include "core/shapes/error_predicate.hpp"
#include "core/shapes/shape_table.hpp"

#include <cstring>
#include <limits>
#include <utility>

/// Bundles of rays that are traced as one: a statement about a beam holds for each of its rays.
namespace raylane::core {

/// ErrorPredicate of all rays of a beam. An answer that differs between rays is a doubt. The answer
/// in doubt is that of the middle ray; or, to bound t from below, the answer of a ray that hits.
template <>
class ErrorPredicate<Affine> {
  public:
    ErrorPredicate() = default;
    static ErrorPredicate that_lets_none_miss() {
        ErrorPredicate predicate;
        predicate.lets_none_miss_ = true;
        return predicate;
    }

    static constexpr bool textbook() { return false; }

    int sign(const Affine& a) {
        if (!(std::abs(a.value) > a.spread())) doubt_ |= a.value != 0.0 || a.spread() != 0.0;
        return a.value > 0.0 ? 1 : a.value < 0.0 ? -1 : 0;
    }
    bool negative(const Affine& a) { return lets_none_miss_ ? a.upper() < 0.0 : sign(a) < 0; }
    bool positive(const Affine& a) { return sign(a) > 0; }
    bool less(const Affine& a, const Affine& b) { return negative(a - b); }
    bool doubt() const { return doubt_; }

    /// A doubt that concerns one crossing alone sets the error of that crossing to infinity.
    static bool is_doubtful(const Crossing<Affine>& crossing) { return !(crossing.error == 0.0); }
    void keep_first(Crossing<Affine>& kept, const Crossing<Affine>& other) {
        keep(kept, other, kept.t - other.t, [](double a, double b) { return std::min(a, b); });
    }
    void keep_last(Crossing<Affine>& kept, const Crossing<Affine>& other) {
        keep(kept, other, other.t - kept.t, [](double a, double b) { return std::max(a, b); });
    }
    /// Returns true if rays start between two planes and some of them may go to either plane. Such
    /// rays enter before they start, and leave no earlier than `out_after_`.
    bool is_along(const Affine& start, const Affine& slope, const Affine& end) {
        const Affine rest = end - start;
        if (std::abs(slope.value) > slope.spread() || !(start.lower() > 0.0) ||
            !(rest.lower() > 0.0))
            return false;
        out_after_ =
            std::min(out_after_, 0.999 * std::min(start.lower(), rest.lower()) / slope.magnitude());
        return true;
    }
    /// Checks that the rest of a line is within `out_after_`. Null: the line has no such end.
    void settle(const Crossing<Affine>* in, const Crossing<Affine>* out) {
        if (out_after_ == std::numeric_limits<double>::infinity()) return;
        doubt_ |= in == nullptr || out == nullptr || !(in->t.lower() > 0.0) ||
                  !(out->t.upper() < out_after_);
    }
    template <class IsIn>
    bool counts(Crossing<Affine>& crossing, const IsIn& is_in) {
        const bool before = std::exchange(doubt_, false);
        const bool counts = is_in(crossing);
        if (!std::exchange(doubt_, before)) return counts;
        crossing.error = std::numeric_limits<double>::infinity();
        return true;
    }

  private:
    /// Keeps `other` if `better`, the amount by which it is better, is positive. If the sign is in
    /// doubt, keeps bounds on `best_of` of both.
    template <class BestOf>
    static void keep(Crossing<Affine>& kept, const Crossing<Affine>& other, const Affine& better,
                     const BestOf& best_of) {
        if (better.upper() <= 0.0) return;
        if (better.lower() >= 0.0) {
            kept = other;
            return;
        }
        const double lower = best_of(kept.t.lower(), other.t.lower());
        const double upper = best_of(kept.t.upper(), other.t.upper());
        kept.t = {0.5 * (lower + upper), 0.0, 0.0,
                  0.5 * (upper - lower) + affine::roundoff(std::abs(lower) + std::abs(upper))};
        kept.error = std::numeric_limits<double>::infinity();
    }

    bool lets_none_miss_ = false;
    bool doubt_ = false;
    double out_after_ = std::numeric_limits<double>::infinity();
};

/// Rays whose origins and directions depend on two parameters.
using Beam = Ray<Affine>;

/// A beam as an axis and a bound on the distance of its rays from the axis. Finds balls that the
/// beam certainly misses, in a fraction of the time that their crossings take.
class BeamCone {
  public:
    explicit BeamCone(const Beam& beam);

    /// Returns true if no ray meets a ball at t >= 0. The point of each ray at t is within width +
    /// t growth of the axis' point at t. If the ray's point is in the ball, the axis' point is
    /// therefore in a larger ball, and t is not above `last`.
    bool misses(const Vec3d& center, double r) const {
        const Vec3d to_center = center - origin_;
        const double squared = squared_length(to_center), along = dot(to_center, direction_);
        const double last = (along * per_speed_ + r + width_) * per_approach_;
        const double reach = r + width_ + growth_ * std::max(last, 0.0);
        const double foot = squared - along * along * per_speed_ * per_speed_;
        constexpr double safely = 1.0 + 0x1p-40;
        return foot - 0x1p-45 * squared > reach * reach * safely || last < -0x1p-40 * reach;
    }

  private:
    Vec3d origin_, direction_;
    double width_, growth_;
    double per_speed_, per_approach_; // 1 / |direction|, 1 / (|direction| - growth)
};

/// Boxes of a block's shapes, laid out like a WideNode's boxes of its children.
struct alignas(64) BlockBounds {
    float lower[3][block_size];
    float upper[3][block_size];
};

/// Tells which boxes a beam may meet. Each axis bounds t by two lines, as a ray's slabs do.
/// Computes in float and rounds to the safe side.
class BeamSlabs {
  public:
    explicit BeamSlabs(const Beam& beam);

    /// Computes lower bounds on t for boxes that the beam may meet, and infinity for boxes that it
    /// misses. `Boxes` has lower and upper[3][block_size].
    template <class Boxes>
    void near(const Boxes& boxes, float (&near)[block_size]) const {
        for (int first = 0; first < block_size; first += 4) {
            const Float4 t = near4(boxes.lower, boxes.upper, first);
            std::memcpy(near + first, &t, sizeof t);
        }
    }

    /// Same, for one box.
    float near(const Bounds& box) const;

  private:
    /// t speed >= way: t >= way / speed or, for a negative speed, t <= way / speed.
    struct Line {
        float per_speed;
        bool rises;

        void bound(const Float4& way, Float4& enters, Float4& leaves) const {
            const Float4 t = way * all4(per_speed);
            if (rises)
                enters = greatest(t, enters);
            else
                leaves = least(t, leaves);
        }
    };
    static Line line(double speed);

    Float4 near4(const float (&lower)[3][block_size], const float (&upper)[3][block_size],
                 int first) const {
        Float4 enters = all4(0.0F), leaves = all4(std::numeric_limits<float>::infinity());
        for (int axis = 0; axis < 3; ++axis) {
            Float4 low, high;
            std::memcpy(&low, lower[axis] + first, sizeof low);
            std::memcpy(&high, upper[axis] + first, sizeof high);
            fastest_[axis].bound(low - all4(highest_[axis]), enters, leaves);
            slowest_[axis].bound(all4(lowest_[axis]) - high, enters, leaves);
        }
        // Each bound was rounded a few times.
        enters *= all4(1.0F - 0x1p-20F);
        return enters <= leaves * all4(1.0F + 0x1p-20F)
                   ? enters
                   : all4(std::numeric_limits<float>::infinity());
    }

    float lowest_[3], highest_[3]; // of the origin
    Line slowest_[3], fastest_[3]; // of the direction
};

} // namespace raylane::core
