#pragma once

#include "simd/kernel/shapes/ball.hpp"
#include "simd/kernel/shapes/certified_solver.hpp"
#include "simd/kernel/shapes/filter.hpp"

namespace raylane::simd {

template <class Arch>
struct SphereNumbers {
    Vectors<Arch> center;
    Floats<Arch> radius;

    template <class Reader>
    explicit SphereNumbers(Reader reader)
        : center(next_vector<Arch>(reader)), radius(reader.next()) {}
    explicit SphereNumbers(const SphereAround<Arch>& sphere)
        : center(sphere.center), radius(sphere.radius) {}

    /// A sphere is its own bounding sphere.
    static constexpr bool encloses_itself = true;
    static constexpr bool is_of_spheres = true; ///< the table may be packed
};

/// Filter of a sphere. With f = origin - center, tau = -f . d and q = f + tau d (the foot of the
/// perpendicular), a ray with unit d crosses at tau -+ sqrt(r^2 - q^2).
///
/// The point at t given by the floats is within e = slack + u |f| + u t of the true one. So at a
/// crossing, |f + t d| = r -+ e. The square of the left side, as a polynomial in t - tau, is
/// Q + 2 b (t - tau) + |d|^2 (t - tau)^2. Here sqrt(Q) is within u (|tau| + |q|) of |q|, and
/// |b| <= 3 u |f| + 2 u |tau|, for the rounding of tau and for |d|^2 = 1 -+ 2 u. Moreover
/// |f| <= |tau| + |q|, t <= |tau| + r and, where it matters, |q| <= r. With a margin for the
/// rounding of the squares, it follows that
///   (r -+ e)^2 - Q + b^2 is within (r -+ E)^2 - q^2 for E = slack + u (6 |tau| + 7 r),
/// and that tau -+ sqrt() is off by |b| + u (2 |tau| + 4 r) < u (7 |tau| + 8 r).
///
/// Drawing: bench/drawings/sphere_filter.svg
template <class Arch>
struct SphereFilter : SphereNumbers<Arch> {
    using Numbers = SphereNumbers<Arch>;
    using Numbers::Numbers, Numbers::center, Numbers::radius;
    /// True where a ray may meet the sphere. Costs less than bounds().
    [[gnu::always_inline]] Mask<Arch> may_meet(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const Vectors<Arch> from_center = rays.origin - center;
        const F behind = fast_dot(from_center, rays.direction); // the foot is at t = -behind
        const Vectors<Arch> foot = fast_mul_add<Arch>(negated(behind), rays.direction, from_center);
        const F outer = radius * F(1 + 12 * half_ulp) +
                        fast_mul_add<Arch>(F(12 * half_ulp), abs(behind), rays.slack);
        // If a ray has its foot behind it and meets the sphere, it starts inside. Its distance from
        // the centre, and so `behind`, is at most r + slack, and 6 u r for rounding. Values that
        // overflow prove nothing.
        const Mask<Arch> missed = (outer * outer < fast_dot(foot, foot)) | (outer < behind);
        return is_number<Arch>(from_center.x) & ~missed;
    }

    /// Avoids the square root unless a lane in `asked` remains in doubt. If a ray starts more than
    /// a radius before its foot and meets the sphere, it enters after its start and before the
    /// foot.
    [[gnu::always_inline]] Obstacle<Arch> obstacle(const FilterRays<Arch>& rays,
                                                   std::uint32_t asked,
                                                   const Floats<Arch>& perhaps_before,
                                                   const Floats<Arch>& surely_before) const {
        using F = Floats<Arch>;
        const F o = zero<Arch>();
        const auto [present, tau, foot_squared, rounding, outer, inner] = near(rays);
        const F first = tau - outer - rounding;
        const Mask<Arch> missed = (outer * outer < foot_squared) | (tau + outer + rounding < o) |
                                  (first >= perhaps_before);
        const Mask<Arch> possible = present & ~missed;
        const Mask<Arch> certain = (inner > o) & (inner * inner > foot_squared) & (first > o) &
                                   (tau + rounding < surely_before);
        if ((Lanes<Arch>::bits(possible & ~certain) & asked) == 0) return {possible, certain};
        const Bounds<Arch> found = bounds(rays);
        return {found.possible & (found.lower < perhaps_before),
                found.certain & (found.upper < surely_before)};
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const F o = zero<Arch>();
        const auto [present, tau, foot_squared, rounding, outer, inner] = near(rays);
        const F outer_chord = outer * outer - foot_squared; // not fused: both overflow, or neither
        const F outer_half = sqrt(outer_chord);
        const F entry = tau - outer_half - rounding;
        const F exit = tau + outer_half + rounding;
        const Mask<Arch> missed = (outer_chord < o) | (exit < o);

        const F inner_chord = inner * inner - foot_squared;
        const F inner_half = sqrt(inner_chord);
        const Mask<Arch> meets = (inner > o) & (inner_chord > o), ahead = entry > o;
        Bounds<Arch> result{present & ~missed, positive_part<Arch>(entry), meets & ahead,
                            tau - inner_half + rounding};

        // A ray that certainly starts inside first crosses at its exit.
        const Mask<Arch> inside =
            (inner > o) & (fast_mul_add<Arch>(tau, tau, foot_squared) < inner * inner);
        if (Lanes<Arch>::bits(inside) != 0) [[unlikely]] {
            const F least = tau + inner_half - rounding;
            // The chord of a huge sphere overflows.
            const Mask<Arch> known = (least > o) & (least < F(__builtin_inff()));
            result.lower = select(inside, select(known, least, o), result.lower);
            result.certain = result.certain | inside;
            result.upper = select(inside, exit, result.upper);
        }
        return result;
    }

    static constexpr bool has_chord_around = false;
    /// Returns the chords of rays that meet the sphere. Undefined for other rays.
    [[gnu::always_inline]] Chord<Arch> chord(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const F o = zero<Arch>();
        const auto [present, tau, foot_squared, rounding, outer, inner] = near(rays);
        const F outer_half = sqrt(outer * outer - foot_squared);
        const F inner_chord = inner * inner - foot_squared, inner_half = sqrt(inner_chord);
        const Mask<Arch> meets = (inner > o) & (inner_chord > o);
        const F entry = tau - outer_half - rounding, exit_end = tau + outer_half + rounding;
        return {entry, select(meets, tau - inner_half + rounding, exit_end),
                select(meets, tau + inner_half - rounding, entry), exit_end};
    }

  private:
    /// A ray relative to the centre of the sphere.
    struct Near {
        Mask<Arch> present;             ///< the lane holds a sphere
        Floats<Arch> tau, foot_squared; ///< t of the foot, and q^2
        Floats<Arch> rounding;          ///< error of t
        Floats<Arch> outer, inner;      ///< radius + E and radius - E
    };

    [[gnu::always_inline]] Near near(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const Vectors<Arch> from_center = rays.origin - center;
        const F tau = negated(fast_dot(from_center, rays.direction));
        const Vectors<Arch> foot = fast_mul_add<Arch>(tau, rays.direction, from_center);
        const F foot_squared = fast_dot(foot, foot);
        const F rounding = F(10 * half_ulp) * (abs(tau) + radius);
        const F error = rounding + rays.slack;
        const F outer = radius + error, inner = radius - error;
        return {is_number<Arch>(from_center.x), tau, foot_squared, rounding, outer, inner};
    }
};

/// Same formulas as core/shapes/sphere.hpp, per lane.
template <class Arch, bool textbook>
struct SphereSolver : SphereNumbers<Arch> {
    using Numbers = SphereNumbers<Arch>;
    using Numbers::Numbers, Numbers::center, Numbers::radius;

    Crossings<Arch> crossings(MeasuredRays<Arch> rays, const Starts<Arch>& starts) const {
        rays.origin = rays.origin - center;
        return ball_crossings<Arch, textbook>(rays, radius, starts);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>& point, const Floats<Arch>&) const {
        return normalized(point - center);
    }
};

/// Uses the solver's formula with one division. Directions are unit vectors, so it does not divide
/// by |direction|^2.
///
/// The foot of the perpendicular from the centre, start + 0 direction, is off by `local.error`
/// (LocalRays) across the ray. Along the ray it is off by 2^-46 |f|, f = origin - center: by
/// 2^-47 |f| as |direction|^2 is not 1, and by 5 u |f| for the dot product. With |foot| <= r and
/// H = |shift| + 2 r >= |f| + |foot|, the discriminant r^2 - |foot|^2 errs by
///   2 r (4.1 u |f| + u r) + (5 u |f|)^2   for the error across the ray,
///   2^-91 |f|^2                           for the error along it, where |foot|^2 has its minimum,
///   6 u r^2                               for its own roundings,
/// in total by less than H (16 u r + 2^-90 H). The root of the discriminant errs by this error
/// divided by the root. t errs further by 2^-46 |f| and 2^-47 |root|, so by 2^-45 H. For a start on
/// the surface t = 2 shift, which errs by 10 u |f| and, as |direction|^2 is not 1, by 2^-47 of
/// itself.
///
/// Each component of the offset from the centre errs by 4 u |f| and 8 u |t| |direction|, and by the
/// error of t.
template <class Arch>
struct SphereCertifiedSolver {
    SphereNumbers<Arch> sphere;

    template <class Reader>
    explicit SphereCertifiedSolver(Reader reader) : sphere(reader) {}

    template <Wanted wanted>
    [[gnu::always_inline]] CertifiedCrossing<Arch> solve(const Rays<Arch>& rays,
                                                         const Starts<Arch>& starts) const {
        const F radius = sphere.radius;
        const Vectors<Arch> from_center = rays.origin - sphere.center;
        const F shift = negated(dot(from_center, rays.direction));
        const Vectors<Arch> foot = mul_add<Arch>(shift, rays.direction, from_center);
        const F discriminant = radius * radius - squared_length(foot);
        const F H = abs(shift) + (radius + radius);
        const F discriminant_error = H * (F(0x1p-49) * radius + F(0x1p-90) * H);
        const F root = sqrt(discriminant);

        const F inverse = F(1.0) / (radius * root);
        const F crossing_error = F(0x1p-45) * H + discriminant_error * (inverse * radius);
        const F entry = shift - root;
        const Mask<Arch> entering = (entry > zero<Arch>()) & ~starts.on_surface;
        const F from_foot = select(starts.on_surface, shift, select(entering, negated(root), root));
        const F t = shift + from_foot;
        const F error = select(starts.on_surface, F(0x1p-49) * H + F(0x1p-46) * t, crossing_error);
        const Mask<Arch> ahead = (starts.on_surface & starts.inward &
                                  (squared_length(foot) < F(2.0) * (radius * radius))) |
                                 (~starts.on_surface & (discriminant > discriminant_error) &
                                  (abs(entry) > crossing_error));
        const F inverse_radius = inverse * root;
        CertifiedCrossing<Arch> result = {
            ahead & is_result<Arch>(t, error) & (error < F(0x1p-14) * radius),
            t,
            error,
            zero<Arch>(),
            entering,
            scaled<Arch>(inverse_radius, mul_add<Arch>(from_foot, rays.direction, foot))};
        if constexpr (wanted == Wanted::all) {
            const F along = error + F(0x1p-48) * H;
            const auto off = [&](const F& from, const F& way) {
                return F(0x1p-50) * abs(from) + along * abs(way);
            };
            result.normal_error = error_of_unit<Arch>(result.normal,
                                                      {off(from_center.x, rays.direction.x),
                                                       off(from_center.y, rays.direction.y),
                                                       off(from_center.z, rays.direction.z)},
                                                      inverse_radius);
            const Mask<Arch> uncertain = ~result.certain & ~starts.on_surface;
            if (any<Arch>(uncertain))
                result.misses =
                    uncertain & (passes(shift, foot) | ((discriminant > discriminant_error) &
                                                        (shift + root < negated(crossing_error))));
        }
        return result;
    }

  private:
    using F = Floats<Arch>;

    /// True where the line certainly misses the sphere. The error is the one above with |foot| in
    /// place of the radius, which is smaller than |foot| there.
    Mask<Arch> passes(const F& shift, const Vectors<Arch>& foot) const {
        const F size = sum_of_sizes(foot), H = abs(shift) + (size + size);
        const F error = H * (F(0x1p-49) * size + F(0x1p-90) * H);
        return squared_length(foot) - sphere.radius * sphere.radius > error;
    }
};

template <>
struct ShapeKernels<core::Sphere>
    : ShapeKernelsOf<SphereNumbers, SphereFilter, SphereSolver, SphereCertifiedSolver> {};

} // namespace raylane::simd
