#pragma once

#include "tests/oracle/exact.hpp"

#include <limits>
#include <vector>

namespace raylane::oracle {

/// A real root of a polynomial of at most second degree: t = (U + V sqrt(D)) / W, exactly.
struct Root {
    Exact U, W; ///< W > 0
    int V = 0;  ///< -1, 0 or 1
    Exact D;    ///< >= 0

    static Root quotient(const Exact& a, const Exact& b) {
        return b.sign() < 0 ? Root{-a, -b, 0, {}} : Root{a, b, 0, {}};
    }
    operator Number() const { // NOLINT: implicit, to all digits
        return oracle::value({U, Exact(V)}, D) / Number(W);
    }
};

/// The sign of a + b t + c t^2 at a root.
inline int sign_at(const Root& t, const Exact& a, const Exact& b, const Exact& c = {}) {
    const Exact V(t.V);
    return sign({c * (t.U * t.U + V * V * t.D) + b * t.W * t.U + a * t.W * t.W,
                 V * (Exact(2) * c * t.U + b * t.W)},
                t.D);
}

/// a + b t at a root, to all digits.
inline Number value_at(const Root& t, const Exact& a, const Exact& b) {
    return value({a * t.W + b * t.U, b * Exact(t.V)}, t.D) / Number(t.W);
}

/// -1 or 1 where the first digits say which is less, 0 where they do not: those of a value above
/// come without cancellation.
inline int compare_digits(const Number& a, const Number& b) {
    static const Number unclear("1e-80");
    const Number difference = a - b;
    if (abs(difference) <= (abs(a) + abs(b)) * unclear) return 0;
    return difference > 0 ? 1 : -1;
}

/// -1, 0, 1: a is less, the same, more. What differs in the first digits needs no more of them.
inline int compare(const Root& a, const Number& a_value, const Root& b, const Number& b_value) {
    const int order = compare_digits(a_value, b_value);
    if (order != 0) return order;
    return sign({a.U * b.W - b.U * a.W, Exact(a.V) * b.W}, a.D, Exact(-b.V) * a.W, b.D);
}
inline int compare(const Root& a, const Root& b) {
    return compare(a, Number(a), b, Number(b));
}

/// The roots of A t^2 + 2 B t + C in ascending order, two where they are the same, with whether the
/// polynomial falls there.
struct FoundRoot {
    Root t;
    bool falling;
};
inline std::vector<FoundRoot> roots(const Exact& A, const Exact& B, const Exact& C) {
    if (A.sign() == 0) {
        if (B.sign() == 0) return {};
        return {{Root::quotient(-C, Exact(2) * B), B.sign() < 0}};
    }
    const Exact D = B * B - A * C;
    if (D.sign() < 0) return {};
    const bool opens_up = A.sign() > 0;
    const Exact U = opens_up ? -B : B, W = opens_up ? A : -A;
    const int V = D.sign() == 0 ? 0 : 1;
    return {{Root{U, W, -V, D}, opens_up}, {Root{U, W, V, D}, !opens_up}};
}

/// The float nearest to what is not negative and has these first digits, ties to even.
/// compare(middle) says on which side of the middle between two floats it is, where digits do not.
template <class Compare>
float nearest_float(const Number& digits, const Compare& compare) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    // The digits may have rounded up what was below the middle of two floats, or twice.
    float low = std::nextafter(static_cast<float>(digits), 0.0F);
    for (int steps = 0; steps < 3; ++steps) {
        const float next = std::nextafter(low, infinity);
        if (next == infinity) break;
        const double middle = 0.5 * (static_cast<double>(low) + static_cast<double>(next));
        int side = compare_digits(digits, Number(middle));
        if (side == 0) side = compare(middle);
        if (side < 0) break;
        const bool low_is_even = (__builtin_bit_cast(std::uint32_t, low) & 1) == 0;
        if (side == 0 && low_is_even) break;
        low = next;
    }
    return low;
}

/// The float that is nearest to a positive root, ties to even, but never 0 or infinite.
inline float rounded(const Root& root, const Number& digits) {
    const float nearest = nearest_float(
        digits, [&](double middle) { return sign_at(root, Exact(-middle), Exact(1)); });
    return nearest == 0.0F ? std::numeric_limits<float>::denorm_min() : nearest;
}
inline float rounded(const Root& root) {
    return rounded(root, Number(root));
}

} // namespace raylane::oracle
