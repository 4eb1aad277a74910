#pragma once

#include "core/numbers/inline_vector.hpp"

#include <concepts>
#include <cstdint>

namespace raylane::core {

/// value * 2^exponent, where the exponent may exceed the range of double's exponents.
struct Scaled {
    double value = 0.0; ///< 0, or of magnitude [0.5, 1)
    std::int64_t exponent = 0;

    static Scaled of(double value, std::int64_t exponent);
    /// Converts to double and keeps the sign. Overflow gives the largest finite magnitude,
    /// underflow the smallest positive magnitude, which is subnormal. So only 0 gives 0.
    double to_double() const;
};

/// An integer of any size times a power of two: sums and products of doubles are exact.
class Dyadic {
  public:
    Dyadic() = default;
    template <std::floating_point Real>
    Dyadic(Real value) : Dyadic(from_double, static_cast<double>(value)) {} // NOLINT: exact, finite

    static Dyadic power_of_2(int exponent);

    int sign() const { return digits_.size() == 0 ? 0 : negative_ ? -1 : 1; }
    /// Returns the value with a relative error of at most 2^-50.
    Scaled approximately() const;

    friend Dyadic operator-(Dyadic a) {
        a.negative_ = !a.negative_;
        return a;
    }
    friend Dyadic operator+(const Dyadic& a, const Dyadic& b) { return sum(a, b, b.negative_); }
    friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return sum(a, b, !b.negative_); }
    friend Dyadic operator*(const Dyadic& a, const Dyadic& b);
    friend bool operator==(const Dyadic& a, const Dyadic& b);

  private:
    using Digit = std::uint64_t;
    struct FromDouble {};
    static constexpr FromDouble from_double{};

    Dyadic(FromDouble, double value);

    std::int64_t end() const { return exponent_ + static_cast<std::int64_t>(digits_.size()); }
    Digit digit_at(std::int64_t place) const {
        return place < exponent_ || place >= end()
                   ? 0
                   : digits_[static_cast<std::size_t>(place - exponent_)];
    }
    static Dyadic sum(const Dyadic& a, const Dyadic& b, bool b_is_negative);
    static int compare_magnitudes(const Dyadic& a, const Dyadic& b);
    void trim();

    // |value| is the sum of digits_[i] * 2^(64 * (exponent_ + i)). The digits at both ends are not
    // 0, and 0 has no digits.
    InlineVector<Digit, 20> digits_; // enough for most numbers
    std::int64_t exponent_ = 0;
    bool negative_ = false;
};

} // namespace raylane::core
