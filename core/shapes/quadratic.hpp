#pragma once

#include "core/shapes/error_predicate.hpp"
#include "core/shapes/ray.hpp"

namespace raylane::core {

/// Returns the crossings of F(t) = A t^2 + 2 B t + C with 0, where F < 0 is the inside, by the
/// textbook formula, which cancels; prefer solve_quadratic. A line that touches the surface, from
/// either side, enters before it leaves.
template <class Real>
Crossings<Real> solve_textbook(const Real& A, const Real& B, const Real& C) {
    using std::sqrt;
    const auto a = static_cast<double>(A), b = static_cast<double>(B);
    if (a == 0.0) {
        if (b == 0.0) return {};
        return Crossing<Real>{-C / (B + B), body, b < 0.0};
    }
    const Real discriminant = B * B - A * C;
    if (static_cast<double>(discriminant) < 0.0) return {};
    const Real root = sqrt(discriminant);
    const Divisor<Real> by_A(A);
    const Crossing<Real> in{Real(-B - root) / by_A, body, true};
    const Crossing<Real> out{Real(root - B) / by_A, body, false};
    const bool in_first = a > 0.0 || static_cast<double>(discriminant) == 0.0;
    return in_first ? Crossings<Real>(in, out) : Crossings<Real>(out, in);
}

/// Returns the crossings of F(t) = A t^2 + 2 B t + C with 0, where F < 0 is the inside.
///
/// `at_vertex(tau)` evaluates F at the parabola's vertex tau = -B / A from the geometry (Haines,
/// Guenther and Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing
/// Gems, ch. 7). If the origin is far away, B^2 - A C cancels but F(tau) does not. If the leading
/// term (nearly) vanishes, it is the other way round. `scale` is the size of A without
/// cancellation.
template <class Real, class AtVertex>
Crossings<Real> solve_quadratic(const Real& A, const Real& B, const Real& C, const Real& scale,
                                ErrorPredicate<Real>& predicate, const AtVertex& at_vertex) {
    using std::sqrt;
    if (predicate.textbook()) return solve_textbook(A, B, C);
    const auto crossing = [](const Real& t, bool entering) {
        return Crossing<Real>{t, body, entering};
    };

    // The leading term vanishes: the equation is linear and has one root.
    const int curvature = predicate.sign(A);
    if (curvature == 0) {
        const int slope = predicate.sign(B);
        if (slope == 0) return {};
        return crossing(-C / (B + B), slope < 0);
    }

    // The discriminant B^2 - A C.
    const Divisor<Real> by_A(A);
    const bool near_linear = std::abs(static_cast<double>(A)) < 0x1p-4 * static_cast<double>(scale);
    const Real discriminant =
        near_linear ? mul_add(B, B, Real(-(A * C))) : Real(-(A * at_vertex(Real(-B) / by_A)));
    if (predicate.negative(discriminant)) return {};
    const Real root = sqrt(discriminant);

    // q does not cancel; the second root comes from the product of both, C / A.
    const bool falling = static_cast<double>(B) < 0.0;
    const Real q = falling ? Real(root - B) : Real(-root - B);
    if (static_cast<double>(q) == 0.0)
        return {crossing(Real(0.0), true), crossing(Real(0.0), false)};
    // F' at q / A has the sign of `root` if falling; at C / q the opposite.
    const Crossing<Real> of_A = crossing(q / by_A, !falling);
    const Crossing<Real> of_C = crossing(C / q, falling);
    // In order: for A > 0 the ray enters first, for A < 0 it leaves first, unless it only touches.
    const bool in_first = curvature > 0 || static_cast<double>(discriminant) == 0.0;
    return of_A.entering == in_first ? Crossings<Real>(of_A, of_C) : Crossings<Real>(of_C, of_A);
}

} // namespace raylane::core
