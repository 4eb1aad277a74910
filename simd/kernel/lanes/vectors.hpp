#pragma once

#include "simd/kernel/lanes/lanes.hpp"

#include <type_traits>

/// Arithmetic on registers of floats, in the same order as core/numbers/vector.hpp and so with the
/// same bits.
namespace raylane::simd {

template <class Arch>
Floats<Arch> mul_add(const Floats<Arch>& a, const Floats<Arch>& b, const Floats<Arch>& c) {
    return Lanes<Arch>::mul_add(a, b, c);
}

/// Returns -a by the compiler's operator, which can make the sign a part of an FMA. In some
/// versions of xsimd -a is 0 - a, which loses the sign of zeros.
template <class Number, class Arch>
xsimd::batch<Number, Arch> negated(const xsimd::batch<Number, Arch>& a) {
    return -static_cast<typename xsimd::batch<Number, Arch>::register_type>(a);
}

/// Returns a constant in all lanes of floats or doubles.
template <class Arch>
Floats<Arch> constant(float value) {
    return Floats<Arch>(static_cast<typename Floats<Arch>::value_type>(value));
}
template <class Arch>
Floats<Arch> zero() {
    return constant<Arch>(0.0F);
}

/// Same as core::Divisor, per lane.
template <class Arch>
class Divisor {
  public:
    explicit Divisor(const Floats<Arch>& value) : by_(value) {
        if constexpr (in_float) by_ = constant<Arch>(1.0F) / value;
    }
    /// Returns the stored number, from which of_kept() restores the divisor.
    Floats<Arch> kept() const { return by_; }
    static Divisor of_kept(const Floats<Arch>& kept) { return {kept, 0}; }

    friend Floats<Arch> operator/(const Floats<Arch>& a, const Divisor& divisor) {
        if constexpr (in_float)
            return a * divisor.by_;
        else
            return a / divisor.by_;
    }

  private:
    static constexpr bool in_float = std::is_same_v<typename Floats<Arch>::value_type, float>;
    Divisor(const Floats<Arch>& kept, int) : by_(kept) {}
    Floats<Arch> by_;
};

/// One vector per lane.
template <class Arch>
struct Vectors {
    Floats<Arch> x, y, z;
};

template <class Arch>
Vectors<Arch> operator-(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Arch>
Vectors<Arch> operator-(const Vectors<Arch>& a) {
    return {negated(a.x), negated(a.y), negated(a.z)};
}

template <class Arch>
Vectors<Arch> operator+(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Arch>
Vectors<Arch> operator/(const Vectors<Arch>& a, const Floats<Arch>& s) {
    return {a.x / s, a.y / s, a.z / s};
}

template <class Arch>
Vectors<Arch> scaled(const Floats<Arch>& s, const Vectors<Arch>& a) {
    return {s * a.x, s * a.y, s * a.z};
}

/// s * a + b
template <class Arch>
Vectors<Arch> mul_add(const Floats<Arch>& s, const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return {mul_add<Arch>(s, a.x, b.x), mul_add<Arch>(s, a.y, b.y), mul_add<Arch>(s, a.z, b.z)};
}

template <class Arch>
Floats<Arch> dot(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return mul_add<Arch>(a.x, b.x, mul_add<Arch>(a.y, b.y, a.z * b.z));
}

template <class Arch>
Floats<Arch> squared_length(const Vectors<Arch>& a) {
    return dot(a, a);
}

template <class Arch>
Vectors<Arch> cross(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Arch>
Vectors<Arch> normalized(const Vectors<Arch>& a) {
    return a / sqrt(squared_length(a));
}

/// Same as normalized() except for rounding, with one division.
template <class Arch>
Vectors<Arch> unit(const Vectors<Arch>& a) {
    return scaled(constant<Arch>(1.0F) / sqrt(squared_length(a)), a);
}

template <class Arch>
Vectors<Arch> select(const Mask<Arch>& mask, const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

} // namespace raylane::simd
