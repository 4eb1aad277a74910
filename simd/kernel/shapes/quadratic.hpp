#pragma once

#include "simd/kernel/shapes/crossings.hpp"

namespace raylane::simd {

/// Same as core::solve_textbook, per lane. If A = 0, the first crossing is the only one.
template <class Arch>
Crossings<Arch> solve_textbook(const Floats<Arch>& A, const Floats<Arch>& B,
                               const Floats<Arch>& C) {
    const Floats<Arch> o = zero<Arch>();
    const Mask<Arch> opens_up = A > o, linear = A == o;
    const Floats<Arch> discriminant = B * B - A * C;
    const Mask<Arch> curved = ~linear & ~(discriminant < o);
    const Floats<Arch> root = sqrt(discriminant);
    const Divisor<Arch> by_A(A);
    const Floats<Arch> in = (negated(B) - root) / by_A, out = (root - B) / by_A;
    const Mask<Arch> falling = B < o, sloped = linear & ((B > o) | falling);
    const Mask<Arch> in_first = opens_up | (~linear & (discriminant == o));
    return {{curved | sloped, select(linear, negated(C) / (B + B), select(in_first, in, out)), o,
             (linear & falling) | in_first},
            {curved, select(in_first, out, in), o, ~linear & ~in_first}};
}

/// Same as core::solve_quadratic, per lane. If A = 0, the first crossing is the only one.
template <class Arch, bool textbook = false, class AtVertex>
Crossings<Arch> solve_quadratic(const Floats<Arch>& A, const Floats<Arch>& B, const Floats<Arch>& C,
                                const Floats<Arch>& scale, const AtVertex& at_vertex) {
    if constexpr (textbook) return solve_textbook<Arch>(A, B, C);
    const Floats<Arch> o = zero<Arch>();
    const Mask<Arch> opens_up = A > o, linear = ~opens_up & ~(A < o);
    const Divisor<Arch> by_A(A);
    const Mask<Arch> near_linear = either_way(abs(A) < constant<Arch>(0x1p-4F) * scale);
    const Floats<Arch> discriminant = select(near_linear, mul_add<Arch>(B, B, negated(A * C)),
                                             negated(A * at_vertex(negated(B) / by_A)));
    const Mask<Arch> curved = ~linear & ~(discriminant < o);
    const Floats<Arch> root = sqrt(discriminant);

    const Mask<Arch> falls = B < o, falling = either_way(falls);
    const Floats<Arch> q = select(falling, root - B, negated(root) - B);
    const Mask<Arch> tangent = q == o;
    const Floats<Arch> of_A = q / by_A, of_C = C / q;
    // q / A is the exit where B < 0 and otherwise the entry. So it comes first where either the
    // entry comes first or B < 0, but not both.
    const Mask<Arch> in_first = opens_up | (discriminant == o);
    const Mask<Arch> A_first = (in_first & ~falling) | (~in_first & falling);
    const Floats<Arch> first = select(A_first, of_A, of_C);
    const Floats<Arch> second = select(A_first, of_C, of_A);

    const Mask<Arch> sloped = linear & ((B > o) | falls);
    const Floats<Arch> on_line = negated(C) / (B + B);
    return {{curved | sloped, select(linear, on_line, select(tangent, o, first)), o,
             (linear & falls) | (~linear & in_first)},
            {curved, select(tangent, o, second), o, ~linear & ~in_first}};
}

} // namespace raylane::simd
