#pragma once

#include "simd/kernel/shapes/finisher.hpp"

/// Roots of F(s) = A s^2 + 2 B s + C, found with no thought of errors and then certified.
namespace raylane::simd {

/// F at some s: its value, half of its derivative, and what they are off by when they are computed
/// from the geometry there. They owe nothing to the errors of A, B and C.
template <class Arch>
struct Residual {
    Floats<Arch> value, value_error;
    Floats<Arch> rise, rise_error;
};

template <class Arch>
struct Root {
    Mask<Arch> certain;
    Floats<Arch> s, error;
    Floats<Arch> rise; ///< |F'| / 2, within a quarter
};

template <class Arch>
struct Quadratic {
    Floats<Arch> A, B, C;
    Floats<Arch> A_error;

    Mask<Arch> opens_up() const { return A > A_error; }
    Mask<Arch> opens_down() const { return A < negated(A_error); }
    /// A plane's: it has one root.
    Mask<Arch> is_linear() const { return most_A() == zero<Arch>(); }
    Floats<Arch> most_A() const { return abs(A) + A_error; }

    /// The root where F rises (the ray leaves), or else falls. Neither form cancels.
    [[gnu::always_inline]] Floats<Arch> root_where(const Mask<Arch>& rises) const {
        const Floats<Arch> root = sqrt(B * B - A * C);
        const Mask<Arch> falling = B < zero<Arch>();
        const Floats<Arch> q = select(falling, root - B, negated(root + B));
        const Mask<Arch> by_A = (falling & rises) | (~falling & ~rises);
        return select(by_A, q, C) / select(by_A, A, q);
    }

    /// One step of Newton's method, and a proof. After a step h = value / (2 rise),
    ///   |F| <= value_error + |h| (2 rise_error + |A h| + roundings)
    /// and half F' is still three quarters of `rise`, if both its error and A h are below an
    /// eighth. Then, where A |F| <= (F' / 2)^2, F changes its sign within |F| / (|F'| / 2).
    [[gnu::always_inline]] Root<Arch> refine(const Floats<Arch>& s, const Residual<Arch>& residual,
                                             const Mask<Arch>& rises) const {
        using F = Floats<Arch>;
        const F inverse = F(1.0) / residual.rise;
        const F step = F(0.5) * residual.value * inverse;
        const F step_size = abs(step), rise_size = abs(residual.rise);
        const F bend = most_A() * step_size;
        const F value = residual.value_error + step_size * (F(5.0) * residual.rise_error + bend);
        const Mask<Arch> wanted_sign =
            (rises & (residual.rise > zero<Arch>())) | (~rises & (residual.rise < zero<Arch>()));
        const F eighth = F(0.125) * rise_size;
        return {wanted_sign & (residual.rise_error < eighth) & (bend < eighth) &
                    (F(2.0) * most_A() * value < rise_size * rise_size),
                s - step, F(1.5) * value * abs(inverse), rise_size};
    }

    /// True where the other root is further than `reach` from s = 0, going by this one: they are
    /// F' / A apart.
    Mask<Arch> other_is_beyond(const Floats<Arch>& reach, const Root<Arch>& root) const {
        return root.certain & (root.rise > most_A() * (abs(root.s) + reach));
    }
};

/// A crossing with a surface that does not close a solid.
template <class Arch>
struct Passage {
    Root<Arch> root;
    Floats<Arch> t, error;
    Mask<Arch> inside;          ///< certainly within the bounds of the surface
    Mask<Arch> outside;         ///< certainly not
    Mask<Arch> steady;          ///< the normal is within 2^-12
    Vectors<Arch> normal;       ///< of any length
    Vectors<Arch> normal_error; ///< by component, if all is wanted

    /// Passage opposite the start of a ray on the surface: t = 0 is one root, so the other is twice
    /// the vertex, where F' = 0. Not certain as yet.
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

    [[gnu::always_inline]] Finished<Arch> finished(const Mask<Arch>& certain,
                                                   const Mask<Arch>& entering) const {
        return {certain, t, error, zero<Arch>(), entering, normal, none<Arch>(), normal_error};
    }
};

/// Brings a normal to length 1.
template <Wanted wanted, class Arch>
[[gnu::always_inline]] inline void make_unit(Finished<Arch>& finished) {
    const Floats<Arch> inverse =
        constant<Arch>(1.0F) / sqrt(squared_length(finished.normal)); // as unit() has it
    finished.normal = scaled<Arch>(inverse, finished.normal);
    if constexpr (wanted == Wanted::all)
        finished.normal_error =
            error_of_unit<Arch>(finished.normal, finished.normal_error, inverse);
}

/// The first of both crossings with `surface`, which has
///   passage(leaves), from_surface(starts)  as Passage,
///   quadratic, reach()                     as Quadratic and how far |s| can be inside its bounds
///   has_no_root()                          certainly
template <Wanted wanted, class Arch, class Surface>
Finished<Arch> first_passage(const Surface& surface, const Starts<Arch>& starts) {
    using M = Mask<Arch>;
    const Passage<Arch> entry = surface.passage(none<Arch>());
    const M opens_up = surface.quadratic.opens_up();
    const M enters = entry.counts();
    Finished<Arch> result = entry.finished(enters & opens_up, all<Arch>());

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
        result = select<Arch>(exit_first, exit.finished(exit_first, none<Arch>()), result);
        if constexpr (wanted == Wanted::all)
            result.misses = ~starts.on_surface & ((no_entry & no_exit) | surface.has_no_root());
    }
    if (any<Arch>(starts.on_surface)) {
        const Passage<Arch> onward = surface.from_surface(starts);
        result = select<Arch>(starts.on_surface, onward.finished(onward.counts(), ~starts.inward),
                              result);
        // Where the surface curves away from it, the other root is behind the ray.
        const M behind = (starts.inward & surface.quadratic.opens_down()) |
                         (~starts.inward & surface.quadratic.opens_up()) |
                         surface.quadratic.is_linear();
        // (What rounding alone puts behind the start counts as there: core::not_behind.)
        const M out_of_bounds = onward.root.certain & onward.outside & (onward.t > onward.error);
        result.misses =
            (~starts.on_surface & result.misses) | (starts.on_surface & (behind | out_of_bounds));
    }
    return result;
}

} // namespace raylane::simd
