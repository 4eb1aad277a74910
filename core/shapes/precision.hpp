#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace raylane::core {

/// Method by which the hits of rays are found.
enum class Precision : std::uint8_t {
    fast,         ///< float, the textbooks' formulas: for previews, and to compare with
    robust,       ///< float, the best formulas that float has
    exact,        ///< double with proven error bounds, and wider where that leaves a doubt
    plain_double, ///< double, the same formulas as robust's: to compare with
};

inline constexpr Precision all_precisions[] = {Precision::fast, Precision::robust, Precision::exact,
                                               Precision::plain_double};

/// Name for people.
constexpr std::string_view name_of(Precision precision) {
    constexpr std::string_view names[] = {"fast", "robust", "exact", "double"};
    return names[static_cast<std::size_t>(precision)];
}

constexpr bool is_single(Precision precision) {
    return precision == Precision::fast || precision == Precision::robust;
}

/// Default precision of a tracer of these numbers.
template <class Real>
inline constexpr Precision precision_of =
    std::is_same_v<Real, float> ? Precision::robust : Precision::exact;

} // namespace raylane::core
