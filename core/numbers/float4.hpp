#pragma once

#include <cstdint>

namespace raylane::core {

/// Four floats, as a vector type of the compilers, for loops that are limited by minima: g++
/// compiles plain float minima to scalar code.
using Float4 [[gnu::vector_size(16)]] = float;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

inline Float4 all4(float value) {
    return Float4{value, value, value, value};
}
inline Float4 least(const Float4& a, const Float4& b) {
    return a < b ? a : b;
}
inline Float4 greatest(const Float4& a, const Float4& b) {
    return a > b ? a : b;
}

} // namespace raylane::core
