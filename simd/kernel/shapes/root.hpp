#pragma once

#include "simd/kernel/shapes/certified_solver.hpp"

/// Roots of F(s) = A s^2 + 2 B s + C: first computed without regard to errors, then certified.
namespace raylane::simd {

/// The value of F at some s and half of its derivative, with their errors. Both are computed from
/// the geometry at s, so their errors do not depend on those of A, B and C.
template <class Arch>
struct Residual {
    Floats<Arch> value, value_error;
    Floats<Arch> rise, rise_error;
};

template <class Arch>
struct Root {
    Mask<Arch> certain;
    Floats<Arch> s, error;
    Floats<Arch> rise; ///< |F'| / 2, to within a quarter
};

template <class Arch>
struct Quadratic {
    Floats<Arch> A, B, C;
    Floats<Arch> A_error;

    Mask<Arch> opens_up() const { return A > A_error; }
    Mask<Arch> opens_down() const { return A < negated(A_error); }
    /// True where F is linear and has one root, as for a plane.
    Mask<Arch> is_linear() const { return max_A() == zero<Arch>(); }
    Floats<Arch> max_A() const { return abs(A) + A_error; }

    /// Returns the root where F rises (the ray leaves) in lanes of `rises`, and the root where F
    /// falls in the others. Neither form cancels.
    [[gnu::always_inline]] Floats<Arch> root_where(const Mask<Arch>& rises) const {
        const Floats<Arch> root = sqrt(B * B - A * C);
        const Mask<Arch> falling = B < zero<Arch>();
        const Floats<Arch> q = select(falling, root - B, negated(root + B));
        const Mask<Arch> by_A = (falling & rises) | (~falling & ~rises);
        return select(by_A, q, C) / select(by_A, A, q);
    }

    /// Refines s by one step of Newton's method and proves the result. After a step h = value / (2
    /// rise),
    ///   |F| <= value_error + |h| (2 rise_error + |A h| + roundings).
    /// If both the error of `rise` and A h are below an eighth of `rise`, half F' is still three
    /// quarters of `rise`. Then, where A |F| <= (F' / 2)^2, F changes its sign within
    /// |F| / (|F'| / 2).
    [[gnu::always_inline]] Root<Arch> refine(const Floats<Arch>& s, const Residual<Arch>& residual,
                                             const Mask<Arch>& rises) const {
        using F = Floats<Arch>;
        const F inverse = F(1.0) / residual.rise;
        const F step = F(0.5) * residual.value * inverse;
        const F step_size = abs(step), rise_size = abs(residual.rise);
        const F bend = max_A() * step_size;
        const F value = residual.value_error + step_size * (F(5.0) * residual.rise_error + bend);
        const Mask<Arch> wanted_sign =
            (rises & (residual.rise > zero<Arch>())) | (~rises & (residual.rise < zero<Arch>()));
        const F eighth = F(0.125) * rise_size;
        return {wanted_sign & (residual.rise_error < eighth) & (bend < eighth) &
                    (F(2.0) * max_A() * value < rise_size * rise_size),
                s - step, F(1.5) * value * abs(inverse), rise_size};
    }

    /// True where the other root is further than `reach` from s = 0. This follows from `root`
    /// alone, as the roots are F' / A apart.
    Mask<Arch> other_is_beyond(const Floats<Arch>& reach, const Root<Arch>& root) const {
        return root.certain & (root.rise > max_A() * (abs(root.s) + reach));
    }
};

/// A crossing with a surface of second degree, which may end at bounds.
template <class Arch>
struct Passage {
    Root<Arch> root;
    Floats<Arch> t, error;
    Mask<Arch> inside;          ///< certainly within the bounds of the surface
    Mask<Arch> outside;         ///< certainly outside of them
    Mask<Arch> steady;          ///< the error of the normal is below 2^-12
    Vectors<Arch> normal;       ///< of any length
    Vectors<Arch> normal_error; ///< per component, with Wanted::all

    /// Returns the passage opposite the start of a ray on the surface. One root is t = 0, so the
    /// other is at twice the vertex, where F' = 0. The caller sets root.certain.
    [[gnu::always_inline]] static Passage opposite(const Floats<Arch>& vertex,
                                                   const Floats<Arch>& vertex_error,
                                                   const LocalRays<Arch>& local) {
        const Floats<Arch> two(2.0), half = local.shift + vertex;
        Passage result;
        result.root.s = half + vertex;
        result.root.error = two * vertex_error;
        result.t = half + half;
        result.error = two * local.error_of_t(half, vertex, vertex_error);
        return result;
    }

    Mask<Arch> counts() const { return root.certain & inside & steady & is_result<Arch>(t, error); }
    Mask<Arch> does_not_count() const { return root.certain & (outside | (t < negated(error))); }
    Mask<Arch> is_before(const Passage& other) const { return t + error < other.t - other.error; }

    [[gnu::always_inline]] CertifiedCrossing<Arch> crossing(const Mask<Arch>& certain,
                                                            const Mask<Arch>& entering) const {
        return {certain, t, error, zero<Arch>(), entering, normal, none<Arch>(), normal_error};
    }
};

/// Brings a normal to length 1.
template <Wanted wanted, class Arch>
[[gnu::always_inline]] inline void make_unit(CertifiedCrossing<Arch>& crossing) {
    const Floats<Arch> inverse =
        constant<Arch>(1.0F) / sqrt(squared_length(crossing.normal)); // same formula as unit()
    crossing.normal = scaled<Arch>(inverse, crossing.normal);
    if constexpr (wanted == Wanted::all)
        crossing.normal_error =
            error_of_unit<Arch>(crossing.normal, crossing.normal_error, inverse);
}

/// Returns the first of the two crossings with `surface`, which has
///   passage(leaves), from_surface(starts)  returning a Passage,
///   quadratic                              a Quadratic,
///   reach()                                the largest |s| inside its bounds,
///   has_no_root()                          true where this is certain
template <Wanted wanted, class Arch, class Surface>
CertifiedCrossing<Arch> first_passage(const Surface& surface, const Starts<Arch>& starts) {
    using M = Mask<Arch>;
    const Passage<Arch> entry = surface.passage(none<Arch>());
    const M opens_up = surface.quadratic.opens_up();
    const M enters = entry.counts();
    CertifiedCrossing<Arch> result = entry.crossing(enters & opens_up, all<Arch>());

    if (any<Arch>(~result.certain & ~starts.on_surface)) {
        const Passage<Arch> exit = surface.passage(all<Arch>());
        const M leaves = exit.counts();
        const M no_entry =
            entry.does_not_count() | surface.quadratic.other_is_beyond(surface.reach(), exit.root);
        const M no_exit =
            exit.does_not_count() | surface.quadratic.other_is_beyond(surface.reach(), entry.root);
        const M entry_first = enters & (opens_up | no_exit | (leaves & entry.is_before(exit)));
        const M exit_first = leaves & (no_entry | (enters & exit.is_before(entry)));
        result.certain = entry_first;
        result = select<Arch>(exit_first, exit.crossing(exit_first, none<Arch>()), result);
        if constexpr (wanted == Wanted::all)
            result.misses = ~starts.on_surface & ((no_entry & no_exit) | surface.has_no_root());
    }
    if (any<Arch>(starts.on_surface)) {
        const Passage<Arch> onward = surface.from_surface(starts);
        result = select<Arch>(starts.on_surface, onward.crossing(onward.counts(), ~starts.inward),
                              result);
        // If the surface curves away from the ray, the other root is behind the start.
        const M behind = (starts.inward & surface.quadratic.opens_down()) |
                         (~starts.inward & surface.quadratic.opens_up()) |
                         surface.quadratic.is_linear();
        // A crossing that only rounding puts behind the start counts as one at the start
        // (core::not_behind).
        const M out_of_bounds = onward.root.certain & onward.outside & (onward.t > onward.error);
        result.misses =
            (~starts.on_surface & result.misses) | (starts.on_surface & (behind | out_of_bounds));
    }
    return result;
}

} // namespace raylane::simd
