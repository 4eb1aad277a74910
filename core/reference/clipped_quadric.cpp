#include "core/numbers/polynomial_bounds.hpp"
#include "core/reference/closest_on_quadric.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

/// Closest points of quadrics that end at their boxes: all points at which the distance is
/// stationary, on the surface, on the curves where it meets a face of the box, and where these meet
/// an edge of the box.
namespace raylane::core {

namespace {

using Polynomial = std::vector<Dyadic>; // coefficient k is that of x^k

template <class A, class B>
Polynomial product(const A& a, const B& b) {
    Polynomial result(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
            result[i + j] = result[i + j] + a[i] * b[j];
    return result;
}

void add(Polynomial& to, const Polynomial& other, const Dyadic& factor, std::size_t shift = 0) {
    if (to.size() < other.size() + shift) to.resize(other.size() + shift);
    for (std::size_t i = 0; i < other.size(); ++i)
        to[i + shift] = to[i + shift] + factor * other[i];
}

/// Removes leading coefficients that are 0.
void trim(Polynomial& polynomial) {
    while (!polynomial.empty() && polynomial.back().sign() == 0)
        polynomial.pop_back();
}

/// Substitutes x + 1 for x.
void shift_by_1(Polynomial& p) {
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
        for (std::size_t j = p.size() - 1; j-- > i;)
            p[j] = p[j] + p[j + 1];
}

/// Returns the number of sign changes in (1 + x)^n p(1 / (1 + x)): by Descartes' rule of signs, p
/// has no more roots between 0 and 1, and exactly one if the number is 1.
int sign_changes(Polynomial p) {
    std::reverse(p.begin(), p.end());
    shift_by_1(p);
    int changes = 0, last = 0;
    for (const Dyadic& coefficient : p) {
        const int sign = coefficient.sign();
        if (sign == 0) continue;
        if (last != 0 && sign != last) ++changes;
        last = sign;
    }
    return changes;
}

struct Interval {
    Dyadic low, high;
};

/// Isolates real roots by Descartes' rule and bisection (Collins and Akritas, "Polynomial real root
/// isolation using Descartes' rule of signs", 1976).
class RootIsolation {
  public:
    /// Isolates the roots of a polynomial that is not 0.
    RootIsolation(Polynomial polynomial, int max_depth) : whole_(std::move(polynomial)) {
        trim(whole_);
        if (whole_.size() < 2) return;
        if (whole_[0].sign() == 0) roots_.push_back({0.0, 0.0});
        for (const double side : {1.0, -1.0}) {
            const Dyadic end = side * Dyadic::power_of_2(root_exponent());
            Polynomial scaled = whole_;
            Dyadic power = 1.0;
            for (Dyadic& coefficient : scaled) {
                coefficient = coefficient * power;
                power = power * end;
            }
            while (scaled[0].sign() == 0)
                scaled.erase(scaled.begin());
            isolate(scaled, 0.0, end, max_depth);
        }
    }
    /// Returns false if roots are so close that they may be equal.
    bool is_complete() const { return is_complete_; }
    const std::vector<Interval>& roots() const { return roots_; }

  private:
    /// Returns an exponent of a power of 2 beyond all roots (Fujiwara's bound).
    int root_exponent() const {
        const std::size_t n = whole_.size() - 1;
        std::int64_t most = -(1 << 20);
        for (std::size_t i = 1; i <= n; ++i) {
            if (whole_[n - i].sign() == 0) continue;
            const std::int64_t quotient =
                whole_[n - i].approximately().exponent - whole_[n].approximately().exponent + 1;
            const auto degree = static_cast<std::int64_t>(i);
            most = std::max(most, (quotient >= 0 ? quotient + degree - 1 : quotient) / degree);
        }
        return static_cast<int>(most) + 1;
    }
    Dyadic value_at(const Dyadic& x) const {
        Dyadic value = whole_.back();
        for (std::size_t k = whole_.size() - 1; k-- > 0;)
            value = value * x + whole_[k];
        return value;
    }
    /// `p`: the polynomial, scaled so that the interval is from 0 to 1. `width` may be negative.
    void isolate(const Polynomial& p, const Dyadic& from, const Dyadic& width, int depth) {
        const int changes = sign_changes(p);
        if (changes == 0) return;
        const Dyadic to = from + width;
        if (changes == 1 && value_at(from).sign() != 0 && value_at(to).sign() != 0) {
            roots_.push_back(width.sign() > 0 ? Interval{from, to} : Interval{to, from});
            return;
        }
        if (depth == 0) {
            is_complete_ = false;
            return;
        }
        Polynomial half = p;
        for (std::size_t i = 0; i < p.size(); ++i)
            half[i] = half[i] * Dyadic::power_of_2(-static_cast<int>(i));
        const Dyadic half_width = 0.5 * width;
        isolate(half, from, half_width, depth - 1);
        shift_by_1(half);
        if (half[0].sign() == 0) {
            roots_.push_back({from + half_width, from + half_width});
            half.erase(half.begin());
        }
        isolate(half, from + half_width, half_width, depth - 1);
    }

    Polynomial whole_;
    std::vector<Interval> roots_;
    bool is_complete_ = true;
};

/// N, as a polynomial.
Polynomial slope_polynomial(const Dual<Dyadic>& dual) {
    const FormAbout<Dyadic>& form = dual.form();
    const auto det = dual.det_polynomial();
    Polynomial v[3], along(3), result;
    for (int axis = 0; axis < 3; ++axis) {
        const std::array<Dyadic, 4> shifted = dual.coordinate(axis, 0.0); // -l v
        for (std::size_t k = 1; k < 4; ++k) {
            v[axis].push_back(-shifted[k]);
            along[k - 1] = along[k - 1] + form.slope[axis] * v[axis].back();
        }
    }
    add(result, product(det, det), form.value);
    add(result, product(along, det), -1.0, 1);
    for (const Polynomial& component : v)
        add(result, product(component, component), -1.0, 1);
    return result;
}

/// Removes the factors that det and v have in common for any point, if A has equal eigenvalues that
/// are among its diagonal, as those of surfaces of revolution about a coordinate axis.
void remove_factors(Dual<Dyadic>& dual) {
    const FormAbout<Dyadic>& form = dual.form();
    for (int axis = 0; axis < 3; ++axis) {
        const Dyadic m = form.diagonal[axis];
        FormAbout<Dyadic> rest = form;
        rest.diagonal = form.diagonal - Vec3<Dyadic>(m);
        const Dual<Dyadic> of_rest(rest);
        const FormAbout<Dyadic> adjugate = of_rest.adjugate();
        const auto vanishes = [](const Vec3<Dyadic>& v) {
            return v.x.sign() == 0 && v.y.sign() == 0 && v.z.sign() == 0;
        };
        if (vanishes(rest.diagonal) && vanishes(rest.mixed)) return dual.remove_both_factors(m);
        if (vanishes(adjugate.diagonal) && vanishes(adjugate.mixed)) return dual.remove_factor(m);
    }
}

/// The distance at a root of N, of points that are `beside` from a face or an edge of the box.
class StationaryDistance : public QuadricDistance {
  public:
    StationaryDistance(const Dual<Dyadic>& dual, const Vec3<Dyadic>& point, Dyadic beside_squared,
                       const Interval& root, const Dyadic& tolerance, int max_bits)
        : QuadricDistance(dual, point, max_bits), beside_squared_(std::move(beside_squared)) {
        tolerance_ = tolerance;
        low_ = root.low;
        high_ = root.high;
        sign_at_low_ = dual_.slope(low_).sign();
        const auto det = dual_.det_polynomial();
        Polynomial v_squared;
        for (int axis = 0; axis < 3; ++axis) {
            const std::array<Dyadic, 4> component = dual_.coordinate(axis, 0.0);
            add(v_squared, product(component, component), 1.0);
        }
        numerator_ = v_squared;
        denominator_ = product(det, det);
    }

    /// Narrows the root until the sign of det is certain. Returns false if it is not.
    bool find_det_sign() {
        do {
            det_sign_ = within(dual_.det_polynomial(), low_, high_).sign();
        } while (det_sign_ == 0 && refine());
        return det_sign_ != 0;
    }
    std::array<Rational, 2> bounds() const override {
        const Within top = within(numerator_, low_, high_);
        const Within bottom = within(denominator_, low_, high_);
        const Dyadic least = bottom.value - bottom.error;
        const Dyadic lowest = top.value - top.error;
        const Rational beside{beside_squared_, {}};
        const Rational lower =
            lowest.sign() > 0 ? Rational{lowest, bottom.value + bottom.error} : Rational{};
        // An infinite upper bound does not occur once the root is narrow.
        const Rational upper = least.sign() > 0 ? Rational{top.value + top.error, least}
                                                : Rational{Dyadic::power_of_2(1 << 20), {}};
        return {lower + beside, upper + beside};
    }

  private:
    int side_of(const Dyadic& l) const override { return sign_at_low_ * dual_.slope(l).sign(); }
    bool may_interpolate() const override { return true; }

    Dyadic beside_squared_;
    int sign_at_low_;
    Polynomial numerator_, denominator_; // of |y|^2
};

/// Finds the closest of the stationary points.
class StationarySearch {
  public:
    /// `tolerance`: the most by which a point may be outside of the box.
    StationarySearch(const QuadricOf<double>& quadric, const FormAbout<Dyadic>& form,
                     const Vec3<Dyadic>& point, Dyadic tolerance, int max_depth, int max_bits)
        : form_(form), point_(point), tolerance_(std::move(tolerance)), max_depth_(max_depth),
          max_bits_(max_bits) {
        for (int axis = 0; axis < 3; ++axis) {
            const double limits[] = {quadric.lower[axis], quadric.upper[axis]};
            for (int end = 0; end < 2; ++end)
                if (std::isfinite(limits[end]))
                    limits_[axis][end] = Dyadic(quadric.center[axis]) + limits[end];
        }
        look_on(0, {});
    }
    bool is_complete() const { return is_complete_; }
    std::unique_ptr<QuadricDistance> closest() { return std::move(closest_); }

  private:
    const std::optional<Dyadic>& limit(int axis, int end) const {
        return limits_[axis][end < 0 ? 0 : 1];
    }
    void look_on(int axis, BoxEnds ends) {
        if (axis == 3) return look_at(ends);
        look_on(axis + 1, ends);
        for (const int end : {-1, 1})
            if (limit(axis, end)) {
                ends[static_cast<std::size_t>(axis)] = end;
                look_on(axis + 1, ends);
            }
    }
    /// Looks for stationary points with some coordinates fixed. Corners of the box are ends of
    /// edges.
    void look_at(const BoxEnds& ends) {
        Vec3<Dyadic> beside(0.0), at = point_;
        int count = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const int end = ends[static_cast<std::size_t>(axis)];
            if (end == 0) continue;
            ++count;
            at[axis] = *limit(axis, end);
            beside[axis] = at[axis] - point_[axis];
        }
        if (count == 3) return;
        Dual<Dyadic> dual(restricted(form_, ends, beside));
        remove_factors(dual);
        Polynomial slope = slope_polynomial(dual);
        trim(slope);
        Polynomial det(4);
        std::ranges::copy(dual.det_polynomial(), det.begin());
        trim(det);
        if (slope.empty()) return; // all or none of the face is on the surface
        // A surface without a normal at a point, where l is infinite.
        if (slope.size() - 1 < 2 * (det.size() - 1)) is_complete_ = false;
        const RootIsolation isolation(slope, max_depth_);
        is_complete_ = is_complete_ && isolation.is_complete();
        for (const Interval& root : isolation.roots())
            keep_closer(std::make_unique<StationaryDistance>(dual, at, squared_length(beside), root,
                                                             tolerance_, max_bits_),
                        ends);
    }
    void keep_closer(std::unique_ptr<StationaryDistance> other, const BoxEnds& ends) {
        if (!other->find_det_sign()) {
            is_complete_ = false;
            return;
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (ends[static_cast<std::size_t>(axis)] != 0) continue;
            for (const int end : {-1, 1}) {
                const std::optional<Dyadic>& ends_at = limit(axis, end);
                const double side = end;
                if (ends_at &&
                    end * other->compare_coordinate(axis, *ends_at + side * tolerance_) > 0)
                    return;
            }
        }
        if (closest_ == nullptr || compare(*other, *closest_) < 0) closest_ = std::move(other);
    }

    FormAbout<Dyadic> form_;
    Vec3<Dyadic> point_;
    Dyadic tolerance_;
    int max_depth_, max_bits_;
    std::optional<Dyadic> limits_[3][2];
    bool is_complete_ = true;
    std::unique_ptr<QuadricDistance> closest_;
};

bool is_clipped(const QuadricOf<double>& quadric) {
    for (int axis = 0; axis < 3; ++axis)
        if (std::isfinite(quadric.lower[axis]) || std::isfinite(quadric.upper[axis])) return true;
    return false;
}

/// Returns true if the only closest point of the whole surface is in the box.
bool is_in_box(WholeQuadricDistance& search, const QuadricOf<double>& quadric) {
    for (int axis = 0; axis < 3; ++axis)
        for (const double limit : {quadric.lower[axis], quadric.upper[axis]}) {
            if (std::isinf(limit)) continue;
            const int side = search.compare_coordinate(axis, Dyadic(quadric.center[axis]) + limit);
            if (limit == quadric.lower[axis] ? side < 0 : side > 0) return false;
        }
    return true;
}

/// Returns an exponent of the size of a quadric, as seen from a point.
int size_exponent(const QuadricOf<double>& quadric, const Vec3<Dyadic>& point) {
    std::int64_t most = -(1 << 20);
    const auto include = [&](const Dyadic& number) {
        if (number.sign() != 0) most = std::max(most, number.approximately().exponent);
    };
    for (int axis = 0; axis < 3; ++axis) {
        include(point[axis] - Dyadic(quadric.center[axis]));
        for (const double limit : {quadric.lower[axis], quadric.upper[axis]})
            if (std::isfinite(limit)) include(limit);
    }
    return most == -(1 << 20) ? 0 : static_cast<int>(most);
}

/// Finds the closest point where several are, or where the surface has no normal: moves the point
/// and the surface by 2^-256 of their size, to both sides.
std::unique_ptr<QuadricDistance> closest_nearby(const QuadricOf<double>& quadric,
                                                const FormAbout<Dyadic>& form,
                                                const Vec3<Dyadic>& point) {
    const int size = size_exponent(quadric, point);
    const Dyadic tiny = Dyadic::power_of_2(size - 256);
    const Vec3<Dyadic> step(tiny, 0.75 * tiny, 0.625 * tiny);
    const double scale = std::max(largest_component(Vec3d(quadric.xx, quadric.yy, quadric.zz)),
                                  largest_component(Vec3d(quadric.yz, quadric.xz, quadric.xy)));
    std::unique_ptr<QuadricDistance> closest;
    for (const double side : {1.0, -1.0}) {
        FormAbout<Dyadic> changed = moved(form, step);
        changed.value = changed.value + side * scale * (tiny * tiny);
        StationarySearch search(quadric, changed, point + step, Dyadic::power_of_2(size - 200),
                                2500, 1000);
        std::unique_ptr<QuadricDistance> found = search.closest();
        if (found != nullptr && (closest == nullptr || compare(*found, *closest) < 0))
            closest = std::move(found);
    }
    return closest;
}

} // namespace

std::unique_ptr<QuadricDistance> exact_distance(const QuadricOf<double>& quadric,
                                                const Vec3d& from) {
    const auto point = convert<Dyadic>(from);
    const FormAbout<Dyadic> form = form_about(quadric, point);
    auto unbounded = std::make_unique<WholeQuadricDistance>(Dual<Dyadic>(form), point);
    if (unbounded->exists()) {
        if (!is_clipped(quadric)) return unbounded;
        if (!unbounded->has_several_points() && is_in_box(*unbounded, quadric)) return unbounded;
    }
    StationarySearch search(quadric, form, point, 0.0, 300, 256);
    return search.is_complete() ? search.closest() : closest_nearby(quadric, form, point);
}

} // namespace raylane::core
