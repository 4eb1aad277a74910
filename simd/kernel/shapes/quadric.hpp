#pragma once

#include "simd/kernel/shapes/enclosing.hpp"
#include "simd/kernel/shapes/first_crossing.hpp"
#include "simd/kernel/shapes/quadratic.hpp"
#include "simd/kernel/shapes/root.hpp"

namespace raylane::simd {

template <class Arch>
struct QuadricNumbers {
    Vectors<Arch> center;
    Floats<Arch> xx, yy, zz, xy, xz, yz;
    Vectors<Arch> linear;
    Floats<Arch> one;
    Vectors<Arch> lower, upper;

    template <class Reader>
    explicit QuadricNumbers(Reader reader)
        : center(next_vector<Arch>(reader)), xx(reader.next()), yy(reader.next()),
          zz(reader.next()), xy(reader.next()), xz(reader.next()), yz(reader.next()),
          linear(next_vector<Arch>(reader)), one(reader.next()), lower(next_vector<Arch>(reader)),
          upper(next_vector<Arch>(reader)) {}

    Vectors<Arch> product(const Vectors<Arch>& p) const {
        return {dot(Vectors<Arch>{xx, xy, xz}, p), dot(Vectors<Arch>{xy, yy, yz}, p),
                dot(Vectors<Arch>{xz, yz, zz}, p)};
    }
    Vectors<Arch> half_gradient(const Vectors<Arch>& p) const { return product(p) + linear; }
    Floats<Arch> value(const Vectors<Arch>& p) const {
        return dot(p, half_gradient(p) + linear) + one;
    }
    Floats<Arch> largest_coefficient() const {
        Floats<Arch> largest = abs(xx);
        for (const Floats<Arch>* coefficient : {&yy, &zz, &xy, &xz, &yz}) {
            const Floats<Arch> size = abs(*coefficient);
            largest = select(largest < size, size, largest);
        }
        return largest;
    }

    SphereAround<Arch> enclosing() const {
        return rounded_up<Arch>(center + half<Arch>(lower + upper),
                                length<Arch>(half<Arch>(upper - lower)));
    }
};

/// Filter of a quadric. The ray is first moved to t = `start`, where it enters the box. So
/// magnitudes are those of the box, and the form's next crossing is the answer.
///
/// There, f = origin + start d - center is off by slack + u (3 start + 2 |f|). Let K >= |M v| / |v|
/// for the form's matrix M be the largest sum of a row's absolute values, k = |linear| and
/// e = slack + u (3 start + 16 |f|). Since each takes at most 8 operations in a row with rounded
/// operands,
///   A = d . M d is off by 10 u K,
///   B = d . (M f + linear) by K (slack + u (3 start + 10 |f|)) + 6 u k,
///   C = f . (M f + 2 linear) + one by 2 (K |f| + k) (slack + u (3 start + 6 |f|)) + 3 u |one|
/// and part of the error's square. If the coefficients were rounded, they add 2 u K, K u |f| + u k
/// and u (K |f|^2 + 2 k |f| + |one|). The totals are below 16 u K, K e + 12 u k and 2 (K
/// (|f| + e) + k) e + 4 u |one|. The discriminant adds 2 u of B^2 and of A C.
template <class Arch>
struct QuadricFilter {
    using F = Floats<Arch>;
    static constexpr bool is_costly = true;
    static constexpr bool is_quadric = true;

    Vectors<Arch> center;
    F xx, yy, zz, xy, xz, yz;
    Vectors<Arch> linear;
    F one;
    Vectors<Arch> middle, half, extent;
    F matrix_size, linear_size;

    template <class Reader>
    explicit QuadricFilter(Reader reader)
        : center(next_vector<Arch>(reader)), xx(reader.next()), yy(reader.next()),
          zz(reader.next()), xy(reader.next()), xz(reader.next()), yz(reader.next()),
          linear(next_vector<Arch>(reader)), one(reader.next()) {
        const Vectors<Arch> lower = next_vector<Arch>(reader), upper = next_vector<Arch>(reader);
        const F nothing = zero<Arch>();
        const Vectors<Arch> zeros = {nothing, nothing, nothing};
        middle = fast_mul_add<Arch>(F(0.5F), lower + upper, zeros);
        half = fast_mul_add<Arch>(F(0.5F), upper - lower, zeros);
        extent = absolute(middle) + half;
        const F x = abs(xx) + abs(xy) + abs(xz);
        const F y = abs(xy) + abs(yy) + abs(yz);
        const F z = abs(xz) + abs(yz) + abs(zz);
        matrix_size = max(x, max(y, z));
        const Vectors<Arch> size = absolute(linear);
        linear_size = size.x + size.y + size.z;
    }
    template <class Reader>
    explicit QuadricFilter(Derived<Reader> reader)
        : center(next_vector<Arch>(reader)), xx(reader.next()), yy(reader.next()),
          zz(reader.next()), xy(reader.next()), xz(reader.next()), yz(reader.next()),
          linear(next_vector<Arch>(reader)), one(reader.next()), middle(next_vector<Arch>(reader)),
          half(next_vector<Arch>(reader)), extent(next_vector<Arch>(reader)),
          matrix_size(reader.next()), linear_size(reader.next()) {}
    template <class Visit>
    void derived(const Visit& visit) const {
        visit_each(visit, center, xx, yy, zz, xy, xz, yz, linear, one, middle, half, extent,
                   matrix_size, linear_size);
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        const Vectors<Arch> from_center = rays.origin - center, d = rays.direction;
        const Vectors<Arch> slope_error = error_of<Arch>(2 * half_ulp, d, F(0x1p-126F));
        // u for each rounding of f, middle and half, and 3 u of the position, as cross_slab()
        // requires.
        const Vectors<Arch> error =
            error_of<Arch>(6 * half_ulp, absolute(from_center) + extent, rays.slack);
        const Stay<Arch> stay =
            cross_slab<Arch>(from_center.x - middle.x, half.x, error.x, d.x, slope_error.x) &
            cross_slab<Arch>(from_center.y - middle.y, half.y, error.y, d.y, slope_error.y) &
            cross_slab<Arch>(from_center.z - middle.z, half.z, error.z, d.z, slope_error.z);

        const F start = positive_part<Arch>(stay.in_low);
        const Vectors<Arch> f = fast_mul_add<Arch>(start, d, from_center);
        const F distance = root_above<Arch>(fast_dot(f, f));
        const F e = fast_mul_add<Arch>(F(16 * half_ulp), distance,
                                       fast_mul_add<Arch>(F(3 * half_ulp), start, rays.slack));
        const Vectors<Arch> half_gradient = product(f) + linear;
        const F A = fast_dot(d, product(d));
        const F B = fast_dot(d, half_gradient);
        const F C = fast_dot(f, half_gradient + linear, one);
        const F A_error = fast_mul_add<Arch>(F(16 * half_ulp), matrix_size, F(underflow));
        const F B_error = fast_mul_add<Arch>(
            matrix_size, e, fast_mul_add<Arch>(F(12 * half_ulp), linear_size, F(underflow)));
        const F reach = fast_mul_add<Arch>(matrix_size, distance + e, linear_size);
        const F C_error = fast_mul_add<Arch>(
            reach + reach, e, fast_mul_add<Arch>(F(4 * half_ulp), abs(one), F(underflow)));
        const F BB = B * B, AC = A * C;
        const F D_error = fast_mul_add<Arch>(
            B_error, abs(B + B) + B_error,
            fast_mul_add<Arch>(A_error, abs(C) + C_error,
                               fast_mul_add<Arch>(abs(A), C_error,
                                                  fast_mul_add<Arch>(F(2 * half_ulp), BB + abs(AC),
                                                                     F(underflow)))));
        Bounds<Arch> result =
            surface_bounds<Arch>(is_number<Arch>(from_center.x), stay, start,
                                 FirstCrossing<Arch>(B, B_error, C, C_error, BB - AC, D_error));
        result.possible = result.possible & ~(stay.out_high < start);
        return result;
    }

  private:
    Vectors<Arch> product(const Vectors<Arch>& p) const {
        return {fast_dot(Vectors<Arch>{xx, xy, xz}, p), fast_dot(Vectors<Arch>{xy, yy, yz}, p),
                fast_dot(Vectors<Arch>{xz, yz, zz}, p)};
    }
};

/// Same formulas as core/shapes/quadric.hpp, per lane.
template <class Arch, bool textbook>
struct QuadricSolver : QuadricNumbers<Arch> {
    using Numbers = QuadricNumbers<Arch>;
    using Numbers::Numbers, Numbers::center, Numbers::lower, Numbers::upper, Numbers::product,
        Numbers::half_gradient, Numbers::value, Numbers::largest_coefficient;

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Floats<Arch> o = zero<Arch>();
        const Vectors<Arch> from_center = rays.origin - center;
        const Floats<Arch> A = dot(rays.direction, product(rays.direction));
        const Floats<Arch> B = dot(rays.direction, half_gradient(from_center));
        const Floats<Arch> scale = squared_length(rays.direction) * largest_coefficient();

        Crossings<Arch> roots = solve_quadratic<Arch, textbook>(
            A, B, value(from_center), scale, [&](const Floats<Arch>& tau) {
                return value(mul_add<Arch>(tau, rays.direction, from_center));
            });
        const Mask<Arch> turns = (starts.inward & (A > o)) | (~starts.inward & (A < o));
        roots.first.exists = roots.first.exists & ~starts.on_surface;
        roots.second.exists =
            (roots.second.exists & ~starts.on_surface) | (starts.on_surface & turns);
        roots.second.t =
            select(starts.on_surface, not_behind<Arch>(negated(B + B) / A), roots.second.t);
        roots.second.entering =
            (roots.second.entering & ~starts.on_surface) | (starts.on_surface & ~starts.inward);

        for (Crossing<Arch>* root : {&roots.first, &roots.second}) {
            const Vectors<Arch> p = mul_add<Arch>(root->t, rays.direction, from_center);
            const Mask<Arch> outside = (p.x < lower.x) | (upper.x < p.x) | (p.y < lower.y) |
                                       (upper.y < p.y) | (p.z < lower.z) | (upper.z < p.z);
            root->exists = root->exists & ~outside;
        }
        return roots;
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>& point, const Floats<Arch>&) const {
        const Floats<Arch> o = zero<Arch>();
        const Vectors<Arch> gradient = half_gradient(point - center);
        const Vectors<Arch> unit_z = {o, o, constant<Arch>(1.0F)};
        return select(squared_length(gradient) > o, normalized(gradient), unit_z);
    }
};

/// CertifiedSolver of a quadric. F(s) = Q(p) with p = start + s direction relative to the centre.
///
/// Let m be the largest of the square coefficients' sizes, l = |linear|_1, v = m |p|_1 + l, and
/// P = local.error_at(s) the error of the position. Each component of the half gradient
/// N = M p + linear errs by 8 u v + 1.74 m P, and is at most v. So the errors are:
///   Q(p) = p . (N + linear) + one   8 u ((v + l) |p|_1 + |one|) + 3.5 v P + 3 m P^2
///   half F' = N . direction         20 u v + 3.1 m P
///   A = direction . M direction     24 u m
/// Each component of N errs by the row of |M| times the errors of p, and by 8 u times the row's
/// terms.
template <class Arch>
struct QuadricCertifiedSolver {
    QuadricNumbers<Arch> quadric;

    template <class Reader>
    explicit QuadricCertifiedSolver(Reader reader) : quadric(reader) {}

    template <Wanted wanted>
    CertifiedCrossing<Arch> solve(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        CertifiedCrossing<Arch> result =
            first_passage<wanted, Arch>(Line<wanted>(quadric, rays), starts);
        make_unit<wanted>(result);
        return result;
    }

  private:
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    using V = Vectors<Arch>;

    template <Wanted wanted>
    struct Line {
        const QuadricNumbers<Arch>& form;
        LocalRays<Arch> local;
        F largest, linear_size;
        Quadratic<Arch> quadratic;

        Line(const QuadricNumbers<Arch>& quadric, const Rays<Arch>& rays)
            : form(quadric), local(rays, quadric.center) {
            largest = quadric.largest_coefficient();
            linear_size = sum_of_sizes(quadric.linear);
            quadratic.A = dot(local.direction, quadric.product(local.direction));
            quadratic.A_error = F(0x1p-47) * largest;
            const V half_gradient = quadric.half_gradient(local.start);
            quadratic.B = dot(local.direction, half_gradient);
            quadratic.C = dot(local.start, half_gradient + quadric.linear) + quadric.one;
        }

        [[gnu::always_inline]] Passage<Arch> passage(const M& leaves) const {
            const F s = quadratic.root_where(leaves);
            const V p = local.at(s);
            const V half_gradient = form.half_gradient(p);
            const F position_error = local.error_at(s);
            const F steepest = largest * sum_of_sizes(p) + linear_size;
            const Residual<Arch> residual = {
                dot(p, half_gradient + form.linear) + form.one, value_error(p, position_error),
                dot(half_gradient, local.direction), rise_error(steepest, position_error)};
            Passage<Arch> result;
            result.root = quadratic.refine(s, residual, leaves);
            result.t = local.shift + result.root.s;
            result.error = local.error_of_t(result.t, result.root.s, result.root.error);
            clip(result);
            return result;
        }

        /// Returns the passage of rays that start on the surface. The other root is ahead if the
        /// form first falls, because the ray goes inside, and rises again, or the reverse.
        [[gnu::noinline]] Passage<Arch> from_surface(const Starts<Arch>& starts) const {
            const F vertex = negated(quadratic.B) / quadratic.A;
            const V p = local.at(vertex);
            const F error =
                rise_error(largest * sum_of_sizes(p) + linear_size, local.error_at(vertex));
            const F rise = dot(form.half_gradient(p), local.direction);
            const F vertex_error = F(1.25) * (abs(rise) + error) / abs(quadratic.A);
            const F certain_A = F(8.0) * quadratic.A_error;
            Passage<Arch> result = Passage<Arch>::opposite(vertex, vertex_error, local);
            result.root.certain = (starts.inward & (quadratic.A > certain_A)) |
                                  (~starts.inward & (quadratic.A < negated(certain_A)));
            clip(result);
            return result;
        }

        F reach() const {
            const auto larger = [](const F& a, const F& b) {
                const F x = abs(a), y = abs(b);
                return select(x < y, y, x);
            };
            return local.size + F(1.0625) * (larger(form.lower.x, form.upper.x) +
                                             larger(form.lower.y, form.upper.y) +
                                             larger(form.lower.z, form.upper.z));
        }

        M has_no_root() const {
            const F vertex = negated(quadratic.B) / quadratic.A;
            const V p = local.at(vertex);
            const F value = dot(p, form.half_gradient(p) + form.linear) + form.one;
            const F error = value_error(p, local.error_at(vertex));
            return (quadratic.opens_up() & (value > error)) |
                   (quadratic.opens_down() & (value < negated(error)));
        }

      private:
        F value_error(const V& p, const F& position_error) const {
            const F size = sum_of_sizes(p), steepest = largest * size + linear_size;
            return F(0x1.4p-50) * ((steepest + linear_size) * size + abs(form.one)) +
                   (F(4.0) * steepest + F(3.0) * largest * position_error) * position_error;
        }

        F rise_error(const F& steepest, const F& position_error) const {
            return F(0x1.8p-49) * steepest + F(4.0) * largest * position_error;
        }

        /// Completes the passage at root.s.
        [[gnu::always_inline]] void clip(Passage<Arch>& passage) const {
            const V p = local.at(passage.root.s);
            const F margin = local.error_at(passage.root.s) + F(1.0625) * passage.root.error;
            const auto least = [&](const F& a, const F& b) { return select(a < b, a, b); };
            const V over = p - form.lower, under = form.upper - p;
            const F room = least(least(least(over.x, under.x), least(over.y, under.y)),
                                 least(over.z, under.z));
            passage.inside = room > margin;
            passage.outside = room < negated(margin);
            passage.normal = form.half_gradient(p);
            passage.steady = largest * margin < F(0x1p-14) * sum_of_sizes(passage.normal);
            if constexpr (wanted == Wanted::all) {
                const V off = local.off_at(passage.root.s, passage.root.error);
                const F roundings(0x1p-50);
                const V each = {off.x + roundings * abs(p.x), off.y + roundings * abs(p.y),
                                off.z + roundings * abs(p.z)};
                const auto row = [&](const F& x, const F& y, const F& z, const F& linear) {
                    return F(1.0625) * (abs(x) * each.x + abs(y) * each.y + abs(z) * each.z +
                                        roundings * abs(linear));
                };
                passage.normal_error = {row(form.xx, form.xy, form.xz, form.linear.x),
                                        row(form.xy, form.yy, form.yz, form.linear.y),
                                        row(form.xz, form.yz, form.zz, form.linear.z)};
            }
        }
    };
};

template <>
struct ShapeKernels<core::Quadric>
    : ShapeKernelsOf<QuadricNumbers, QuadricFilter, QuadricSolver, QuadricCertifiedSolver> {};

} // namespace raylane::simd
