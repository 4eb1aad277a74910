#pragma once

#include "core/numbers/vector.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <limits>
#include <string_view>

/// Values that fuzzers make of their bytes.
namespace raylane::fuzz {

/// Ends the program with a finding.
[[noreturn]] inline void found(std::string_view what) {
    std::cerr << "found: " << what << std::endl;
    __builtin_trap();
}

/// Makes values of bytes, one after the other. After the last byte, bytes are 0.
class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), end_(data + size) {}

    bool any() const { return data_ != end_; }
    int byte() { return any() ? *data_++ : 0; }
    /// Returns 0, ..., count - 1. `count` is at most 256.
    int below(int count) { return byte() % count; }
    bool flag() { return (byte() & 1) != 0; }

    template <class Value>
    Value raw() {
        char bits[sizeof(Value)];
        for (char& bit : bits)
            bit = static_cast<char>(byte());
        Value value;
        std::memcpy(&value, bits, sizeof value);
        return value;
    }

    /// Returns a finite number: mostly a small integer, or a half or a quarter, so that surfaces
    /// touch; or a number beside these, or any float or double.
    template <class Real>
    Real number() {
        const int first = byte();
        constexpr int count = 17 * 11;
        if (first < count) {
            constexpr Real scales[] = {1, 1, 1, 1, 1, 1, 1, 0.5, 0.5, 0.25, 4};
            return static_cast<Real>(first % 17 - 8) * scales[first / 17];
        }
        switch (first % 8) {
        case 0: // by some ulps
        case 1: {
            Real value = static_cast<Real>(below(17) - 8);
            for (int ulps = below(7) - 3; ulps != 0; ulps += ulps < 0 ? 1 : -1)
                value = std::nextafter(value, ulps < 0 ? -8 * std::abs(value) - 1
                                                       : 8 * std::abs(value) + 1);
            return is_usual(value) ? value : Real(0);
        }
        case 2:
            return std::ldexp(Real(1), below(129) - 64);
        case 3:
            return -std::ldexp(Real(below(8)), below(129) - 64);
        case 4:
            return static_cast<Real>(below(200) - 100) / Real(3);
        case 5:
            return static_cast<Real>(raw<std::int16_t>()) / Real(1000);
        default: {
            const Real value = raw<Real>();
            return is_usual(value) ? value : static_cast<Real>(first % 3);
        }
        }
    }
    template <class Real>
    core::Vec3<Real> vector() {
        const Real x = number<Real>(), y = number<Real>();
        return {x, y, number<Real>()};
    }

    /// Returns number(), or now and then an infinity, NaN or an extreme number.
    float any_float() {
        const int special = byte();
        if (special < 250) return number<float>();
        constexpr float inf = std::numeric_limits<float>::infinity();
        constexpr float specials[] = {inf,
                                      -inf,
                                      std::numeric_limits<float>::quiet_NaN(),
                                      std::numeric_limits<float>::max(),
                                      std::numeric_limits<float>::denorm_min(),
                                      -0.0F};
        return specials[special - 250];
    }

  private:
    /// Returns whether a scene, and a ray in double, may have this number.
    template <class Real>
    static bool is_usual(Real value) {
        const Real size = std::abs(value);
        return value == 0 || (size <= Real(1e30) && size >= Real(1.2e-38));
    }

    const std::uint8_t* data_;
    const std::uint8_t* end_;
};

} // namespace raylane::fuzz
