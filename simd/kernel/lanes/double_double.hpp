#pragma once

#include "simd/kernel/lanes/doubles.hpp"

namespace raylane::simd {

/// Lanes of core::DoubleDouble, where `D` are lanes of doubles. Products are off by 5 u^2 at most,
/// u = 2^-53 (Joldes, Muller and Popescu, algorithm 10).
template <class D>
struct DoubleDoubles {
    using F = Floats<D>;
    F high, low;

    DoubleDoubles() = default;
    explicit DoubleDoubles(const F& value) : high(value), low(zero<D>()) {}
    DoubleDoubles(const F& high_, const F& low_) : high(high_), low(low_) {}

    static DoubleDoubles two_sum(const F& a, const F& b) {
        const F sum = a + b;
        const F b_part = sum - a;
        return {sum, (a - (sum - b_part)) + (b - b_part)};
    }
    static DoubleDoubles fast_two_sum(const F& a, const F& b) {
        const F sum = a + b;
        return {sum, b - (sum - a)};
    }
    static DoubleDoubles two_product(const F& a, const F& b) {
        const F product = a * b;
        return {product, Lanes<D>::product_error(a, b, product)};
    }

    DoubleDoubles operator-() const { return {negated(high), negated(low)}; }
    DoubleDoubles operator+(const DoubleDoubles& b) const {
        const DoubleDoubles highs = two_sum(high, b.high), lows = two_sum(low, b.low);
        const DoubleDoubles sum = fast_two_sum(highs.high, highs.low + lows.high);
        return fast_two_sum(sum.high, sum.low + lows.low);
    }
    DoubleDoubles operator-(const DoubleDoubles& b) const { return *this + -b; }
    DoubleDoubles operator*(const DoubleDoubles& b) const {
        const DoubleDoubles product = two_product(high, b.high);
        return fast_two_sum(product.high, product.low + (high * b.low + low * b.high));
    }
    DoubleDoubles operator/(const DoubleDoubles& b) const {
        const F first = high / b.high;
        const DoubleDoubles rest = *this - b * DoubleDoubles(first);
        const F middle = rest.high / b.high;
        const F last = (rest - b * DoubleDoubles(middle)).high / b.high;
        return fast_two_sum(first, middle) + DoubleDoubles(last);
    }
    /// Returns the root of a number > 0.
    friend DoubleDoubles sqrt(const DoubleDoubles& a) {
        const F root = sqrt(a.high);
        const DoubleDoubles rest = a - two_product(root, root);
        return fast_two_sum(root, rest.high / (root + root));
    }
    friend DoubleDoubles select(const Mask<D>& mask, const DoubleDoubles& a,
                                const DoubleDoubles& b) {
        return {select(mask, a.high, b.high), select(mask, a.low, b.low)};
    }
};

} // namespace raylane::simd
