#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace raylane::core {

/// A double and a power of two that double's exponents need not hold: value * 2^exponent.
struct Scaled {
    double value = 0.0; ///< 0, or of magnitude [0.5, 1)
    std::int64_t exponent = 0;

    static Scaled of(double value, std::int64_t exponent);
    /// What overflows is the largest double, what underflows the smallest: the sign stays.
    double to_double() const;
};

/// A whole number times a power of two, of any size: sums and products of doubles are exact.
class Dyadic {
  public:
    Dyadic() = default;
    explicit Dyadic(double value); ///< finite

    int sign() const { return digits_.empty() ? 0 : negative_ ? -1 : 1; }
    /// Within 2^-50 of itself.
    Scaled approximately() const;

    friend Dyadic operator-(Dyadic a) {
        a.negative_ = !a.negative_;
        return a;
    }
    friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
    friend Dyadic operator*(const Dyadic& a, const Dyadic& b);
    friend bool operator==(const Dyadic& a, const Dyadic& b);

  private:
    using Digits = std::vector<std::uint32_t>;

    std::int64_t end() const { return exponent_ + static_cast<std::int64_t>(digits_.size()); }
    std::uint32_t digit_at(std::int64_t place) const;
    static int compare_magnitudes(const Dyadic& a, const Dyadic& b);
    void trim();

    // |value| = sum of digits_[i] 2^(32 (exponent_ + i)); neither end's digit is 0, and 0 has none.
    Digits digits_;
    std::int64_t exponent_ = 0;
    bool negative_ = false;
};

} // namespace raylane::core
