#pragma once

#include "core/numbers/huge_angle.hpp"

#include <cstdint>

/// Elementary functions. Those of C libraries differ in their last bits, but an image must not.
/// Each is written once, for the scalar reference and for vector registers, in plain IEEE 754
/// operations without fused ones, tables or branches per lane. The bits are therefore the same on
/// every processor.
namespace raylane::core {

/// Operations that `Elementary` needs of double, or of a register of doubles, besides arithmetic
/// and comparisons (+ - * / < > ==). Bits: as many unsigned 64-bit integers, with + - & ^ << >>.
/// Mask: the result of comparisons. sqrt(): correctly rounded.
template <class Number>
struct Primitives;

/// Functions of double or of a register of doubles. Errors are the largest found by tests, in ulps.
template <class Number>
struct Elementary {
    /// e^x for all x. 0 below ln 2^-1021, infinity beyond the largest double. 0.9 ulp.
    static Number exp(const Number& x);

    /// e^x - 1 for all x; infinity above 709. 0.9 ulp for x < 0, 1.7 otherwise.
    static Number expm1(const Number& x);

    /// x^y for finite x and y with x > 0, or with x = 0 and y >= 0; 1 if both are 0. 0 below
    /// 2^-1021, infinity beyond the largest double. 1.6 ulps; 1.1 down to 2^-126, the smallest
    /// normal float.
    static Number pow(const Number& x, const Number& y);

    /// Natural logarithm, and logarithm to the base 10, which is exact for powers of ten. NaN below
    /// 0, -infinity at 0. 0.6 ulp.
    static Number log(const Number& x) {
        return of_log2(x, 0x1.62e42f8000000p-1, 0x1.be8e7bcd5e4f2p-27);
    }
    static Number log10(const Number& x) {
        return of_log2(x, 0x1.3441350000000p-2, 0x1.3ef3fde623e25p-31);
    }

    struct SineCosine {
        Number sine, cosine;
    };

    /// Sine and cosine for all finite x, in radians. 0.8 ulp. Beyond 2^20 lane by lane.
    static SineCosine sin_cos(const Number& x);
    static Number sin(const Number& x) { return sin_cos(x).sine; }
    static Number cos(const Number& x) { return sin_cos(x).cosine; }

    /// Returns the angle in [-pi/2, pi/2] whose tangent is x, for all x; NaN for NaN. 1.9 ulps.
    static Number atan(const Number& x);

  private:
    using P = Primitives<Number>;
    using Bits = typename P::Bits;

    /// An integer; the last bits of `bits` are those of its two's complement.
    struct Whole {
        Number value;
        Bits bits;
    };
    struct Pair {
        Number high, low;
    };

    static Whole nearest_whole(const Number& x);
    static Number scaled(const Number& x, const Whole& n);
    static Number head(const Number& x);
    static Pair difference(const Number& a, const Number& b);
    static Number linear(const Number& x, double c0, double c1);
    static Number cubic(const Number& x, const Number& square, double c0, double c1, double c2,
                        double c3);

    struct Reduced {
        Whole n;
        Number t, correction;
    };
    static Reduced without_powers_of_two(const Number& x);
    static Number expm1_near_zero(const Number& t, const Number& correction);
    struct Logarithm {
        Number value, head, rest; ///< value is head + rest, rounded
    };
    [[gnu::always_inline]] static inline Logarithm log2(const Number& x);
    static Number of_log2(const Number& x, double head, double rest);
    [[gnu::always_inline]] static inline ReducedAngle<Number> reduced(const Number& x);
};

/// The functions above. The versions for float compute in double and round.
double exp(double x);
float exp(float x);
double expm1(double x);
float expm1(float x);
double pow(double x, double y);
float pow(float x, float y);
double sin(double x);
float sin(float x);
double cos(double x);
float cos(float x);
double atan(double x);
float atan(float x);
double log(double x);
double log10(double x);

// Steps that the functions share.

/// Returns the integer nearest to x, for |x| < 2^51; ties go to the even one.
template <class Number>
typename Elementary<Number>::Whole Elementary<Number>::nearest_whole(const Number& x) {
    const Number shifted = x + Number(0x1.8p52);
    return {shifted - Number(0x1.8p52), P::bits(shifted)};
}

/// Returns x * 2^n, provided that the result is a normal number.
template <class Number>
Number Elementary<Number>::scaled(const Number& x, const Whole& n) {
    return P::number(P::bits(x) + (n.bits << 52));
}

/// Returns the first 26 bits of x. Products of two such numbers are exact. The rest of x has 27
/// bits.
template <class Number>
Number Elementary<Number>::head(const Number& x) {
    return P::number(P::bits(x) & Bits(~std::uint64_t(0) << 27));
}

/// Returns a - b without error. Source: Knuth, "The Art of Computer Programming", volume 2, 4.2.2.
template <class Number>
typename Elementary<Number>::Pair Elementary<Number>::difference(const Number& a, const Number& b) {
    const Number high = a - b;
    const Number b_used = a - high;
    return {high, (a - (high + b_used)) + (b_used - b)};
}

/// Returns c0 + c1 * x.
template <class Number>
Number Elementary<Number>::linear(const Number& x, double c0, double c1) {
    return Number(c1) * x + Number(c0);
}

/// Returns c0 + c1 * x + c2 * x^2 + c3 * x^3, in pairs: shorter chains of operations than Horner's
/// (Estrin 1960). `square` is x^2.
template <class Number>
Number Elementary<Number>::cubic(const Number& x, const Number& square, double c0, double c1,
                                 double c2, double c3) {
    return linear(x, c2, c3) * square + linear(x, c0, c1);
}

// The coefficients of all polynomials minimise the largest relative error, which a comment beside
// them gives (Lawson's algorithm in 400 bits, each coefficient rounded before the next ones are
// fitted).

// exp, expm1

/// Reduces x: x = n * ln(2) + t + correction, |t| <= ln(2) / 2. The product of n with the first 42
/// bits of ln(2) is exact. Source: Cody and Waite, "Software Manual for the Elementary Functions"
/// (1980).
template <class Number>
typename Elementary<Number>::Reduced Elementary<Number>::without_powers_of_two(const Number& x) {
    const Whole n = nearest_whole(x * Number(0x1.71547652b82fep+0));
    const Number high = x - n.value * Number(0x1.62e42fefa3800p-1);
    const Number low = n.value * Number(0x1.ef35793c76730p-45);
    const Number t = high - low;
    return {n, t, (high - t) - low};
}

/// Returns t + t^2 * (1/2 + t/6 + ...) + correction, accurate to 2^-63 of e^t.
template <class Number>
Number Elementary<Number>::expm1_near_zero(const Number& t, const Number& correction) {
    const Number square = t * t;
    const Number fourth = square * square;
    const Number first =
        cubic(t, square, 0.5, 0x1.555555555555ap-3, 0x1.5555555555530p-5, 0x1.111111110f167p-7);
    const Number middle = cubic(t, square, 0x1.6c16c16c275a0p-10, 0x1.a01a01b1e3cf7p-13,
                                0x1.a01a01503e3b2p-16, 0x1.71ddf38b146fcp-19);
    const Number last = square * Number(0x1.1e5e13cfec122p-29) +
                        linear(t, 0x1.27e5925d38707p-22, 0x1.af66b34524530p-26);
    return t + (square * ((last * fourth + middle) * fourth + first) + correction);
}

template <class Number>
Number Elementary<Number>::exp(const Number& x) {
    const Reduced r = without_powers_of_two(x);
    const Number result = scaled(Number(1.0) + expm1_near_zero(r.t, r.correction), r.n);
    const Number bounded = P::select(x < Number(-0x1.61da04cbafe44p+9), Number(0.0), result);
    return P::select(x > Number(0x1.62e42fefa39efp+9), Number(__builtin_inf()), bounded);
}

template <class Number>
Number Elementary<Number>::expm1(const Number& x) {
    const Reduced r = without_powers_of_two(x);
    const Number power = scaled(Number(1.0), r.n);
    const Number result = power * expm1_near_zero(r.t, r.correction) + (power - Number(1.0));
    const Number bounded = P::select(x < Number(-40.0), Number(-1.0), result);
    return P::select(x > Number(709.0), Number(__builtin_inf()), bounded);
}

// pow

/// Returns the base-2 logarithm of x > 0, with a relative error of about 2^-65.
template <class Number>
typename Elementary<Number>::Logarithm Elementary<Number>::log2(const Number& x) {
    // x = 2^e * m, sqrt(1/2) <= m < sqrt(2)
    const typename P::Mask subnormal = x < Number(0x1p-1022);
    const Bits bits = P::bits(P::select(subnormal, x * Number(0x1p54), x));
    const Bits exponent = (bits + Bits(0x3FF0000000000000 - 0x3FE6A09E667F3BCD)) >> 52;
    const Number m = P::number(bits - (exponent << 52) + Bits(0x3FF0000000000000));
    const Number biased = P::number(exponent + Bits(0x4330000000000000)); // 2^52 + exponent
    const Number e =
        biased - P::select(subnormal, Number(0x1p52 + 1023 + 54), Number(0x1p52 + 1023));

    // s = (m - 1) / (m + 1), its head and the rest.
    const Number numerator = m - Number(1.0);
    const Number denominator = m + Number(1.0);
    const Number inverse = Number(1.0) / denominator;
    const Number s = numerator * inverse;
    const Number s_head = head(s);
    const Number denominator_head = head(denominator);
    const Number denominator_rest = m - (denominator_head - Number(1.0));
    const Number s_rest =
        ((numerator - s_head * denominator_head) - s_head * denominator_rest) * inverse;

    // log2(m) = 2 * atanh(s) / ln(2) = (s + s^3/3 + s^5/5 + ...) * 2 / ln(2). The first two terms
    // are split into heads and rests. The remaining terms are accurate to 2^-66 of the sum.
    const Number square_head = head(s_head * s_head);
    const Number square_rest = (s_head * s_head - square_head) + s_rest * (s_head + s);
    const Number third = Number(0x1.ec709d8000000p-1) * s_head; // exact
    const Number third_head = head(third);
    const Number third_rest = (third - third_head) + (Number(0x1.ec709d8000000p-1) * s_rest +
                                                      Number(0x1.0e80ff5d27f05p-27) * s);
    const Number cube = third_head * square_head; // exact
    const Number cube_rest = third_rest * square_head + (third_head + third_rest) * square_rest;

    const Number square = s * s;
    const Number fourth = square * square;
    const Number fifth =
        cubic(square, fourth, 0x1.2776c50ef9d24p-1, 0x1.a61762a75984dp-2, 0x1.484b1421984cep-2,
              0x1.0c9a63d712e67p-2) +
        (fourth * fourth) * (fourth * Number(0x1.85e8fbc4ba695p-3) +
                             linear(square, 0x1.c69f8bf51acb5p-3, 0x1.87b0c51a5cd25p-3));
    const Number first = Number(0x1.7154760000000p+1) * s_head; // exact
    const Number first_rest =
        Number(0x1.7154760000000p+1) * s_rest + Number(0x1.4ae0bf85ddf44p-25) * s;
    const Number rest = first_rest + (cube_rest + s * fourth * fifth);
    const Number sum = e + (first + (cube + rest));
    const Number high = head(sum);
    return {sum, high, (((e - high) + first) + cube) + rest};
}

template <class Number>
Number Elementary<Number>::pow(const Number& x, const Number& y) {
    const Logarithm log2_x = log2(x);
    const Number product = y * log2_x.value;
    const Whole n = nearest_whole(product);

    const Number y_head = head(y);
    const Number high = y_head * log2_x.head; // exact
    const Number low = (y - y_head) * log2_x.head + y * log2_x.rest;
    const Number t = ((high - n.value) + low) * Number(0x1.62e42fefa39efp-1);
    const Number result = scaled(Number(1.0) + expm1_near_zero(t, Number(0.0)), n);

    const Number not_tiny = P::select(product < Number(-1021.0), Number(0.0), result);
    const Number bounded = P::select(product < Number(1024.0), not_tiny, Number(__builtin_inf()));
    const Number of_zero = P::select(y > Number(0.0), Number(0.0), Number(1.0));
    return P::select(x > Number(0.0), bounded, of_zero);
}

// log, log10

/// Returns log2(x) * (head + rest). `head` holds the first 26 bits of the factor.
template <class Number>
Number Elementary<Number>::of_log2(const Number& x, double head, double rest) {
    const Logarithm log2_x = log2(x);
    const Number high = Number(head) * log2_x.head; // exact
    const Number low = Number(rest) * log2_x.head + Number(head + rest) * log2_x.rest;
    const Number infinity(__builtin_inf());
    const Number of_positive = P::select(x < infinity, high + low, x);
    const Number of_others =
        P::select(x == Number(0.0), Number(0.0) - infinity, Number(__builtin_nan("")));
    return P::select(x > Number(0.0), of_positive, of_others);
}

// sin, cos

/// Reduces an angle. Angles up to 2^20 use Cody and Waite's reduction in four parts. Each of the
/// first three parts has 33 bits, so its product with a quadrant up to 2^20 is exact. Larger angles
/// use Payne and Hanek's reduction.
template <class Number>
ReducedAngle<Number> Elementary<Number>::reduced(const Number& x) {
    const Number quadrant = nearest_whole(x * Number(0x1.45f306dc9c883p-1)).value;
    const Number near = x - quadrant * Number(0x1.921fb54400000p+0); // exact
    const Pair nearer = difference(near, quadrant * Number(0x1.0b4611a600000p-34));
    const Pair nearest = difference(nearer.high, quadrant * Number(0x1.3198a2e000000p-69));
    const Number rest = (nearer.low + nearest.low) - quadrant * Number(0x1.b839a252049c1p-104);
    const Number remainder = nearest.high + rest;
    const ReducedAngle<Number> angle{quadrant, remainder, (nearest.high - remainder) + rest};

    constexpr double limit = 0x1p20;
    if (!P::any(x * x > Number(limit * limit))) return angle;
    double xs[P::lanes], quadrants[P::lanes], remainders[P::lanes], corrections[P::lanes];
    P::store(x, xs);
    P::store(angle.quadrant, quadrants);
    P::store(angle.remainder, remainders);
    P::store(angle.correction, corrections);
    for (int i = 0; i < P::lanes; ++i) {
        if (!(xs[i] * xs[i] > limit * limit)) continue;
        const ReducedAngle<double> huge = reduced_huge_angle<Number>(xs[i]);
        quadrants[i] = huge.quadrant;
        remainders[i] = huge.remainder;
        corrections[i] = huge.correction;
    }
    return {P::load(quadrants), P::load(remainders), P::load(corrections)};
}

template <class Number>
typename Elementary<Number>::SineCosine Elementary<Number>::sin_cos(const Number& x) {
    const ReducedAngle<Number> angle = reduced(x);
    const Number& r = angle.remainder;
    const Number& c = angle.correction;
    const Number square = r * r;
    const Number half = Number(0.5) * square;

    const Number fourth = square * square;

    // r - r^3/6 + ..., to 2^-57, and c times its derivative.
    const Number sine_terms =
        linear(square, -0x1.ae5e541f0cb22p-26, 0x1.5d8e1e76aa88fp-33) * (fourth * fourth) +
        cubic(square, fourth, -0x1.5555555555548p-3, 0x1.111111110f75ap-7, -0x1.a01a019bf1a8cp-13,
              0x1.71de355e97e73p-19);
    const Number sine = r + (r * square * sine_terms + (c - c * half));

    // 1 - r^2/2 + r^4/24 - ..., to 2^-63. The rounding error of 1 - r^2/2 is added back.
    const Number cosine_terms =
        linear(square, 0x1.1ee9dbd5da2b6p-29, -0x1.8fa68573ea2eep-37) * (fourth * fourth) +
        cubic(square, fourth, 0x1.555555555554bp-5, -0x1.6c16c16c15016p-10, 0x1.a01a019c8f419p-16,
              -0x1.27e4f7f1a1dc5p-22);
    const Number main = Number(1.0) - half;
    const Number cosine = main + (((Number(1.0) - main) - half) + (fourth * cosine_terms - r * c));

    const Bits quadrant = nearest_whole(angle.quadrant).bits;
    const Number half_turns = Number(0.5) * angle.quadrant;
    const typename P::Mask even = nearest_whole(half_turns).value == half_turns;
    const Bits sine_sign = (quadrant & Bits(2)) << 62;
    const Bits cosine_sign = ((quadrant + Bits(1)) & Bits(2)) << 62;
    return {P::number(P::bits(P::select(even, sine, cosine)) ^ sine_sign),
            P::number(P::bits(P::select(even, cosine, sine)) ^ cosine_sign)};
}

// atan

/// Let a = |x|. For an angle beyond 3/8 * pi, the tangent of its complement is 1/a. For an angle
/// between 1/8 * pi and 3/8 * pi, the tangent of its difference from 1/4 * pi is (a - 1) / (a + 1).
template <class Number>
Number Elementary<Number>::atan(const Number& x) {
    const Bits sign = P::bits(x) & Bits(std::uint64_t(1) << 63);
    const Number a = P::number(P::bits(x) ^ sign);
    const typename P::Mask steep = a > Number(0x1.3504f333f9de6p+1);  // tan(3/8 pi)
    const typename P::Mask middle = a > Number(0x1.a827999fcef32p-2); // tan(1/8 pi)
    const Number one(1.0);
    const Number numerator = P::select(steep, Number(-1.0), P::select(middle, a - one, a));
    const Number denominator = P::select(steep, a, P::select(middle, a + one, one));
    const Number t = numerator / denominator;

    // t - t^3/3 + ..., to 2^-58.
    const Number square = t * t;
    const Number fourth = square * square;
    const Number eighth = fourth * fourth;
    const Number last = linear(square, -0x1.9ccb8d5fc9c5fp-5, 0x1.37b55f1acaf90p-5) +
                        fourth * Number(-0x1.2501f20cf424ap-6);
    const Number first = cubic(square, fourth, -0x1.555555555553dp-2, 0x1.999999999589bp-3,
                               -0x1.24924922af0f5p-3, 0x1.c71c70e6cb712p-4);
    const Number second = cubic(square, fourth, -0x1.745cf8f2284bep-4, 0x1.3b111a4d65285p-4,
                                -0x1.10ebbccdf6008p-4, 0x1.df0ebec5f6ce3p-5);
    const Number rest = t * (square * (first + eighth * (second + eighth * last)));

    // Pi / 2 and pi / 4 in two parts.
    const Number base = P::select(steep, Number(0x1.921fb54442d18p+0),
                                  P::select(middle, Number(0x1.921fb54442d18p-1), Number(0.0)));
    const Number below = P::select(steep, Number(0x1.1a62633145c07p-54),
                                   P::select(middle, Number(0x1.1a62633145c07p-55), Number(0.0)));
    const Number angle = base + (t + (rest + below));
    return P::number(P::bits(angle) ^ sign);
}

} // namespace raylane::core
