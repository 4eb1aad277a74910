#pragma once

#include "simd/isa/built_isas.hpp" // made by CMake: Isa built_isas[]

#include <cstddef>
#include <iterator>
#include <utility>

/// Selects among functions that raylane_kernel_units compiles once for each instruction set.
namespace raylane::simd {

/// Returns choose.operator()<isa>(). Undefined unless `isa` is a built instruction set.
template <class Choose>
auto of_isa(Isa isa, const Choose& choose) {
    return [&]<std::size_t... index>(std::index_sequence<index...>) {
        decltype(choose.template operator()<built_isas[0]>()) result{};
        (void)((isa == built_isas[index] &&
                (result = choose.template operator()<built_isas[index]>(), true)) ||
               ...);
        return result;
    }
    (std::make_index_sequence<std::size(built_isas)>());
}

} // namespace raylane::simd
