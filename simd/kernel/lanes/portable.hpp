#pragma once

#include <cstddef>
#include <cstdint>

/// The part of xsimd that kernels use, implemented with vectors of 16 bytes, which compilers
/// support without a particular instruction set. Each operation gives the same bits as SSE.
namespace raylane::simd {

/// Takes the place of xsimd's architectures.
struct Portable {};

template <class Number>
class PortableMask {
  public:
    typedef Number Numbers __attribute__((vector_size(16)));
    using Lanes = decltype(Numbers{} < Numbers{}); ///< integers: 0 or -1
    static constexpr std::size_t size = sizeof(Lanes) / sizeof(Number);

    PortableMask() = default;
    explicit PortableMask(bool value) : lanes_(Lanes{} - (value ? 1 : 0)) {}
    explicit PortableMask(const Lanes& lanes) : lanes_(lanes) {}

    static PortableMask load_unaligned(const bool* from) {
        PortableMask mask;
        for (std::size_t i = 0; i < size; ++i)
            mask.lanes_[i] = from[i] ? -1 : 0;
        return mask;
    }
    void store_unaligned(bool* to) const {
        for (std::size_t i = 0; i < size; ++i)
            to[i] = lanes_[i] != 0;
    }
    const Lanes& lanes() const { return lanes_; }
    /// Returns lane i as bit i.
    std::uint32_t bits() const {
        typedef std::uint64_t Words __attribute__((vector_size(16)));
        const Words words = __builtin_bit_cast(Words, lanes_ & place());
        const std::uint64_t both = words[0] | words[1];
        return static_cast<std::uint32_t>(both | both >> 32);
    }

    PortableMask operator~() const { return PortableMask(~lanes_); }
    PortableMask operator&(const PortableMask& b) const { return PortableMask(lanes_ & b.lanes_); }
    PortableMask operator|(const PortableMask& b) const { return PortableMask(lanes_ | b.lanes_); }

    /// See crossings.hpp.
    friend PortableMask either_way(const PortableMask& a) { return a; }

  private:
    static Lanes place() {
        if constexpr (size == 4)
            return Lanes{1, 2, 4, 8};
        else
            return Lanes{1, 2};
    }

    Lanes lanes_;
};

template <class Number>
class PortableBatch {
  public:
    using value_type = Number;
    using Mask = PortableMask<Number>;
    using Lanes = typename Mask::Numbers;
    static constexpr std::size_t size = Mask::size;

    PortableBatch() = default;
    explicit PortableBatch(Number value) {
        if constexpr (size == 4)
            lanes_ = Lanes{value, value, value, value};
        else
            lanes_ = Lanes{value, value};
    }
    explicit PortableBatch(const Lanes& lanes) : lanes_(lanes) {}

    static PortableBatch load_unaligned(const Number* from) {
        PortableBatch batch;
        __builtin_memcpy(&batch.lanes_, from, sizeof(Lanes));
        return batch;
    }
    void store_unaligned(Number* to) const { __builtin_memcpy(to, &lanes_, sizeof(Lanes)); }
    const Lanes& lanes() const { return lanes_; }

    Mask operator<(const PortableBatch& b) const { return Mask(lanes_ < b.lanes_); }
    Mask operator<=(const PortableBatch& b) const { return Mask(lanes_ <= b.lanes_); }
    Mask operator>(const PortableBatch& b) const { return Mask(lanes_ > b.lanes_); }
    Mask operator>=(const PortableBatch& b) const { return Mask(lanes_ >= b.lanes_); }
    Mask operator==(const PortableBatch& b) const { return Mask(lanes_ == b.lanes_); }
    Mask operator!=(const PortableBatch& b) const { return Mask(lanes_ != b.lanes_); }

    PortableBatch operator+(const PortableBatch& b) const {
        return PortableBatch(lanes_ + b.lanes_);
    }
    PortableBatch operator-(const PortableBatch& b) const {
        return PortableBatch(lanes_ - b.lanes_);
    }
    PortableBatch operator*(const PortableBatch& b) const {
        return PortableBatch(lanes_ * b.lanes_);
    }
    PortableBatch operator/(const PortableBatch& b) const {
        return PortableBatch(lanes_ / b.lanes_);
    }
    PortableBatch operator&(const PortableBatch& b) const { return from_bits(bits() & b.bits()); }
    PortableBatch operator|(const PortableBatch& b) const { return from_bits(bits() | b.bits()); }
    PortableBatch operator^(const PortableBatch& b) const { return from_bits(bits() ^ b.bits()); }
    PortableBatch operator<<(int count) const { return PortableBatch(lanes_ << count); }
    PortableBatch operator>>(int count) const { return PortableBatch(lanes_ >> count); }

    PortableBatch operator-() const { return PortableBatch(-lanes_); }
    friend PortableBatch negated(const PortableBatch& a) { return -a; }
    friend PortableBatch abs(const PortableBatch& a) {
        return from_bits(a.bits() & ~PortableBatch(Number(-0.0)).bits());
    }
    friend PortableBatch select(const Mask& mask, const PortableBatch& a, const PortableBatch& b) {
        return from_bits((mask.lanes() & a.bits()) | (~mask.lanes() & b.bits()));
    }
    /// Returns b if neither is less than the other.
    friend PortableBatch min(const PortableBatch& a, const PortableBatch& b) {
        return PortableBatch(a.lanes_ < b.lanes_ ? a.lanes_ : b.lanes_);
    }
    friend PortableBatch max(const PortableBatch& a, const PortableBatch& b) {
        return PortableBatch(a.lanes_ > b.lanes_ ? a.lanes_ : b.lanes_);
    }
    friend PortableBatch sqrt(const PortableBatch& a) {
        PortableBatch result;
        for (std::size_t i = 0; i < size; ++i)
            if constexpr (size == 4)
                result.lanes_[i] = __builtin_sqrtf(a.lanes_[i]);
            else
                result.lanes_[i] = __builtin_sqrt(a.lanes_[i]);
        return result;
    }
    /// Exact except for rounding, unlike the approximation of other architectures.
    friend PortableBatch rsqrt(const PortableBatch& a) {
        return PortableBatch(Number(1)) / sqrt(a);
    }
    friend PortableBatch floor(const PortableBatch& a) {
        PortableBatch result;
        for (std::size_t i = 0; i < size; ++i)
            result.lanes_[i] =
                static_cast<Number>(__builtin_floor(static_cast<double>(a.lanes_[i])));
        return result;
    }

  private:
    using Bits = typename Mask::Lanes;

    Bits bits() const { return __builtin_bit_cast(Bits, lanes_); }
    static PortableBatch from_bits(const Bits& bits) {
        return PortableBatch(__builtin_bit_cast(Lanes, bits));
    }

    Lanes lanes_;
};

template <class To, class From>
PortableBatch<To> bits_as(const PortableBatch<From>& from) {
    return PortableBatch<To>(__builtin_bit_cast(typename PortableBatch<To>::Lanes, from.lanes()));
}

/// Returns one half of the lanes in double: the lower (0) or the upper one (1).
inline PortableBatch<double> widened(const PortableBatch<float>& values, int half) {
    typedef float Two __attribute__((vector_size(8)));
    Two two;
    __builtin_memcpy(&two, reinterpret_cast<const float*>(&values) + 2 * half, sizeof(Two));
    return PortableBatch<double>(__builtin_convertvector(two, PortableBatch<double>::Lanes));
}

} // namespace raylane::simd
