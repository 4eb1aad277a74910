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
int sign_at(const Root& t, const Exact& a, const Exact& b, const Exact& c = {});

/// a + b t at a root, to all digits.
Number value_at(const Root& t, const Exact& a, const Exact& b);

/// -1 or 1 where the first digits say which is less, 0 where they do not: those of a value above
/// come without cancellation.
int compare_digits(const Number& a, const Number& b);

/// -1, 0, 1: a is less, the same, more. What differs in the first digits needs no more of them.
int compare(const Root& a, const Number& a_value, const Root& b, const Number& b_value);
int compare(const Root& a, const Root& b);

/// The roots of A t^2 + 2 B t + C in ascending order, two where they are the same, with whether the
/// polynomial falls there.
struct FoundRoot {
    Root t;
    bool falling;
};
std::vector<FoundRoot> roots(const Exact& A, const Exact& B, const Exact& C);

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
float rounded(const Root& root, const Number& digits);
float rounded(const Root& root);

/// The double that is nearest to a positive root, ties to even.
double rounded_to_double(const Root& root, const Number& digits);

} // namespace raylane::oracle
