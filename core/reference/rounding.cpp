#include "core/reference/rounding.hpp"

#include "core/numbers/nearest_between.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace raylane::core {

namespace {

using Extended = Bounded<DoubleDouble>;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Returns t in the range of a type's positive numbers.
template <class Real>
Real in_range_of(double t) {
    using Limits = std::numeric_limits<Real>;
    return static_cast<Real>(std::clamp(t, static_cast<double>(Limits::denorm_min()),
                                        static_cast<double>(Limits::max())));
}
float float_of(double t) {
    return in_range_of<float>(t);
}

/// Lower and upper bound of a value with an error bound, which may be less than half an ulp.
double below(double value, double error) {
    if (error == infinite) return -infinite;
    return error == 0.0 ? value : std::nextafter(value - error, -infinite);
}
double above(double value, double error) {
    return -below(-value, error);
}

/// Calls visit(shape) with the shape that was hit.
template <class Visit>
decltype(auto) with_shape(const Scene& scene, const Hit<double>& hit, const Visit& visit) {
    return with_table(scene.shapes(), hit.kind,
                      [&](const auto& table) { return visit(table.get(hit.place)); });
}

template <class To>
Ray<To> ray_in(const Ray<double>& ray) {
    return {convert<To>(ray.origin), convert<To>(ray.direction)};
}

Bounded<double> largest(const Vec3<Bounded<double>>& v) {
    return std::max({v.x, v.y, v.z},
                    [](const auto& a, const auto& b) { return a.magnitude() < b.magnitude(); });
}

/// Returns true if the error of each component is less than `accuracy` times the largest component.
bool are_within(const Vec3<Bounded<double>>& v, double accuracy) {
    const double most = accuracy * largest(v).magnitude();
    return v.x.error < most && v.y.error < most && v.z.error < most;
}

/// Calls is_enough(t) with t in 106 bits, then with a relative error of at most 2^-100, until it
/// returns true. Returns whether it did.
template <class IsEnough>
bool with_wide_t(const Scene& scene, const LeavingRay& from, const SharpHit& sharp,
                 const IsEnough& is_enough) {
    sharp.widen(scene, from);
    if (is_enough(sharp.wide_t())) return true;
    return sharp.wide_t().error != 0.0 &&
           is_enough(sharp.root(scene, from).in_wide(sharp.hit().t, sharp.hit().error));
}

Vec3<Extended> wide_normal(const Scene& scene, const Ray<Extended>& ray, const Extended& t,
                           const Hit<double>& hit) {
    return with_shape(scene, hit, [&](const auto& shape) -> Vec3<Extended> {
        const NormalAlong<Extended> along = normal_along(shape, ray, hit.face);
        return mul_add(t, along.slope, along.v);
    });
}

/// Returns the normal of an apex.
Vec3<Extended> wide_apex_normal(const Scene& scene, const Ray<Extended>& ray,
                                const Hit<double>& hit) {
    return with_shape(scene, hit, [&](const auto& shape) -> Vec3<Extended> {
        return normal_along(shape, ray, hit.face).apex;
    });
}

/// A normal of any length: linear in t, at a root. At an apex it is 0.
struct ExactNormal {
    ExactRoot root;
    NormalAlong<Dyadic> along;

    ExactNormal(const Scene& scene, const LeavingRay& from, const SharpHit& hit)
        : root(hit.root(scene, from)), along(with_shape(scene, hit.hit(), [&](const auto& shape) {
              return normal_along(shape, ray_in<Dyadic>(from.ray), hit.hit().face);
          })) {}

    int sign_of(int axis) const {
        return root.sign_of({0.0, 0.5 * along.slope[axis], along.v[axis]});
    }
};

/// Components of a normal of length 1, or of the vector that replaces it at an apex.
class ExactDirection : private ExactNormal {
  public:
    explicit ExactDirection(const ExactNormal& normal)
        : ExactNormal(normal), square_{squared_length(along.slope), dot(along.slope, along.v),
                                       squared_length(along.v)},
          at_apex_(root.sign_of(square_) == 0) {
        if (!at_apex_) return;
        along = {along.apex};
        square_ = {0.0, 0.0, squared_length(along.v)};
    }

    bool at_apex() const { return at_apex_; }

    /// Returns the float or double nearest to the component, ties to even. It must be from `first`
    /// to `last`.
    template <class Real>
    Real rounded(int axis, Real first, Real last) const {
        const int sign = sign_of(axis);
        if (sign == 0) return Real(0);
        if (sign < 0) first = -std::exchange(last, -first);
        const auto in_unit = [](Real size) { return std::clamp(size, Real(0), Real(1)) + Real(0); };
        return static_cast<Real>(sign) *
               nearest_between(in_unit(first), in_unit(last),
                               [&](const Dyadic& sum) { return compare_square(axis, 0.5 * sum); });
    }
    /// Returns the component to within 2^-45.
    double approximately(int axis) const {
        const int sign = sign_of(axis);
        double low = 0.0, high = 1.0;
        for (int step = 0; step < 46; ++step) {
            const double middle = 0.5 * (low + high);
            (compare_square(axis, middle) < 0 ? high : low) = middle;
        }
        return sign * 0.5 * (low + high);
    }

  private:
    /// Compares the component's magnitude with `size`: -1 if it is less, 1 if it is more.
    int compare_square(int axis, const Dyadic& size) const {
        const Dyadic &v = along.v[axis], &slope = along.slope[axis];
        const Dyadic factor = size * size;
        return root.sign_of({slope * slope - factor * square_.A, slope * v - factor * square_.B,
                             v * v - factor * square_.C});
    }

    ExactQuadratic square_; // squared length
    bool at_apex_;
};

/// Intervals of floats or doubles that contain the components of a direction.
template <class Real>
class RoundedDirection {
  public:
    /// Normalises a direction. Returns true if each component rounds to one number, whatever its
    /// error.
    bool is_sure(const Vec3<Extended>& direction) {
        using double_double::two_sum;
        const Extended length = core::length(direction);
        for (int axis = 0; axis < 3; ++axis) {
            if (first_[axis] == last_[axis]) continue;
            const Extended exact = direction[axis] / length;
            const Bounded<double> component = in_double(exact);
            if (!(component.error <= 1.0)) continue;
            first_[axis] = static_cast<Real>(below(component.value, component.error));
            last_[axis] = static_cast<Real>(above(component.value, component.error));
            if constexpr (std::is_same_v<Real, double>)
                if (rounds_surely(two_sum(exact.value.high, exact.value.low), exact.error))
                    first_[axis] = last_[axis] = component.value;
        }
        return first_ == last_;
    }
    /// Sets the components that are exactly 0, which no number of digits proves. Returns true if
    /// all components are sure then. Does nothing unless some component is certainly not 0.
    bool is_sure(const ExactNormal& exact) {
        const auto may_be_0 = [&](int axis) {
            return first_[axis] <= Real(0) && Real(0) <= last_[axis];
        };
        if (may_be_0(0) && may_be_0(1) && may_be_0(2)) return false;
        for (int axis = 0; axis < 3; ++axis)
            if (may_be_0(axis) && exact.sign_of(axis) == 0) first_[axis] = last_[axis] = Real(0);
        return first_ == last_;
    }
    /// Returns the numbers, which must be sure.
    Vec3<Real> rounded() const { return first_ + Vec3<Real>(Real(0)); } // no -0
    /// Returns the numbers; computes those exactly that are not sure.
    Vec3<Real> rounded(const ExactDirection& exact) const {
        Vec3<Real> result = rounded();
        for (int axis = 0; axis < 3; ++axis)
            if (first_[axis] != last_[axis])
                result[axis] = exact.rounded(axis, first_[axis], last_[axis]);
        return result;
    }

  private:
    Vec3<Real> first_{Real(-1)}, last_{Real(1)};
};

/// Returns the unit normal of a crossing, each component rounded to the nearest number.
template <class Real>
Vec3<Real> nearest_normal(const Scene& scene, const LeavingRay& from, const SharpHit& sharp) {
    const Ray<Extended> ray = ray_in<Extended>(from.ray);
    RoundedDirection<Real> normal;
    const auto is_sure = [&](const Extended& t) {
        return normal.is_sure(wide_normal(scene, ray, t, sharp.hit()));
    };
    sharp.widen(scene, from);
    if (is_sure(sharp.wide_t())) return normal.rounded();
    const ExactNormal exact(scene, from, sharp);
    if (normal.is_sure(exact) || with_wide_t(scene, from, sharp, is_sure)) return normal.rounded();
    const ExactDirection direction(exact);
    if (direction.at_apex() && normal.is_sure(wide_apex_normal(scene, ray, sharp.hit())))
        return normal.rounded();
    return normal.rounded(direction);
}

} // namespace

bool rounds_surely(double t, double error, float& t_rounded) {
    t_rounded = float_of(below(t, error));
    return t_rounded == float_of(above(t, error));
}

bool rounds_surely(const DoubleDouble& t, double error) {
    const double most = error * (1.0 + 0x1p-50);
    return std::isnormal(t.high) && t.high + (t.low - most) == t.high &&
           t.high + (t.low + most) == t.high;
}

double nearest_double_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit,
                        int exponent) {
    SharpHit sharp(hit);
    sharp.widen(scene, from);
    const Extended t = sharp.wide_t();
    const double nearest = std::ldexp(t.value.high, exponent);
    // Scaling rounds subnormal numbers again.
    if (rounds_surely(t.value, t.error) && std::isnormal(nearest)) return nearest;
    const Bounded<double> known = in_double(t);
    const auto limit = [&](double bound, double towards) {
        return in_range_of<double>(std::nextafter(std::ldexp(bound, exponent), towards));
    };
    return sharp.root(scene, from)
        .rounded_between(limit(below(known.value, known.error), -infinite),
                         limit(above(known.value, known.error), infinite), exponent);
}

int compare_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit, double number) {
    if (below(hit.t, hit.error) > number) return 1;
    if (above(hit.t, hit.error) < number) return -1;
    return SharpHit(hit).root(scene, from).sign_of(ExactQuadratic::minus(number));
}

float rounded_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit, int exponent) {
    float result = 0.0F;
    const auto is_sure = [&](const Hit<double>& known) {
        return rounds_surely(std::ldexp(known.t, exponent), std::ldexp(known.error, exponent),
                             result);
    };
    if (is_sure(hit)) return result;
    SharpHit sharp(hit);
    sharp.widen(scene, from);
    const Hit<double> widened = sharp.sharpened();
    if (is_sure(widened)) return result;
    return sharp.root(scene, from)
        .rounded_between(result, float_of(std::ldexp(above(widened.t, widened.error), exponent)),
                         exponent);
}

Vec3f rounded_normal(const Scene& scene, const LeavingRay& from, const Hit<double>& hit) {
    return nearest_normal<float>(scene, from, hit);
}

Vec3d nearest_double_normal(const Scene& scene, const LeavingRay& from, const SharpHit& hit) {
    return nearest_normal<double>(scene, from, hit);
}

Vec3f rounded_normal(const Scene& scene, const LeavingRay& from, const Hit<double>& hit,
                     const Vec3f& known) {
    int unknown = 0;
    for (int axis = 0; axis < 3; ++axis)
        unknown += std::isnan(known[axis]) ? 1 : 0;
    if (unknown == 3) return rounded_normal(scene, from, hit);
    // No number of digits can prove that a component is 0.
    const ExactNormal exact(scene, from, hit);
    Vec3f normal = known;
    for (int axis = 0; axis < 3; ++axis)
        if (std::isnan(known[axis])) {
            if (exact.sign_of(axis) != 0) return rounded_normal(scene, from, hit);
            normal[axis] = 0.0F;
        }
    return normal + Vec3f(0.0F); // no -0
}

SurfacePoint<double> surface_point(const Scene& scene, const LeavingRay& from,
                                   const Hit<double>& hit) {
    const Ray<double>& ray = from.ray;
    SurfacePoint<double> result;
    result.point = mul_add(hit.t, ray.direction, ray.origin);
    Vec3<Bounded<double>> point;
    for (int axis = 0; axis < 3; ++axis)
        point[axis] = {result.point[axis], hit.error * std::abs(ray.direction[axis]) +
                                               0x1p-51 * (std::abs(ray.origin[axis]) +
                                                          std::abs(hit.t * ray.direction[axis]))};
    const bool is_close =
        are_within(point, 0x1p-24) && with_shape(scene, hit, [&](const auto& shape) {
            return are_within(outward_direction(shape, point, hit.face), 0x1p-20);
        });
    if (is_close) {
        result.normal = with_shape(scene, hit, [&](const auto& shape) {
            return outward_normal(shape, result.point, hit.face);
        });
        return result;
    }
    const Ray<Extended> wide = ray_in<Extended>(ray);
    Vec3<Bounded<double>> direction;
    const auto is_known = [&](const Extended& t) {
        const Vec3<Extended> true_point = mul_add(t, wide.direction, wide.origin);
        const Vec3<Extended> normal = wide_normal(scene, wide, t, hit);
        for (int axis = 0; axis < 3; ++axis) {
            point[axis] = in_double(true_point[axis]);
            result.point[axis] = point[axis].value;
            direction[axis] = in_double(normal[axis]);
            result.normal[axis] = direction[axis].value;
        }
        return are_within(direction, 0x1p-40) && are_within(point, 0x1p-50);
    };
    const SharpHit sharp(hit);
    if (is_known(sharp.wide_t()) || with_wide_t(scene, from, sharp, is_known) ||
        are_within(direction, 0x1p-40)) {
        // The normal may have any length; scaling it first ensures that no square over- or
        // underflows.
        result.normal = normalized(result.normal / largest(direction).magnitude());
        return result;
    }
    const ExactDirection exact(ExactNormal(scene, from, hit));
    for (int axis = 0; axis < 3; ++axis)
        result.normal[axis] = exact.approximately(axis);
    return result;
}

} // namespace raylane::core
