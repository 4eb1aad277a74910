#pragma once

#include "simd/kernel/filters/surface.hpp"

namespace raylane::simd {

/// The ray is first moved to t = `start`, where it enters the box: so magnitudes are the box's, and
/// the form's next crossing is the answer.
///
/// There, f = origin + start d - center is off by slack + u (3 start + 2 |f|). Let K >= |M v| / |v|
/// for the form's matrix M, the largest sum of a row's absolute values, k = |linear| and
/// e = slack + u (3 start + 16 |f|). By 8 operations in a row with rounded operands
///   A = d . M d is off by 10 u K,
///   B = d . (M f + linear) by K (slack + u (3 start + 10 |f|)) + 6 u k,
///   C = f . (M f + 2 linear) + one by 2 (K |f| + k) (slack + u (3 start + 6 |f|)) + u |one|
/// and some of the error's square: below 16 u K, K e + 12 u k and 2 (K (|f| + e) + k) e + 2 u
/// |one|, and the discriminant adds 2 u of B^2 and of A C.
template <class Arch>
struct QuadricFilter {
    using F = Floats<Arch>;

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

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        const Vectors<Arch> from_center = rays.origin - center, d = rays.direction;
        const Vectors<Arch> slope_error = error_of<Arch>(2 * half_ulp, d, F(0x1p-126F));
        // u for each rounding of f, middle and half, and 3 u of the position as cross_slab() has
        // it.
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
            reach + reach, e, fast_mul_add<Arch>(F(2 * half_ulp), abs(one), F(underflow)));
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

} // namespace raylane::simd
