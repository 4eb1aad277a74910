#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace raylane::core {

/// Method of finding the hits of rays.
enum class Precision : std::uint8_t {
    fast,         ///< float, textbook formulas: for previews and comparisons
    robust,       ///< float, the best formulas that float has
    exact,        ///< double with proven error bounds, and wider if in doubt
    plain_double, ///< double, with the formulas of robust: for comparisons
};

inline constexpr Precision all_precisions[] = {Precision::fast, Precision::robust, Precision::exact,
                                               Precision::plain_double};

/// Returns the name for users.
constexpr std::string_view name_of(Precision precision) {
    constexpr std::string_view names[] = {"fast", "robust", "exact", "double"};
    return names[static_cast<std::size_t>(precision)];
}

constexpr bool is_single(Precision precision) {
    return precision == Precision::fast || precision == Precision::robust;
}

/// Default precision of a tracer with these numbers.
template <class Real>
inline constexpr Precision precision_of =
    std::is_same_v<Real, float> ? Precision::robust : Precision::exact;

} // namespace raylane::core
