#include "core/shapes/solve.hpp"

#include "core/shapes/error_predicate.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::core {

namespace {

template <class T, class Shape>
Crossings<double> solve_bounded(const Shape& shape, const Ray<double>& ray, const Start& start,
                                ErrorPredicate<Bounded<T>>& predicate) {
    using Real = Bounded<T>;
    const Ray<Real> wide{convert<Real>(ray.origin), convert<Real>(ray.direction)};
    Crossings<double> result;
    for (const Crossing<Real>& crossing : crossings(shape, wide, start, predicate)) {
        const int side = start.on_surface ? 1 : predicate.sign(crossing.t);
        const Bounded<double> t = in_double(crossing.t);
        if (side > 0) predicate.result(t);
        result.add({side == 0 ? 0.0 : t.value, crossing.face, crossing.entering, t.error});
    }
    return result;
}

/// Returns a bound on the error of a double that an Exact was converted to. A t beyond the range of
/// doubles has an infinite error.
double error_of(double t) {
    constexpr double accuracy = 0x1p-48;
    if (t == 0.0) return 0.0;
    if (std::abs(t) == std::numeric_limits<double>::max())
        return std::numeric_limits<double>::infinity();
    return accuracy * std::abs(t) + std::numeric_limits<double>::denorm_min();
}

template <class Shape>
Crossings<double> solve_exactly(const Shape& shape, const Ray<double>& ray, const Start& start) {
    Crossings<double> result;
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(ray.origin[axis]) || !std::isfinite(ray.direction[axis])) return result;
    ErrorPredicate<Exact> predicate;
    const Ray<Exact> exact{convert<Exact>(ray.origin), convert<Exact>(ray.direction)};
    double last = -std::numeric_limits<double>::infinity();
    for (const Crossing<Exact>& crossing : crossings(shape, exact, start, predicate)) {
        last = std::max(last, static_cast<double>(crossing.t)); // keeps the order despite rounding
        result.add({last, crossing.face, crossing.entering, error_of(last)});
    }
    return result;
}

} // namespace

template <OfDoubles Shape>
Crossings<float> solve(const Shape& shape, const Ray<float>& ray, const Start& start,
                       std::uint64_t&, Precision precision) {
    ErrorPredicate<float> predicate(precision);
    return crossings(shape, ray, start, predicate);
}

template <OfDoubles Shape>
Crossings<double> solve(const Shape& shape, const Ray<double>& ray, const Start& start,
                        std::uint64_t& widened, Precision precision) {
    if (precision == Precision::plain_double) {
        ErrorPredicate<double> plain;
        return crossings(shape, ray, start, plain);
    }
    ErrorPredicate<Bounded<double>> predicate;
    const Crossings<double> result = solve_bounded<double>(shape, ray, start, predicate);
    if (!predicate.doubt()) [[likely]]
        return result;
    ++widened;
    ErrorPredicate<Bounded<DoubleDouble>> wide_predicate;
    const Crossings<double> wide = solve_bounded<DoubleDouble>(shape, ray, start, wide_predicate);
    return wide_predicate.doubt() ? solve_exactly(shape, ray, start) : wide;
}

#define RAYLANE_SOLVE(Shape, name, text)                                                           \
    template Crossings<float> solve(const InDouble<Shape>&, const Ray<float>&, const Start&,       \
                                    std::uint64_t&, Precision);                                    \
    template Crossings<double> solve(const InDouble<Shape>&, const Ray<double>&, const Start&,     \
                                     std::uint64_t&, Precision);
RAYLANE_SHAPES(RAYLANE_SOLVE)
#undef RAYLANE_SOLVE

} // namespace raylane::core
