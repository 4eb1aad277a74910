#pragma once

#include "simd/kernel/shapes/ball.hpp"
#include "simd/kernel/shapes/enclosing.hpp"
#include "simd/kernel/shapes/filter.hpp"
#include "simd/kernel/shapes/root.hpp"

#include <type_traits>

namespace raylane::simd {

template <class Arch>
struct EllipsoidNumbers {
    Vectors<Arch> center, axis_u, axis_v, axis_w;

    template <class Reader>
    explicit EllipsoidNumbers(Reader reader)
        : center(next_vector<Arch>(reader)), axis_u(next_vector<Arch>(reader)),
          axis_v(next_vector<Arch>(reader)), axis_w(next_vector<Arch>(reader)) {}

    /// |a * u + b * v + c * w| <= sqrt(|u|^2 + |v|^2 + |w|^2) for (a, b, c) of length 1.
    SphereAround<Arch> enclosing() const {
        const Floats<Arch> u = length<Arch>(axis_u), v = length<Arch>(axis_v),
                           w = length<Arch>(axis_w);
        return rounded_up<Arch>(center, sqrt(u * u + v * v + w * w));
    }
};

/// Filter of an ellipsoid, with u as in filter.hpp. core::ToBall is a linear map n with rows n_i.
/// It takes the ellipsoid about its centre to the unit ball. Let d be the ray's direction, and p =
/// origin + tau * d - center, with tau near the t at which |n(p)| is least. The ray's position at
/// tau + s maps to b + s * a in the ball, for a = n(d) and b = n(p). The ray crosses the ellipsoid
/// where |b + s * a| = 1.
///
/// All numbers but the resulting t are in units of a power of two. In this unit, the components of
/// the axes add up to less than 2, and to 1 or more. Let L be the length of all axes together, that
/// is, of the vector of all their components. p is the sum of b_i * axis_i, so |p| <= L * |b|.
/// Likewise, 1 <= L * |a|.
///
///   A row errs by 3 * u of its part of absolute_cross() / |volume|.
///   sigma is the length of all these parts together.
///   All rows err as the volume does, by their share r = u * (8 * S / |volume| + 8).
///
/// S is the sum of the absolute products in the volume. The error r makes the ball larger or
/// smaller by that share.
///
///   p errs by eta = slack + 4 * u * |tau| and by 2 * u * |p|,
///   b errs by sigma * (8 * u * |p| + eta), and a by 7 * u * sigma.
///
/// Let X = |b + s * a|. Then |p| <= L * X and |s| <= 2 * X * L, as b is close to the point of the
/// line nearest to the centre. So the true position is within
///   sigma * (22 * u * X * L + eta)
/// of b + s * a. If its distance from the centre is 1, or if X = 1, this distance and X differ by
/// at most
///   e = 32 * u * L * sigma + r + 1.5 * sigma * eta,
/// as long as the first two terms are below 1/4. The roots of |b + s * a| = 1 +- e bound s. The
/// rounding of their operands adds 8 * u of 1 +- e, and 16 * u * (|tau| + L * (1 + e)) of t.
template <class Arch>
struct EllipsoidFilter {
    using F = Floats<Arch>;
    using V = Vectors<Arch>;
    static constexpr bool is_costly = true;

    V center, rows[3];
    F unit, per_unit;
    F error, sigma, size; ///< 32 * u * L * sigma + r, sigma, L
    Mask<Arch> ordinary;  ///< the error is small, and no number has underflowed to 0

    template <class Reader>
    explicit EllipsoidFilter(Reader reader) : EllipsoidFilter(EllipsoidNumbers<Arch>(reader)) {}
    explicit EllipsoidFilter(const EllipsoidNumbers<Arch>& e) : center(e.center) {
        const auto sum_of = [](const V& v) { return abs(v.x) + abs(v.y) + abs(v.z); };
        const F exponent(__builtin_inff()); // its bits mask the exponent
        unit = (sum_of(e.axis_u) + sum_of(e.axis_v) + sum_of(e.axis_w)) & exponent;
        per_unit = F(1.0F) / unit;
        const V u = scaled<Arch>(per_unit, e.axis_u), v = scaled<Arch>(per_unit, e.axis_v),
                w = scaled<Arch>(per_unit, e.axis_w);
        const F o = zero<Arch>();
        const V sizes[] = {absolute_cross(v, w, o), absolute_cross(w, u, o),
                           absolute_cross(u, v, o)};
        rows[0] = fast_cross(v, w);
        rows[1] = fast_cross(w, u);
        rows[2] = fast_cross(u, v);
        const F volume = fast_dot(rows[0], u), products = fast_dot(sizes[0], absolute(u));
        const F per_volume = F(1.0F) / abs(volume);
        F squares = o;
        for (int i = 0; i < 3; ++i) {
            rows[i] = scaled<Arch>(per_volume, rows[i]);
            squares = squares + fast_dot(sizes[i], sizes[i]);
        }
        sigma = root_above<Arch>(squares) * per_volume;
        size = root_above<Arch>(fast_dot(u, u) + fast_dot(v, v) + fast_dot(w, w));
        error = F(32 * half_ulp) * size * sigma +
                F(8 * half_ulp) * fast_mul_add<Arch>(products, per_volume, F(1.0F));
        ordinary = (abs(volume) > F(0x1p-40F)) & (error < F(0.25F));
    }
    template <class Reader>
    explicit EllipsoidFilter(Derived<Reader> reader)
        : center(next_vector<Arch>(reader)), rows{next_vector<Arch>(reader),
                                                  next_vector<Arch>(reader),
                                                  next_vector<Arch>(reader)},
          unit(reader.next()), per_unit(reader.next()), error(reader.next()), sigma(reader.next()),
          size(reader.next()), ordinary(reader.next() > zero<Arch>()) {}
    template <class Visit>
    void derived(const Visit& visit) const {
        visit_each(visit, center, rows[0], rows[1], rows[2], unit, per_unit, error, sigma, size,
                   select(ordinary, F(1.0F), zero<Arch>()));
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        const F o = zero<Arch>(), one(1.0F);
        const V offset = rays.origin - center, from_center = scaled<Arch>(per_unit, offset);
        const V a = to_ball(rays.direction);
        const F a_squared = fast_dot(a, a), per_a = one / a_squared;
        const F tau = negated(fast_dot(a, to_ball(from_center)) * per_a);
        const V b = to_ball(fast_mul_add<Arch>(tau, rays.direction, from_center));
        const F beside = fast_dot(a, b); // 0 if b is the foot
        const F to_foot = negated(beside * per_a);
        const F foot_squared = fast_mul_add<Arch>(beside, to_foot, fast_dot(b, b));

        const F off =
            fast_mul_add<Arch>(F(6 * half_ulp), abs(tau), F(1.5F) * per_unit * rays.slack);
        const F e = fast_mul_add<Arch>(sigma, off, error);
        const F outer = (one + e) * F(1 + 8 * half_ulp), inner = (one - e) * F(1 - 8 * half_ulp);
        const F per_length = sqrt(per_a);
        const F foot = tau + to_foot;
        const F rounding = F(16 * half_ulp) * fast_mul_add<Arch>(size, outer, abs(tau));

        const F outer_chord = outer * outer - foot_squared;
        const F outer_half = sqrt(outer_chord) * per_length;
        const F entry = foot - outer_half - rounding, exit = foot + outer_half + rounding;
        const Mask<Arch> missed = (outer_chord < o) | (exit < o);

        const F inner_chord = inner * inner - foot_squared;
        const F inner_half = sqrt(inner_chord) * per_length;
        const Mask<Arch> known = ordinary & (inner > o) & (inner_chord > o);
        const Mask<Arch> ahead = entry > o;
        // A ray that certainly starts inside first crosses at its exit.
        const Mask<Arch> inside =
            known & (fast_mul_add<Arch>(foot * foot, a_squared, foot_squared) < inner * inner);
        const F last = foot + inner_half - rounding, first = foot - inner_half + rounding;
        return {is_number<Arch>(offset.x) & ~(missed & ordinary),
                select(ordinary, unit * positive_part<Arch>(select(inside, last, entry)), o),
                known & (ahead | inside), unit * select(inside, exit, first)};
    }

  private:
    V to_ball(const V& v) const {
        return {fast_dot(rows[0], v), fast_dot(rows[1], v), fast_dot(rows[2], v)};
    }
};

/// Same as core::ToBall, per lane.
template <class Arch>
struct ToBall {
    Vectors<Arch> rows[3];
    Floats<Arch> radius;

    explicit ToBall(const EllipsoidNumbers<Arch>& e)
        : rows{cross(e.axis_v, e.axis_w), cross(e.axis_w, e.axis_u), cross(e.axis_u, e.axis_v)},
          radius(dot(rows[0], e.axis_u)) {
        if constexpr (std::is_same_v<typename Floats<Arch>::value_type, float>) {
            for (Vectors<Arch>& row : rows)
                row = row / radius;
            radius = constant<Arch>(1.0F);
        }
    }

    template <class Reader>
    explicit ToBall(Derived<Reader> reader)
        : rows{next_vector<Arch>(reader), next_vector<Arch>(reader), next_vector<Arch>(reader)},
          radius(reader.next()) {}

    Vectors<Arch> operator()(const Vectors<Arch>& v) const {
        return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    }
    Vectors<Arch> normal(const Vectors<Arch>& in_ball) const {
        return mul_add<Arch>(in_ball.x, rows[0],
                             mul_add<Arch>(in_ball.y, rows[1], scaled<Arch>(in_ball.z, rows[2])));
    }
};

/// Same formulas as core/shapes/ellipsoid.hpp, per lane.
template <class Arch, bool textbook>
struct EllipsoidSolver {
    Vectors<Arch> center;
    ToBall<Arch> to_ball;

    template <class Reader>
    explicit EllipsoidSolver(Reader reader) : EllipsoidSolver(EllipsoidNumbers<Arch>(reader)) {}
    template <class Reader>
    explicit EllipsoidSolver(Derived<Reader> reader)
        : center(next_vector<Arch>(reader)), to_ball(reader) {}
    explicit EllipsoidSolver(const EllipsoidNumbers<Arch>& e) : center(e.center), to_ball(e) {}
    template <class Visit>
    void derived(const Visit& visit) const {
        visit_each(visit, center, to_ball.rows[0], to_ball.rows[1], to_ball.rows[2],
                   to_ball.radius);
    }

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        return ball_crossings<Arch, textbook>(
            Rays<Arch>{to_ball(rays.origin - center), to_ball(rays.direction)}, to_ball.radius,
            starts);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>& point, const Floats<Arch>&) const {
        return normalized(to_ball.normal(to_ball(point - center)));
    }
};

/// CertifiedSolver of an ellipsoid. With p = start + s * direction, relative to the centre, let
/// b(s) = rows . p and a = rows . direction, so b(s) changes by a per unit of s. The ray crosses
/// where
///   F(s) = |b(s)|^2 - volume^2 = 0.
/// Let u = 2^-53, and let U, V and W be |axis_u|_1, |axis_v|_1 and |axis_w|_1, where |x|_1 is the
/// sum of the sizes of the components of x.
///
/// Let (K_1, K_2, K_3) = (V * W, W * U, U * V). K_i is at least the length of row i. Let P be
/// local.error_at(s, 10), the error of the position and 8 more roundings, those of its product with
/// a row. Then b_i is off by K_i * P, a_i by 8 * u * K_i, and the volume by 12 * u * U * V * W. Let
/// K be the sum of all K_i, and T = K * P. The errors are:
///   F          2 * T * |b|_1 + T^2 + 2 * |volume| * volume_error + volume_error^2
///              + 8 * u * (|b|^2 + volume^2)
///   half F'    T * |a|_1 + |b|_1 * 8 * u * K + T * 8 * u * K + 4 * u * |a|_1 * |b|_1
///   A = |a|^2  2 * |a|_1 * 8 * u * K + (8 * u * K)^2 + 4 * u * |a|^2
/// The normal is half the gradient of F, the sum of b_i * row i. Each of its components is off by
/// the sizes of the rows' components times the errors of b_i, by the errors of the rows times b_i,
/// and by 8 * u of its terms.
template <class Arch>
struct EllipsoidCertifiedSolver {
    EllipsoidNumbers<Arch> ellipsoid;

    template <class Reader>
    explicit EllipsoidCertifiedSolver(Reader reader) : ellipsoid(reader) {}

    template <Wanted wanted>
    CertifiedCrossing<Arch> solve(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        CertifiedCrossing<Arch> result =
            first_passage<wanted, Arch>(Line<wanted>(ellipsoid, rays), starts);
        make_unit<wanted>(result);
        return result;
    }

  private:
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    using V = Vectors<Arch>;

    template <Wanted wanted>
    struct Line {
        LocalRays<Arch> local;
        ToBall<Arch> to_ball;
        V row_sizes; ///< K_i
        F size;      ///< sum of the axes' sizes
        F volume_error;
        V a;
        F a_error; ///< sum of the errors of all a_i
        Quadratic<Arch> quadratic;

        Line(const EllipsoidNumbers<Arch>& e, const Rays<Arch>& rays)
            : local(rays, e.center), to_ball(e) {
            const F u = sum_of_sizes(e.axis_u), v = sum_of_sizes(e.axis_v),
                    w = sum_of_sizes(e.axis_w);
            row_sizes = {v * w, w * u, u * v};
            size = u + v + w;
            volume_error = F(0x1p-49) * (u * row_sizes.x);
            a = to_ball(local.direction);
            a_error = F(0x1p-50) * sum_of_sizes(row_sizes);
            const V b = to_ball(local.start);
            quadratic.A = squared_length(a);
            quadratic.B = dot(a, b);
            quadratic.C = squared_length(b) - to_ball.radius * to_ball.radius;
            const F a_size = sum_of_sizes(a);
            quadratic.A_error = F(2.125) * a_error * (a_size + a_error) + F(0x1p-50) * quadratic.A;
        }

        [[gnu::always_inline]] Passage<Arch> passage(const M& leaves) const {
            const F s = quadratic.root_where(leaves);
            const V b = to_ball(local.at(s));
            const F together = error_in_ball(s);
            const Residual<Arch> residual = {value_of(b), value_error(b, together), dot(a, b),
                                             rise_error(b, together)};
            Passage<Arch> result;
            result.root = quadratic.refine(s, residual, leaves);
            result.t = local.shift + result.root.s;
            result.error = local.error_of_t(result.t, result.root.s, result.root.error);
            find_normal(result);
            return result;
        }

        /// Returns the other root of rays that start on the surface and go inward.
        [[gnu::noinline]] Passage<Arch> from_surface(const Starts<Arch>& starts) const {
            const F vertex = negated(quadratic.B) / quadratic.A;
            const V b = to_ball(local.at(vertex));
            const F vertex_error =
                F(1.25) * (abs(dot(a, b)) + rise_error(b, error_in_ball(vertex))) / quadratic.A;
            Passage<Arch> result = Passage<Arch>::opposite(vertex, vertex_error, local);
            result.root.certain = starts.inward & (quadratic.A > F(8.0) * quadratic.A_error);
            find_normal(result);
            return result;
        }

        F reach() const { return local.size + F(1.0625) * size; }

        M has_no_root() const {
            const F vertex = negated(quadratic.B) / quadratic.A;
            const V b = to_ball(local.at(vertex));
            return quadratic.opens_up() & (value_of(b) > value_error(b, error_in_ball(vertex)));
        }

      private:
        F value_of(const V& b) const { return squared_length(b) - to_ball.radius * to_ball.radius; }
        /// T
        F error_in_ball(const F& s) const {
            return F(1.0625) * sum_of_sizes(row_sizes) * local.error_at(s, 10.0);
        }
        F value_error(const V& b, const F& together) const {
            const F radius = abs(to_ball.radius);
            return together * (F(2.125) * sum_of_sizes(b) + together) +
                   volume_error * (F(2.125) * radius + volume_error) +
                   F(0x1p-49) * (squared_length(b) + radius * radius);
        }
        F rise_error(const V& b, const F& together) const {
            const F a_size = sum_of_sizes(a), b_size = sum_of_sizes(b);
            return together * (a_size + a_error) + a_error * b_size +
                   F(0x1p-50) * (a_size * b_size);
        }

        /// Completes the passage at root.s. A closed surface has no bounds.
        [[gnu::always_inline]] void find_normal(Passage<Arch>& passage) const {
            const F s = passage.root.s;
            const V b = to_ball(local.at(s));
            passage.inside = all<Arch>();
            passage.outside = none<Arch>();
            passage.normal = to_ball.normal(b);
            const F off = local.error_at(s, 10.0) + F(1.0625) * passage.root.error;
            const auto along = [&](const F& x, const F& y, const F& z) {
                const F roundings(0x1p-50);
                return abs(x) * (row_sizes.x * off + roundings * abs(b.x)) +
                       abs(y) * (row_sizes.y * off + roundings * abs(b.y)) +
                       abs(z) * (row_sizes.z * off + roundings * abs(b.z));
            };
            const auto& rows = to_ball.rows;
            // The rows are off by 2 * u of their sizes. 4 * u leaves a margin.
            const F of_rows = F(0x1p-51) * (row_sizes.x * abs(b.x) + row_sizes.y * abs(b.y) +
                                            row_sizes.z * abs(b.z));
            const F grow(1.0625);
            passage.normal_error = {grow * (along(rows[0].x, rows[1].x, rows[2].x) + of_rows),
                                    grow * (along(rows[0].y, rows[1].y, rows[2].y) + of_rows),
                                    grow * (along(rows[0].z, rows[1].z, rows[2].z) + of_rows)};
            passage.steady =
                sum_of_sizes(passage.normal_error) < F(0x1p-14) * sum_of_sizes(passage.normal);
        }
    };
};

template <>
struct ShapeKernels<core::Ellipsoid>
    : ShapeKernelsOf<EllipsoidNumbers, EllipsoidFilter, EllipsoidSolver, EllipsoidCertifiedSolver> {
};

} // namespace raylane::simd
