#include "core/numbers/dyadic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::core {

namespace {

constexpr int digit_bits = 64;
__extension__ using TwoDigits = unsigned __int128;

} // namespace

Scaled Scaled::of(double value, std::int64_t exponent) {
    int own = 0;
    const double mantissa = std::frexp(value, &own);
    return {mantissa, exponent + own};
}

double Scaled::to_double() const {
    using Limits = std::numeric_limits<double>;
    if (value == 0.0) return 0.0;
    if (exponent > Limits::max_exponent) return std::copysign(Limits::max(), value);
    const double result =
        std::ldexp(value, static_cast<int>(std::max<std::int64_t>(exponent, -2000)));
    return result == 0.0 ? std::copysign(Limits::denorm_min(), value) : result;
}

Dyadic::Dyadic(FromDouble, double value) : negative_(value < 0.0) {
    if (value == 0.0) return;
    int power = 0;
    const double mantissa = std::frexp(std::abs(value), &power);
    const auto integer = static_cast<std::uint64_t>(std::ldexp(mantissa, 53));
    // whole 2^(power - 53), shifted to a multiple of 64 bits.
    const int lowest = power - 53;
    const int shift = ((lowest % digit_bits) + digit_bits) % digit_bits;
    exponent_ = (lowest - shift) / digit_bits;
    const TwoDigits shifted = TwoDigits{integer} << shift;
    digits_.reset(2);
    digits_[0] = static_cast<Digit>(shifted);
    digits_[1] = static_cast<Digit>(shifted >> digit_bits);
    trim();
}

Dyadic Dyadic::power_of_2(int exponent) {
    const int shift = ((exponent % digit_bits) + digit_bits) % digit_bits;
    Dyadic power = std::ldexp(1.0, shift);
    power.exponent_ += (exponent - shift) / digit_bits;
    return power;
}

void Dyadic::trim() {
    std::size_t first = 0, last = digits_.size();
    while (last > 0 && digits_[last - 1] == 0)
        --last;
    while (first < last && digits_[first] == 0)
        ++first;
    digits_.keep(first, last);
    exponent_ = first == last ? 0 : exponent_ + static_cast<std::int64_t>(first);
}

Scaled Dyadic::approximately() const {
    double sum = 0.0;
    for (std::int64_t place = end() - 2; place < end(); ++place)
        sum += std::ldexp(static_cast<double>(digit_at(place)),
                          digit_bits * static_cast<int>(place - end() + 2));
    return Scaled::of(negative_ ? -sum : sum, digit_bits * (end() - 2));
}

int Dyadic::compare_magnitudes(const Dyadic& a, const Dyadic& b) {
    if (a.digits_.size() == 0 || b.digits_.size() == 0)
        return static_cast<int>(b.digits_.size() == 0) - static_cast<int>(a.digits_.size() == 0);
    if (a.end() != b.end()) return a.end() > b.end() ? 1 : -1;
    const std::int64_t lowest = std::min(a.exponent_, b.exponent_);
    for (std::int64_t place = a.end() - 1; place >= lowest; --place) {
        const Digit x = a.digit_at(place), y = b.digit_at(place);
        if (x != y) return x > y ? 1 : -1;
    }
    return 0;
}

bool operator==(const Dyadic& a, const Dyadic& b) {
    return a.sign() == b.sign() && Dyadic::compare_magnitudes(a, b) == 0;
}

Dyadic Dyadic::sum(const Dyadic& a, const Dyadic& b, bool b_is_negative) {
    if (b.digits_.size() == 0) return a;
    Dyadic result;
    if (a.digits_.size() == 0) {
        result = b;
        result.negative_ = b_is_negative;
        return result;
    }
    const bool subtract = a.negative_ != b_is_negative;
    const bool a_is_larger = !subtract || compare_magnitudes(a, b) >= 0;
    const Dyadic& larger = a_is_larger ? a : b;
    const Dyadic& smaller = a_is_larger ? b : a;
    result.negative_ = a_is_larger ? a.negative_ : b_is_negative;
    result.exponent_ = std::min(a.exponent_, b.exponent_);
    const std::int64_t end = std::max(a.end(), b.end());
    const auto size = static_cast<std::size_t>(end - result.exponent_);
    result.digits_.reset(size + 1);
    Digit carry = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const std::int64_t place = result.exponent_ + static_cast<std::int64_t>(i);
        const TwoDigits x = larger.digit_at(place), y = smaller.digit_at(place);
        const TwoDigits digit = subtract ? x - y - carry : x + y + carry;
        result.digits_[i] = static_cast<Digit>(digit);
        carry = static_cast<Digit>(digit >> digit_bits) & 1;
    }
    result.digits_[size] = subtract ? 0 : carry;
    result.trim();
    return result;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    Dyadic product;
    const std::size_t m = a.digits_.size(), n = b.digits_.size();
    if (m == 0 || n == 0) return product;
    product.negative_ = a.negative_ != b.negative_;
    product.exponent_ = a.exponent_ + b.exponent_;
    product.digits_.reset(m + n);
    for (std::size_t k = 0; k < n; ++k)
        product.digits_[k] = 0;
    for (std::size_t i = 0; i < m; ++i) {
        Dyadic::Digit carry = 0;
        for (std::size_t j = 0; j < n; ++j) {
            const TwoDigits digit =
                TwoDigits{a.digits_[i]} * b.digits_[j] + product.digits_[i + j] + carry;
            product.digits_[i + j] = static_cast<Dyadic::Digit>(digit);
            carry = static_cast<Dyadic::Digit>(digit >> digit_bits);
        }
        product.digits_[i + n] = carry;
    }
    product.trim();
    return product;
}

} // namespace raylane::core
