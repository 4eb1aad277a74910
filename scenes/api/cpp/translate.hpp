#pragma once

#include "core/shapes/invalid_value.hpp"
#include "core/shapes/precision.hpp"
#include "raylane/errors.hpp"
#include "raylane/precision.hpp"
#include "simd/threads/default_rounding.hpp"

namespace raylane::library {

/// Calls f() in the default rounding mode, regardless of the caller's, and converts internal
/// exceptions to the library's public ones.
template <class F>
decltype(auto) translated(const F& f) {
    const simd::DefaultRounding rounding;
    try {
        return f();
    } catch (const core::InvalidValue& invalid) {
        throw InvalidValue(invalid.field, invalid.expectation);
    }
}

/// Throws InvalidValue, field "threads", unless `threads` is from 0 to simd::max_threads.
void require_threads(int threads);
/// Converts the precision. Throws InvalidValue if the value is not an enumerator.
core::Precision core_precision(Precision precision);

} // namespace raylane::library
