#pragma once

#include "core/numbers/dyadic.hpp"

#include <cstddef>

/// Bounds on exact numbers of intervals.
namespace raylane::core {

inline Dyadic magnitude(const Dyadic& a) {
    return a.sign() < 0 ? -a : a;
}
inline const Dyadic& larger(const Dyadic& a, const Dyadic& b) {
    return (a - b).sign() > 0 ? a : b;
}

/// A number within `error` of a value.
struct Within {
    Dyadic value, error;

    /// Returns 0 if the sign is not certain.
    int sign() const { return (magnitude(value) - error).sign() > 0 ? value.sign() : 0; }
};

/// Returns a polynomial's values in an interval: the value at an end, and the most by which it
/// changes. Coefficient k is that of x^k.
template <class Coefficients>
Within within(const Coefficients& polynomial, const Dyadic& low, const Dyadic& high) {
    const Dyadic farther = larger(magnitude(low), magnitude(high));
    std::size_t k = polynomial.size() - 1;
    Dyadic value = polynomial[k], steepest = static_cast<double>(k) * magnitude(polynomial[k]);
    while (k-- > 0) {
        value = value * low + polynomial[k];
        if (k > 0)
            steepest = steepest * farther + static_cast<double>(k) * magnitude(polynomial[k]);
    }
    return {value, (high - low) * steepest};
}

} // namespace raylane::core
