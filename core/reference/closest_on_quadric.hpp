#pragma once

#include "core/shapes/closest_point.hpp"
#include "core/shapes/shapes.hpp"

#include <memory>
#include <optional>
#include <type_traits>

/// The closest point of a surface of second degree.
///
/// Let F(p + y) = y . A y + 2 q . y + s be the surface's form, and p the given point. Its
/// Lagrangian |y|^2 + l F(p + y) is stationary where (I + l A) y = -l q, that is, at
///   y(l) = -l v(l) / det(l),  det(l) = det(I + l A),  v(l) = adj(I + l A) q,
/// and it is then
///   g(l) = |y(l)|^2 + l g'(l),  g'(l) = F(p + y(l)) = N(l) / det(l)^2,
///   N = s det^2 - l (q . v) det - l |v|^2,
/// of which v = q + l (tr(A) q - A q) + l^2 adj(A) q follows from the theorem of Cayley and
/// Hamilton, and N from (I + l A) v = det q.
///
/// In an interval around l = 0, I + l A is positive definite, and the Lagrangian is convex.
/// So g(l) is its minimum: g is concave, and at most the squared distance of any point with F = 0.
/// Its maximum is that distance (Moré, "Generalizations of the trust region problem", 1993). At the
/// root of N in this interval, p + y is the only closest point. Without a root there, the maximum
/// is at an end of the interval, and several points are closest.
namespace raylane::core {

/// The form of a surface of second degree about a point.
template <class Real>
struct FormAbout {
    Vec3<Real> diagonal; ///< xx, yy and zz of A
    Vec3<Real> mixed;    ///< yz, xz and xy of A
    Vec3<Real> slope;    ///< q
    Real value;          ///< s

    Vec3<Real> product(const Vec3<Real>& v) const {
        return {dot(Vec3<Real>(diagonal.x, mixed.z, mixed.y), v),
                dot(Vec3<Real>(mixed.z, diagonal.y, mixed.x), v),
                dot(Vec3<Real>(mixed.y, mixed.x, diagonal.z), v)};
    }
};

template <class Real, class Number>
FormAbout<Real> form_about(const EllipsoidOf<Number>& ellipsoid, const Vec3<Real>& point) {
    const ToBall<Real> to_ball(ellipsoid);
    const auto& [a, b, c] = to_ball.rows;
    const auto sum = [&](int i, int j) -> Real {
        return mul_add(a[i], a[j], mul_add(b[i], b[j], Real(c[i] * c[j])));
    };
    const Vec3<Real> in_ball = to_ball(Vec3<Real>(point - convert<Real>(ellipsoid.center)));
    return {{sum(0, 0), sum(1, 1), sum(2, 2)},
            {sum(1, 2), sum(0, 2), sum(0, 1)},
            to_ball.normal(in_ball),
            ball_at(in_ball, to_ball.radius)};
}

template <class Real, class Number>
FormAbout<Real> form_about(const QuadricOf<Number>& q, const Vec3<Real>& point) {
    const Vec3<Real> f = point - convert<Real>(q.center);
    return {{Real(q.xx), Real(q.yy), Real(q.zz)},
            {Real(q.yz), Real(q.xz), Real(q.xy)},
            quadric_half_gradient(q, f),
            quadric_value(q, f)};
}

/// The polynomials det, v and N.
template <class Real>
class Dual {
  public:
    explicit Dual(const FormAbout<Real>& form) : form_(form) {
        const auto& [xx, yy, zz] = array_of(form.diagonal);
        const auto& [yz, xz, xy] = array_of(form.mixed);
        const FormAbout<Real> adjugate{{yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy},
                                       {xy * xz - xx * yz, xy * yz - yy * xz, xz * yz - zz * xy},
                                       {},
                                       {}};
        det_[0] = xx + yy + zz;
        det_[1] = adjugate.diagonal.x + adjugate.diagonal.y + adjugate.diagonal.z;
        det_[2] = xx * adjugate.diagonal.x + xy * adjugate.mixed.z + xz * adjugate.mixed.y;
        v_[0] = det_[0] * form.slope - form.product(form.slope);
        v_[1] = adjugate.product(form.slope);
    }

    const FormAbout<Real>& form() const { return form_; }
    Real det(const Real& l) const {
        return mul_add(mul_add(mul_add(det_[2], l, det_[1]), l, det_[0]), l, Real(1.0));
    }
    Vec3<Real> v(const Real& l) const { return mul_add(l, mul_add(l, v_[1], v_[0]), form_.slope); }
    /// Returns the leading principal minors of I + l A: all are > 0 where it is positive definite.
    std::array<Real, 3> minors(const Real& l) const {
        const Real first = mul_add(l, form_.diagonal.x, Real(1.0));
        const Real second = mul_add(l, form_.diagonal.y, Real(1.0));
        const Real off = l * form_.mixed.z;
        return {first, first * second - off * off, det(l)};
    }
    /// Returns N, given det and v.
    Real slope(const Real& l, const Real& det, const Vec3<Real>& v) const {
        return (form_.value * det - l * dot(form_.slope, v)) * det - l * squared_length(v);
    }
    Real slope(const Real& l) const { return slope(l, det(l), v(l)); }
    /// Returns det, of which coefficient k is that of l^k.
    std::array<Real, 4> det_polynomial() const { return {Real(1.0), det_[0], det_[1], det_[2]}; }
    /// Returns the polynomial det offset - l v, of which coefficient k is that of l^k: for an
    /// offset of p, it is det (p + y) along an axis.
    std::array<Real, 4> coordinate(int axis, const Real& offset) const {
        return {offset, det_[0] * offset - form_.slope[axis], det_[1] * offset - v_[0][axis],
                det_[2] * offset - v_[1][axis]};
    }

  private:
    static std::array<Real, 3> array_of(const Vec3<Real>& v) { return {v.x, v.y, v.z}; }

    FormAbout<Real> form_;
    std::array<Real, 3> det_;     // of l, l^2, l^3
    std::array<Vec3<Real>, 2> v_; // of l, l^2
};

/// Returns the form about p + step.
inline FormAbout<Dyadic> moved(const FormAbout<Dyadic>& form, const Vec3<Dyadic>& step) {
    const Vec3<Dyadic> change = form.product(step);
    FormAbout<Dyadic> result = form;
    result.slope = form.slope + change;
    result.value = form.value + dot(step, Vec3<Dyadic>(form.slope + result.slope));
    return result;
}

/// Returns about where N has its root in the interval; NaN if there seems to be none.
double approximate_root(const Dual<double>& dual);

/// Returns the root of N in the interval, proven by a change of sign, or nothing.
template <class T>
std::optional<Bounded<T>> certain_root(const Dual<Bounded<T>>& dual, double approximation);

extern template std::optional<Bounded<double>> certain_root(const Dual<Bounded<double>>&, double);
extern template std::optional<Bounded<DoubleDouble>>
certain_root(const Dual<Bounded<DoubleDouble>>&, double);

/// Returns false if a point may be outside of a quadric's box.
template <class Real>
bool is_surely_in_box(const QuadricOf<double>& quadric, const Vec3<Real>& point) {
    const Vec3<Real> p = point - convert<Real>(quadric.center);
    ErrorPredicate<Real> predicate;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double limit : {quadric.lower[axis], quadric.upper[axis]}) {
            if (std::isinf(limit)) continue;
            const int side = predicate.sign(Real(p[axis] - Real(limit)));
            if (limit == quadric.lower[axis] ? side < 0 : side > 0) return false;
        }
    }
    return !predicate.doubt();
}
template <class Real>
bool is_surely_in_box(const EllipsoidOf<double>&, const Vec3<Real>&) {
    return true;
}

/// Returns the closest point, or nothing if the numbers do not decide which one it is, or if the
/// closest point of the whole surface is not in the quadric's box.
template <class T, class Shape>
std::optional<ClosestPoint<Bounded<T>>> closest_on_quadric(const Shape& shape,
                                                           const Vec3<Bounded<T>>& point) {
    using Real = Bounded<T>;
    const Dual<Real> dual(form_about(shape, point));
    ClosestPoint<Real> closest{{}, point};
    if (!dual.form().value.is_zero()) {
        const double about =
            approximate_root(Dual<double>(form_about(shape, convert<double>(point))));
        const std::optional<Real> root = certain_root(dual, about);
        if (!root) return {};
        const Real factor = -(*root / dual.det(*root));
        const Vec3<Real> v = dual.v(*root);
        closest.squared = factor * factor * squared_length(v);
        closest.point = mul_add(factor, v, point);
    }
    if (!is_surely_in_box(shape, closest.point)) return {};
    return closest;
}

/// The squared distance of a point from a surface of second degree, given by a root l, as
/// accurately as needed. Numbers that agree in their first 1000 bits count as equal.
class QuadricDistance {
  public:
    QuadricDistance(const QuadricDistance&) = delete;
    QuadricDistance& operator=(const QuadricDistance&) = delete;
    virtual ~QuadricDistance() = default;

    /// Returns bounds on the squared distance.
    virtual std::array<Rational, 2> bounds() const = 0;
    /// Narrows the bounds. Returns false if they are as narrow as they may be.
    bool refine();
    /// Returns the order of the squared distance and a number: -1 if it is less.
    int compare_with(const Exact& squared);
    /// Returns the distance, as nearest_double_root() does.
    double nearest_distance();
    /// Returns the closest point, or one of several, rounded to the nearest doubles.
    virtual Vec3d nearest_point();
    /// Returns the order of a coordinate of that point and a number. The point must be the only
    /// one.
    int compare_coordinate(int axis, const Dyadic& number);

    friend int compare(QuadricDistance& a, QuadricDistance& b);

  protected:
    QuadricDistance(const Dual<Dyadic>& dual, const Vec3<Dyadic>& point, int max_bits)
        : dual_(dual), point_(point), max_bits_(max_bits) {}

    /// Returns 1 if the root is more than l, -1 if it is less, 0 if it is l.
    virtual int side_of(const Dyadic& l) const = 0;
    /// Returns true for the distance from a whole surface.
    virtual bool is_whole() const { return false; }
    /// Returns true if N changes its sign between the bounds of the root.
    virtual bool may_interpolate() const = 0;

    void narrow();
    bool has_bits(int count) const;

    Dual<Dyadic> dual_;
    Vec3<Dyadic> point_;
    int max_bits_;
    Dyadic low_ = 0.0, high_ = 0.0; // around the root
    int det_sign_ = 1;

  private:
    void step_to(const Dyadic& left, const Dyadic& right);
    bool is_congruent_to(const QuadricDistance& other) const;
    double nearest_coordinate(int axis);

    int gain_ = 1; // bits that the next step may gain
};

int compare(QuadricDistance& a, QuadricDistance& b);

/// The distance from the whole surface, by the maximum of g.
class WholeQuadricDistance : public QuadricDistance {
  public:
    WholeQuadricDistance(const Dual<Dyadic>& dual, const Vec3<Dyadic>& point, int max_bits = 1000);

    /// Returns false if no real point is on the surface.
    bool exists() const { return exists_; }
    std::array<Rational, 2> bounds() const override;
    Vec3d nearest_point() override;
    /// Returns true if several points are closest.
    bool has_several_points();

  private:
    int side_of(const Dyadic& l) const override;
    bool is_whole() const override { return true; }
    bool may_interpolate() const override { return is_inside(); }
    bool is_in_interval(const Dyadic& l) const;
    bool is_inside() const { return is_in_interval(low_) && is_in_interval(high_); }
    void bracket();

    bool exists_ = true;
};

/// Returns the distance of a shape's closest point; null if a quadric has no point in its box.
std::unique_ptr<QuadricDistance> exact_distance(const EllipsoidOf<double>& ellipsoid,
                                                const Vec3d& point);
std::unique_ptr<QuadricDistance> exact_distance(const QuadricOf<double>& quadric,
                                                const Vec3d& point);

} // namespace raylane::core
