#pragma once

#include "simd/kernel/finishers/root.hpp"
#include "simd/kernel/solvers/quadric.hpp"

namespace raylane::simd {

/// F(s) = Q(p) with p = start + s direction relative to the centre.
///
/// Errors, with m the largest of the square coefficients' sizes, l = |linear|_1, v = m |p|_1 + l,
/// and P = local.error_at(s) for the position: each component of the half gradient N = M p + linear
/// errs by 8 u v + 1.74 m P, and is at most v, so
///   Q(p) = p . (N + linear) + one   by 8 u ((v + l) |p|_1 + |one|) + 3.5 v P + 3 m P^2,
///   half F' = N . direction         by 20 u v + 3.1 m P,
///   A = direction . M direction     by 24 u m.
/// By component, N errs by the row of |M| times the errors of p, and 8 u times what it is made of.
template <class Arch>
struct QuadricFinisher {
    QuadricLanes<Arch> quadric;

    template <class Reader>
    explicit QuadricFinisher(Reader reader) : quadric(reader) {}

    template <Wanted wanted>
    Finished<Arch> finish(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        Finished<Arch> result = first_passage<wanted, Arch>(Line<wanted>(quadric, rays), starts);
        make_unit<wanted>(result);
        return result;
    }

  private:
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    using V = Vectors<Arch>;

    template <Wanted wanted>
    struct Line {
        const QuadricLanes<Arch>& form;
        LocalRays<Arch> local;
        F largest, linear_size;
        Quadratic<Arch> quadratic;

        Line(const QuadricLanes<Arch>& quadric, const Rays<Arch>& rays)
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

        /// The other root is ahead if the ray first falls inside and the form rises again, or the
        /// reverse.
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

        /// The rest of the passage at root.s.
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

} // namespace raylane::simd
