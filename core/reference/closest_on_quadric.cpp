#include "core/reference/closest_on_quadric.hpp"

#include "core/numbers/nearest_between.hpp"
#include "core/numbers/polynomial_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace raylane::core {

namespace {

/// A plain double on the way from 0 to the root.
struct Trial {
    double distance; ///< from 0
    double slope;    ///< of g, with the sign that it has at 0 before the root; 0: unknown
};

/// Follows g from 0 towards its maximum, in plain doubles.
class RootSearch {
  public:
    explicit RootSearch(const Dual<double>& dual)
        : dual_(dual), forward_(dual.form().value > 0.0 ? 1.0 : -1.0) {}

    double root() {
        Trial before{0.0, std::abs(dual_.form().value)}, behind = bracket(before);
        if (!std::isfinite(behind.distance)) return std::numeric_limits<double>::quiet_NaN();
        // The rule of false position. It halves the value of an end that stays (Illinois), and
        // halves the interval if that does not suffice.
        int kept = 0;
        for (int step = 0; step < 200; ++step) {
            const double width = behind.distance - before.distance;
            if (!(width > 0x1p-51 * behind.distance)) break;
            double share = 0.5;
            if (behind.slope < 0.0 && step % 4 != 3)
                share = before.slope / (before.slope - behind.slope);
            const double at = before.distance + share * width;
            if (!(at > before.distance && at < behind.distance)) break;
            const Trial trial = at_distance(at);
            const int side = trial.slope > 0.0 ? 1 : -1;
            if (side > 0) {
                before = trial;
                if (kept > 0) behind.slope *= 0.5;
            } else {
                behind = trial;
                if (kept < 0) before.slope *= 0.5;
            }
            kept = side;
        }
        return forward_ * (before.slope < -behind.slope ? before.distance : behind.distance);
    }

  private:
    Trial at_distance(double distance) const {
        const double l = forward_ * distance;
        const std::array<double, 3> minors = dual_.minors(l);
        if (!(minors[0] > 0.0 && minors[1] > 0.0 && minors[2] > 0.0)) return {distance, 0.0};
        return {distance,
                forward_ * dual_.slope(l, minors[2], dual_.v(l)) / (minors[2] * minors[2])};
    }
    /// Returns a place behind the root. Moves `before` closer to the root.
    Trial bracket(Trial& before) const {
        const FormAbout<double>& form = dual_.form();
        const double squared = squared_length(form.slope);
        double distance = 0.5 * std::abs(form.value) / squared;
        if (!(distance < infinity<double>)) distance = 1.0 / largest_component(form.diagonal);
        for (int step = 0; step < 2000 && distance < infinity<double>; ++step, distance *= 2.0) {
            const Trial trial = at_distance(distance);
            if (!(trial.slope > 0.0)) return trial;
            before = trial;
        }
        return {infinity<double>, 0.0};
    }

    const Dual<double>& dual_;
    double forward_;
};

template <class T>
bool is_surely_positive(const Bounded<T>& a) {
    return static_cast<double>(a.value) > a.error;
}

/// Returns bits of a number's magnitude.
std::int64_t exponent_of(const Dyadic& number) {
    return number.approximately().exponent;
}

int order(const Rational& a, const Rational& b) {
    return (a - b).sign();
}
int order(const Rational& a, const Exact& b) {
    const Exact numerator(a.numerator);
    return compare(numerator, a.denominator.sign() == 0 ? b : b * Exact(a.denominator));
}

double double_of(const Rational& number) {
    return number.approximately().to_double();
}

} // namespace

double approximate_root(const Dual<double>& dual) {
    return RootSearch(dual).root();
}

template <class T>
std::optional<Bounded<T>> certain_root(const Dual<Bounded<T>>& dual, double approximation) {
    using Real = Bounded<T>;
    if (!std::isfinite(approximation) || approximation == 0.0) return {};
    constexpr bool is_wide = !std::is_same_v<T, double>;
    const auto slope_at = [&](const T& l) { return dual.slope(Real(l, 0.0)); };
    T l(approximation), other(approximation * (1.0 + 0x1p-30));
    Real at_l = slope_at(l), at_other = slope_at(other);
    const T steepness = (at_other.value - at_l.value) / (other - l);
    if constexpr (is_wide)
        for (int step = 0; step < 2; ++step) { // of the secant method
            const T next = l - at_l.value / steepness;
            l = next;
            at_l = slope_at(l);
        }
    const double reach = std::max((is_wide ? 0x1p-90 : 0x1p-44) * std::abs(approximation),
                                  2.0 * at_l.error / std::abs(static_cast<double>(steepness)));
    if (!(reach < 0.5 * std::abs(approximation))) return {};
    const T low = l - T(reach), high = l + T(reach);
    for (const T& end : {low, high})
        for (const Real& minor : dual.minors(Real(end, 0.0)))
            if (!is_surely_positive(minor)) return {};
    if (!is_surely_positive(slope_at(low)) || !is_surely_positive(-slope_at(high))) return {};
    return Real(l, reach * (1.0 + 0x1p-4));
}

template std::optional<Bounded<double>> certain_root(const Dual<Bounded<double>>&, double);
template std::optional<Bounded<DoubleDouble>> certain_root(const Dual<Bounded<DoubleDouble>>&,
                                                           double);

bool QuadricDistance::has_bits(int count) const {
    const Dyadic width = high_ - low_;
    if (width.sign() == 0) return true;
    return exponent_of(width) <= std::max(exponent_of(low_), exponent_of(high_)) - count;
}

/// Narrows the interval to a part of it, `left` to `right`, if the root is there, otherwise to the
/// part on one side (Abbott, "Quadratic interval refinement for real roots", 2014).
void QuadricDistance::step_to(const Dyadic& left, const Dyadic& right) {
    constexpr int most = 40; // less than the digits of the ratio of slopes
    const int of_left = side_of(left), of_right = side_of(right);
    if (of_left == 0 || of_right == 0) {
        low_ = high_ = of_left == 0 ? left : right;
        return;
    }
    const bool is_within = of_left > 0 && of_right < 0;
    gain_ = is_within ? std::min(2 * gain_, most) : std::max(gain_ / 2, 1);
    if (of_left > 0) low_ = is_within ? left : right;
    if (of_right < 0) high_ = is_within ? right : left;
}

bool QuadricDistance::refine() {
    if (has_bits(max_bits_)) return false;
    narrow();
    return true;
}

void QuadricDistance::narrow() {
    const Dyadic width = high_ - low_;
    if (!may_interpolate()) {
        const Dyadic middle = 0.5 * (low_ + high_);
        const int side = side_of(middle);
        if (side >= 0) low_ = middle;
        if (side <= 0) high_ = middle;
        return;
    }
    const Dyadic at_low = dual_.slope(low_);
    const Scaled part = at_low.approximately(),
                 whole = (at_low - dual_.slope(high_)).approximately();
    const double share =
        std::ldexp(part.value / whole.value, static_cast<int>(part.exponent - whole.exponent));
    const double parts = std::ldexp(1.0, gain_);
    const double number = std::clamp(std::floor(share * parts), 0.0, parts - 1.0);
    const Dyadic piece = width * Dyadic::power_of_2(-gain_);
    const Dyadic left = low_ + piece * number;
    step_to(left, left + piece);
}

int QuadricDistance::compare_with(const Exact& squared) {
    while (true) {
        const auto [lower, upper] = bounds();
        if (order(lower, squared) > 0) return 1;
        if (order(upper, squared) < 0) return -1;
        if (!refine()) return 0;
    }
}

/// Congruent surfaces in congruent places have the same N, of degree 6, and the same det, of degree
/// 3.
bool QuadricDistance::is_congruent_to(const QuadricDistance& other) const {
    for (int l = -3; l <= 3; ++l) {
        const Dyadic at = static_cast<double>(l);
        if (!(dual_.slope(at) == other.dual_.slope(at)) || !(dual_.det(at) == other.dual_.det(at)))
            return false;
    }
    return true;
}

int compare(QuadricDistance& a, QuadricDistance& b) {
    if (a.is_whole() && b.is_whole() && a.is_congruent_to(b)) return 0;
    while (true) {
        const auto of_a = a.bounds(), of_b = b.bounds();
        if (order(of_a[0], of_b[1]) > 0) return 1;
        if (order(of_a[1], of_b[0]) < 0) return -1;
        const bool is_narrower = a.refine();
        if (!b.refine() && !is_narrower) return 0;
    }
}

double QuadricDistance::nearest_distance() {
    constexpr double least = std::numeric_limits<double>::denorm_min();
    constexpr double most = std::numeric_limits<double>::max();
    while (!has_bits(60) && refine()) {
    }
    const auto [lower, upper] = bounds();
    const double low = double_of(lower), high = double_of(upper);
    if (high == 0.0) return 0.0;
    const bool is_usual = low > 0x1p-1000 && high < 0x1p1000;
    return nearest_between(is_usual ? std::sqrt(low) * (1.0 - 0x1p-44) : least,
                           is_usual ? std::sqrt(high) * (1.0 + 0x1p-44) : most,
                           [&](const Dyadic& sum) {
                               const Dyadic middle = 0.5 * sum;
                               return compare_with(Exact(middle * middle));
                           });
}

int QuadricDistance::compare_coordinate(int axis, const Dyadic& number) {
    const std::array<Dyadic, 4> cubic = dual_.coordinate(axis, point_[axis] - number);
    while (true) {
        if (const int sign = within(cubic, low_, high_).sign(); sign != 0) return det_sign_ * sign;
        if (!refine()) return 0;
    }
}

double QuadricDistance::nearest_coordinate(int axis) {
    const int sign = compare_coordinate(axis, 0.0);
    if (sign == 0 || sign * compare_coordinate(axis, static_cast<double>(sign) * tolerance_) <= 0)
        return 0.0;
    return sign * nearest_between(0.0, std::numeric_limits<double>::max(), [&](const Dyadic& sum) {
               return sign * compare_coordinate(axis, 0.5 * sign * sum);
           });
}

Vec3d QuadricDistance::nearest_point() {
    return {nearest_coordinate(0), nearest_coordinate(1), nearest_coordinate(2)};
}

WholeQuadricDistance::WholeQuadricDistance(const Dual<Dyadic>& dual, const Vec3<Dyadic>& point,
                                           const Dyadic& tolerance)
    : QuadricDistance(dual, point, 1000) {
    tolerance_ = tolerance;
    bracket();
}

bool WholeQuadricDistance::is_in_interval(const Dyadic& l) const {
    for (const Dyadic& minor : dual_.minors(l))
        if (minor.sign() <= 0) return false;
    return true;
}

/// The interval contains 0.
int WholeQuadricDistance::side_of(const Dyadic& l) const {
    return is_in_interval(l) ? dual_.slope(l).sign() : -l.sign();
}

/// Finds an interval from 0 to behind the root.
void WholeQuadricDistance::bracket() {
    const FormAbout<Dyadic>& form = dual_.form();
    const int forward = form.value.sign();
    if (forward == 0) return;
    const Dyadic squared = squared_length(form.slope);
    std::int64_t exponent =
        squared.sign() != 0 ? exponent_of(form.value) - exponent_of(squared)
                            : -std::max({exponent_of(form.diagonal.x), exponent_of(form.diagonal.y),
                                         exponent_of(form.diagonal.z)});
    for (std::int64_t step = 1; step < 1 << 14; step *= 2, exponent += step) {
        const Dyadic power = Dyadic::power_of_2(static_cast<int>(exponent));
        const Dyadic end = forward > 0 ? power : -power;
        const int side = side_of(end);
        if (side == forward) continue;
        (forward > 0 ? high_ : low_) = end;
        if (side == 0) low_ = high_ = end;
        return;
    }
    exists_ = false;
}

/// g at an end of the interval, and g plus the most by which its tangent there rises within it:
/// g is concave.
std::array<Rational, 2> WholeQuadricDistance::bounds() const {
    if (dual_.form().value.sign() == 0) return {};
    const Dyadic& end = is_in_interval(low_) ? low_ : high_;
    const Dyadic det = dual_.det(end);
    const Vec3<Dyadic> v = dual_.v(end);
    const Rational value{end * dual_.form().value * det - end * end * dot(dual_.form().slope, v),
                         det};
    return {value,
            value + Rational{magnitude(dual_.slope(end, det, v)) * (high_ - low_), det * det}};
}

/// The root is then closer to the end of the interval than doubles can put it: their exponents
/// differ by less than 2200.
bool WholeQuadricDistance::has_several_points() {
    for (; !is_inside(); narrow())
        if (has_bits(2400)) return true;
    return false;
}

/// If several points are closest, moves the given point by 2^-300 of the distance: one point is
/// then the closest, and as close to one of the several.
Vec3d WholeQuadricDistance::nearest_point() {
    if (!has_several_points()) return QuadricDistance::nearest_point();
    const Scaled squared = bounds()[1].approximately();
    const int size = static_cast<int>(squared.exponent / 2);
    const Dyadic tiny = Dyadic::power_of_2(size - 300);
    const Vec3<Dyadic> step(tiny, 0.75 * tiny, 0.625 * tiny);
    WholeQuadricDistance beside(Dual<Dyadic>(moved(dual_.form(), step)), point_,
                                Dyadic::power_of_2(size - 200));
    return beside.QuadricDistance::nearest_point();
}

std::unique_ptr<QuadricDistance> exact_distance(const EllipsoidOf<double>& ellipsoid,
                                                const Vec3d& point) {
    const auto exact = convert<Dyadic>(point);
    return std::make_unique<WholeQuadricDistance>(Dual<Dyadic>(form_about(ellipsoid, exact)),
                                                  exact);
}

} // namespace raylane::core
