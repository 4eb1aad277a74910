#pragma once

#include "tests/oracle/exact.hpp"

#include <limits>
#include <vector>

namespace raylane::oracle {

/// A real root of a polynomial of at most second degree: exactly t = (U + V sqrt(D)) / W.
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

/// Returns the sign of a + b t + c t^2 at a root.
int sign_at(const Root& t, const Exact& a, const Exact& b, const Exact& c = {});

/// Returns a + b t at a root, to all digits.
Number value_at(const Root& t, const Exact& a, const Exact& b);

/// Returns -1 or 1 if a is less or greater by the first digits, and 0 if these do not decide. The
/// functions above compute their values without cancellation.
int compare_digits(const Number& a, const Number& b);

/// Returns -1, 0 or 1 if a is less, equal or greater. Values that differ in their first digits are
/// compared by these.
int compare(const Root& a, const Number& a_value, const Root& b, const Number& b_value);
int compare(const Root& a, const Root& b);

/// A root, and whether the polynomial falls there. roots() returns those of A t^2 + 2 B t + C in
/// ascending order; a double root twice.
struct FoundRoot {
    Root t;
    bool falling;
};
std::vector<FoundRoot> roots(const Exact& A, const Exact& B, const Exact& C);

/// Returns the float nearest to a nonnegative number with these first digits, ties to even. If the
/// digits do not decide, compare(middle) returns on which side of the middle between two floats the
/// number is.
template <class Compare>
float nearest_float(const Number& digits, const Compare& compare) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    // The digits may be rounded up across the middle of two floats, or be rounded twice.
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

/// Returns the float nearest to a positive root, ties to even, but never 0 or infinity.
float rounded(const Root& root, const Number& digits);
float rounded(const Root& root);

/// Returns the double nearest to a positive root, ties to even, but never 0 or infinity.
double rounded_to_double(const Root& root, const Number& digits);

} // namespace raylane::oracle
