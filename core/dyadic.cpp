#include "core/dyadic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::core {

namespace {

constexpr int digit_bits = 32;

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

Dyadic::Dyadic(double value) : negative_(value < 0.0) {
    if (value == 0.0) return;
    int power = 0;
    const double mantissa = std::frexp(std::abs(value), &power);
    const auto whole = static_cast<std::uint64_t>(std::ldexp(mantissa, 53));
    // whole 2^(power - 53), shifted to a multiple of 32 bits.
    const int lowest = power - 53;
    const int shift = ((lowest % digit_bits) + digit_bits) % digit_bits;
    exponent_ = (lowest - shift) / digit_bits;
    const std::uint64_t low = (whole & 0xFFFFFFFFU) << shift;
    const std::uint64_t high = ((whole >> digit_bits) << shift) + (low >> digit_bits);
    digits_ = {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high),
               static_cast<std::uint32_t>(high >> digit_bits)};
    trim();
}

void Dyadic::trim() {
    while (!digits_.empty() && digits_.back() == 0)
        digits_.pop_back();
    const auto first = std::find_if(digits_.begin(), digits_.end(),
                                    [](std::uint32_t digit) { return digit != 0; });
    exponent_ += first - digits_.begin();
    digits_.erase(digits_.begin(), first);
    if (digits_.empty()) exponent_ = 0;
}

std::uint32_t Dyadic::digit_at(std::int64_t place) const {
    return place < exponent_ || place >= end()
               ? 0
               : digits_[static_cast<std::size_t>(place - exponent_)];
}

Scaled Dyadic::approximately() const {
    double sum = 0.0;
    for (std::int64_t place = end() - 3; place < end(); ++place)
        sum += std::ldexp(static_cast<double>(digit_at(place)),
                          digit_bits * static_cast<int>(place - end() + 3));
    return Scaled::of(negative_ ? -sum : sum, digit_bits * (end() - 3));
}

int Dyadic::compare_magnitudes(const Dyadic& a, const Dyadic& b) {
    if (a.digits_.empty() || b.digits_.empty())
        return static_cast<int>(b.digits_.empty()) - static_cast<int>(a.digits_.empty());
    if (a.end() != b.end()) return a.end() > b.end() ? 1 : -1;
    const std::int64_t lowest = std::min(a.exponent_, b.exponent_);
    for (std::int64_t place = a.end() - 1; place >= lowest; --place) {
        const std::uint32_t x = a.digit_at(place), y = b.digit_at(place);
        if (x != y) return x > y ? 1 : -1;
    }
    return 0;
}

bool operator==(const Dyadic& a, const Dyadic& b) {
    return a.sign() == b.sign() && a.exponent_ == b.exponent_ && a.digits_ == b.digits_;
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
    if (a.digits_.empty()) return b;
    if (b.digits_.empty()) return a;
    const bool a_is_larger = Dyadic::compare_magnitudes(a, b) >= 0;
    const Dyadic& larger = a_is_larger ? a : b;
    const Dyadic& smaller = a_is_larger ? b : a;
    const bool subtract = a.negative_ != b.negative_;

    Dyadic sum;
    sum.negative_ = larger.negative_;
    sum.exponent_ = std::min(a.exponent_, b.exponent_);
    sum.digits_.reserve(static_cast<std::size_t>(larger.end() - sum.exponent_ + 1));
    std::int64_t carry = 0;
    for (std::int64_t place = sum.exponent_; place < larger.end(); ++place) {
        const auto digit = static_cast<std::int64_t>(smaller.digit_at(place));
        carry += static_cast<std::int64_t>(larger.digit_at(place)) + (subtract ? -digit : digit);
        sum.digits_.push_back(static_cast<std::uint32_t>(carry));
        carry >>= digit_bits;
    }
    sum.digits_.push_back(static_cast<std::uint32_t>(carry));
    sum.trim();
    return sum;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    Dyadic product;
    if (a.digits_.empty() || b.digits_.empty()) return product;
    product.negative_ = a.negative_ != b.negative_;
    product.exponent_ = a.exponent_ + b.exponent_;
    product.digits_.assign(a.digits_.size() + b.digits_.size(), 0);
    for (std::size_t i = 0; i < a.digits_.size(); ++i) {
        std::uint64_t carry = 0;
        for (std::size_t j = 0; j < b.digits_.size(); ++j) {
            carry += std::uint64_t{a.digits_[i]} * b.digits_[j] + product.digits_[i + j];
            product.digits_[i + j] = static_cast<std::uint32_t>(carry);
            carry >>= digit_bits;
        }
        product.digits_[i + b.digits_.size()] = static_cast<std::uint32_t>(carry);
    }
    product.trim();
    return product;
}

} // namespace raylane::core
