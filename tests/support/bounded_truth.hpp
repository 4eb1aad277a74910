#pragma once

#include "core/numbers/dyadic.hpp"
#include "tests/support/random.hpp"

#include <cmath>

/// Checks bounds of numbers (high + low within an error) with exact arithmetic.
namespace raylane::tests {

using core::Dyadic;

struct BoundedNumber {
    double high, low, error;

    Dyadic value() const { return Dyadic(high) + low; }
    /// Returns the lower bound or (`greatest`) the upper bound.
    Dyadic end(bool greatest) const { return value() + (greatest ? error : -error); }
};

enum class Operation { sum, product, quotient, root };
inline constexpr Operation all_operations[] = {Operation::sum, Operation::product,
                                               Operation::quotient, Operation::root};

inline bool is_within(const Dyadic& difference, const Dyadic& most) {
    return (most - difference).sign() >= 0 && (most + difference).sign() >= 0;
}

/// Returns whether the result's bounds hold for these exact operands. A result without bounds
/// holds.
inline bool bounds_hold(Operation operation, const Dyadic& a, const Dyadic& b,
                        const BoundedNumber& result) {
    if (!(result.error < HUGE_VAL) || !std::isfinite(result.high)) return true;
    const Dyadic value = result.value(), error = result.error;
    switch (operation) {
    case Operation::sum:
        return is_within(value - (a + b), error);
    case Operation::product:
        return is_within(value - a * b, error);
    case Operation::quotient:
        return is_within(value * b - a, error * (b.sign() < 0 ? -b : b));
    case Operation::root: {
        const Dyadic most = value + error, least = value - error;
        return (most * most - a).sign() >= 0 &&
               (least.sign() <= 0 || (a - least * least).sign() >= 0);
    }
    }
    return false;
}

/// Returns an operand of few digits or many, or 0, with an error or without.
inline BoundedNumber any_bounded(ray_sets::Random& random, bool wide) {
    const double sign = random.integer(0, 1) == 0 ? 1.0 : -1.0;
    BoundedNumber number{};
    switch (random.integer(0, 3)) {
    case 0:
        break;
    case 1:
        number.high = sign * random.integer(1, 64) * 0.125;
        break;
    default:
        number.high = sign * random.log_uniform(1e-30, 1e30);
        if (wide) number.low = number.high * random.uniform(-0x1p-54, 0x1p-54);
    }
    if (random.integer(0, 1) == 0)
        number.error = random.log_uniform(1e-40, 1e-3) * (number.high == 0.0 ? 1.0 : number.high);
    number.error = std::abs(number.error);
    return number;
}

/// Changes a number so that it has a root anywhere within its bounds.
inline BoundedNumber with_root(BoundedNumber a) {
    if (a.high < 0.0) a.high = -a.high, a.low = -a.low;
    return a.end(false).sign() < 0 ? BoundedNumber{a.high, a.low, 0.0} : a;
}

} // namespace raylane::tests
