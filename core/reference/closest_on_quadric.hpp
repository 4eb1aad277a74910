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
/// Its maximum is that distance (More, "Generalizations of the trust region problem", 1993). At the
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
    const auto& rows = to_ball.rows;
    const auto sum = [&](int i, int j) -> Real {
        return mul_add(rows[0][i], rows[0][j],
                       mul_add(rows[1][i], rows[1][j], Real(rows[2][i] * rows[2][j])));
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
        const FormAbout<Real> adjugate = this->adjugate();
        det_[0] = xx + yy + zz;
        det_[1] = adjugate.diagonal.x + adjugate.diagonal.y + adjugate.diagonal.z;
        det_[2] = xx * adjugate.diagonal.x + form.mixed.z * adjugate.mixed.z +
                  form.mixed.y * adjugate.mixed.y;
        v_[0] = det_[0] * form.slope - form.product(form.slope);
        v_[1] = adjugate.product(form.slope);
    }

    /// Returns the adjugate matrix of A, with no slope and value.
    FormAbout<Real> adjugate() const {
        const auto& [xx, yy, zz] = array_of(form_.diagonal);
        const auto& [yz, xz, xy] = array_of(form_.mixed);
        return {{yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy},
                {xy * xz - xx * yz, xy * yz - yy * xz, xz * yz - zz * xy},
                {},
                {}};
    }
    /// Removes the factor 1 + l m from det and v, where m is a double eigenvalue of A: A - m I must
    /// have a rank of at most 1. All relations between det, v and N remain.
    void remove_factor(const Real& m) {
        const Real other = det_[0] - Real(2.0) * m;
        const Vec3<Real> rest = form_.product(form_.slope) - m * form_.slope;
        det_ = {m + other, m * other, Real(0.0)};
        v_ = {other * form_.slope - rest, Vec3<Real>(Real(0.0))};
    }
    /// Removes the factor twice: A is m I.
    void remove_both_factors(const Real& m) {
        det_ = {m, Real(0.0), Real(0.0)};
        v_ = {Vec3<Real>(Real(0.0)), Vec3<Real>(Real(0.0))};
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

/// A closest point, as the root l and the offset y from the given point.
template <class Real>
struct RootOffset {
    Real l;
    Vec3<Real> offset;
};

/// Returns the closest point of a whole surface, or nothing if the numbers do not decide which one
/// it is. `plain`: the same form in plain doubles.
template <class T>
std::optional<RootOffset<Bounded<T>>> closest_by_dual(const FormAbout<Bounded<T>>& form,
                                                      const FormAbout<double>& plain) {
    using Real = Bounded<T>;
    if (form.value.is_zero()) return RootOffset<Real>{Real(0.0), Vec3<Real>(Real(0.0))};
    const Dual<Real> dual(form);
    const std::optional<Real> root = certain_root(dual, approximate_root(Dual<double>(plain)));
    if (!root) return {};
    return RootOffset<Real>{*root, Real(-(*root / dual.det(*root))) * dual.v(*root)};
}

/// The same for an ellipsoid, or for a quadric without its box.
template <class T, class Shape>
std::optional<ClosestPoint<Bounded<T>>> closest_on_whole_quadric(const Shape& shape,
                                                                 const Vec3<Bounded<T>>& point) {
    const auto found =
        closest_by_dual(form_about(shape, point), form_about(shape, convert<double>(point)));
    if (!found) return {};
    return ClosestPoint<Bounded<T>>{squared_length(found->offset),
                                    Vec3<Bounded<T>>(point + found->offset)};
}

template <class T>
std::optional<ClosestPoint<Bounded<T>>> closest_on_quadric(const EllipsoidOf<double>& ellipsoid,
                                                           const Vec3<Bounded<T>>& point) {
    return closest_on_whole_quadric(ellipsoid, point);
}

/// The ends of a quadric's box that a point is on, along each axis: -1: the lower one, 1: the upper
/// one, 0: none.
using BoxEnds = std::array<int, 3>;

/// Returns the form of the points with some coordinates fixed, at `beside` from the given point.
template <class Real>
FormAbout<Real> restricted(const FormAbout<Real>& form, const BoxEnds& ends,
                           const Vec3<Real>& beside) {
    FormAbout<Real> result = form;
    result.slope = form.slope + form.product(beside);
    result.value = form.value + dot(beside, Vec3<Real>(form.slope + result.slope));
    for (int axis = 0; axis < 3; ++axis) {
        if (ends[static_cast<std::size_t>(axis)] == 0) continue;
        result.slope[axis] = Real(0.0);
        result.diagonal[axis] = Real(0.0);
        result.mixed[(axis + 1) % 3] = Real(0.0);
        result.mixed[(axis + 2) % 3] = Real(0.0);
    }
    return result;
}

/// Finds the closest point of a quadric in its box by following the ends of the box that the
/// closest point is beyond, and proves that it is the closest.
template <class T>
class ClosestInBox {
  public:
    using Real = Bounded<T>;

    ClosestInBox(const QuadricOf<double>& quadric, const Vec3<Real>& point)
        : quadric_(quadric), point_(point), plain_point_(convert<double>(point)),
          form_(form_about(quadric, point)), plain_(form_about(quadric, plain_point_)) {}

    std::optional<ClosestPoint<Real>> closest() {
        BoxEnds ends{};
        for (int count = 0; count < 3; ++count) {
            const Vec3<Real> beside = beside_of<Real>(ends, point_);
            const auto found =
                closest_by_dual(restricted(form_, ends, beside),
                                restricted(plain_, ends, beside_of<double>(ends, plain_point_)));
            if (!found) return {};
            const Vec3<Real> offset = found->offset + beside;
            const bool was_inside = !find_end_beyond(offset, ends);
            if (predicate_.doubt()) return {};
            if (!was_inside) continue;
            if (!is_proven(found->l, offset, ends)) return {};
            return ClosestPoint<Real>{squared_length(offset), Vec3<Real>(point_ + offset)};
        }
        return {};
    }

  private:
    double limit(int axis, int end) const {
        return end < 0 ? quadric_.lower[axis] : quadric_.upper[axis];
    }
    template <class Any>
    Vec3<Any> beside_of(const BoxEnds& ends, const Vec3<Any>& point) const {
        Vec3<Any> beside(Any(0.0));
        for (int axis = 0; axis < 3; ++axis)
            if (const int end = ends[static_cast<std::size_t>(axis)]; end != 0)
                beside[axis] =
                    Any(Any(quadric_.center[axis]) - point[axis]) + Any(limit(axis, end));
        return beside;
    }
    /// Adds an end of the box that a point is beyond, and returns true, or returns false if the
    /// point is in the box.
    bool find_end_beyond(const Vec3<Real>& offset, BoxEnds& ends) {
        for (int axis = 0; axis < 3; ++axis) {
            if (ends[static_cast<std::size_t>(axis)] != 0) continue;
            const Real place = Real(point_[axis] - Real(quadric_.center[axis])) + offset[axis];
            for (const int end : {-1, 1}) {
                if (std::isinf(limit(axis, end))) continue;
                if (end * predicate_.sign(Real(place - Real(limit(axis, end)))) <= 0) continue;
                ends[static_cast<std::size_t>(axis)] = end;
                return true;
            }
        }
        return false;
    }
    /// Let m be multipliers of the ends: y + l (A y + q) + m = 0, where m is 0 along other axes. If
    /// I + l A is positive definite, |y|^2 + l F(p + y) + 2 m . (y - end) is least at y, where it
    /// is |y|^2. If each m is >= 0 at an upper end and <= 0 at a lower one, it is at most the
    /// squared distance of any other point in the box with F = 0.
    bool is_proven(const Real& l, const Vec3<Real>& offset, const BoxEnds& ends) {
        if (ends == BoxEnds{}) return true;
        for (const Real& minor : Dual<Real>(form_).minors(l))
            if (!predicate_.positive(minor)) return false;
        const Vec3<Real> gradient = form_.product(offset) + form_.slope;
        for (int axis = 0; axis < 3; ++axis) {
            const Real against = mul_add(l, gradient[axis], offset[axis]); // -m
            if (ends[static_cast<std::size_t>(axis)] * predicate_.sign(against) > 0) return false;
        }
        return !predicate_.doubt();
    }

    const QuadricOf<double>& quadric_;
    Vec3<Real> point_;
    Vec3d plain_point_;
    FormAbout<Real> form_;
    FormAbout<double> plain_;
    ErrorPredicate<Real> predicate_;
};

template <class T>
std::optional<ClosestPoint<Bounded<T>>> closest_on_quadric(const QuadricOf<double>& quadric,
                                                           const Vec3<Bounded<T>>& point) {
    return ClosestInBox<T>(quadric, point).closest();
}

/// The squared distance of a point from a surface of second degree, given by a root l, as
/// accurately as needed. Numbers whose roots agree in `max_bits` bits count as equal.
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
    Dyadic tolerance_ = 0.0;        // smaller coordinates are 0
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
    /// `tolerance`: coordinates of at most this size count as 0.
    WholeQuadricDistance(const Dual<Dyadic>& dual, const Vec3<Dyadic>& point,
                         const Dyadic& tolerance = 0.0);

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
