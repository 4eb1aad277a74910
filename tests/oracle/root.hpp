#pragma once

#include "tests/oracle/exact.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
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

/// Returns the float or double nearest to a nonnegative number with these first digits, ties to
/// even. If the digits do not decide, compare(sum) returns on which side of the middle between two
/// neighbours the number is. `sum`: of the neighbours, twice the middle.
template <class Real, class Compare>
Real nearest_number(const Number& digits, const Compare& compare) {
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    using Bits = std::conditional_t<std::is_same_v<Real, float>, std::uint32_t, std::uint64_t>;
    // The digits may be rounded up across the middle of two numbers, or be rounded twice.
    Real low = std::nextafter(static_cast<Real>(digits), Real(0));
    for (int steps = 0; steps < 3; ++steps) {
        const Real next = std::nextafter(low, infinity);
        if (next == infinity) break;
        const auto a = static_cast<double>(low), b = static_cast<double>(next);
        int side = compare_digits(digits, (Number(a) + Number(b)) / 2);
        if (side == 0) side = compare(Exact(a) + Exact(b));
        if (side < 0) break;
        const bool low_is_even = (__builtin_bit_cast(Bits, low) & 1) == 0;
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
