#pragma once

#include <array>
#include <span>
#include <string_view>

namespace raylane::core {

/// Sellmeier's formula for the index of refraction n at a wavelength w in micrometres:
///   n^2 = 1 + sum of B_i w^2 / (w^2 - C_i)
/// All B are 0 if the formula is unset: the index is then the same at all wavelengths.
struct Sellmeier {
    std::array<double, 3> B{}, C{}; ///< C in square micrometres

    bool any() const { return B != std::array<double, 3>{}; }
    bool operator==(const Sellmeier&) const = default;
};

/// Wavelength of helium's yellow line, in nanometres, for which catalogues give n_d.
inline constexpr double line_d = 587.5618;

/// Returns the index at a wavelength in nanometres; NaN where the formula has no value.
double index_at(const Sellmeier& glass, double wavelength);
/// Returns true if a material may have this index.
bool is_index(double index);

struct NamedGlass {
    std::string_view name;
    Sellmeier glass;
};

/// Schott's optical glasses (data sheets), fused silica and calcium fluoride (Malitson, 1965 and
/// 1963), and diamond (Peter, 1923).
std::span<const NamedGlass> glass_catalogue();

} // namespace raylane::core
