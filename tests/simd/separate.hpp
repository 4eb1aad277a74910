#pragma once

#include <cmath>
#include <type_traits>

namespace raylane::tests {

/// A double without fused operations. With it, core's templates give the same bits as the kernels
/// in lanes of doubles.
struct Separate {
    double value = 0.0;

    Separate() = default;
    template <class Number>
    requires std::is_arithmetic_v<Number> Separate(Number exact)
        : value(static_cast<double>(exact)) {} // NOLINT: implicit, exact
    explicit operator double() const { return value; }

    friend Separate operator-(Separate a) { return -a.value; }
    friend Separate operator+(Separate a, Separate b) { return a.value + b.value; }
    friend Separate operator-(Separate a, Separate b) { return a.value - b.value; }
    friend Separate operator*(Separate a, Separate b) { return a.value * b.value; }
    friend Separate operator/(Separate a, Separate b) { return a.value / b.value; }
    friend Separate sqrt(Separate a) { return std::sqrt(a.value); }
    friend bool operator<(Separate a, Separate b) { return a.value < b.value; }
    friend bool operator>(Separate a, Separate b) { return a.value > b.value; }
    friend bool operator==(Separate a, Separate b) { return a.value == b.value; }
};

} // namespace raylane::tests
