#pragma once

#include <array>
#include <span>
#include <string_view>

namespace raylane::core {

/// Sellmeier's formula for the index of refraction n at a wavelength w in micrometres:
///   n^2 = 1 + sum of B_i w^2 / (w^2 - C_i)
/// None: all B are 0, and the index is the same for all.
struct Sellmeier {
    std::array<double, 3> B{}, C{}; ///< C in square micrometres

    bool any() const { return B != std::array<double, 3>{}; }
    bool operator==(const Sellmeier&) const = default;
};

/// Of helium's yellow line, in nanometres: what catalogues give n_d for.
inline constexpr double line_d = 587.5618;

/// The index at a wavelength in nanometres; NaN where the formula has none.
double index_at(const Sellmeier& glass, double wavelength);
/// True of what a material may have as its index.
bool is_index(double index);

struct NamedGlass {
    std::string_view name;
    Sellmeier glass;
};

/// Schott's optical glasses (data sheets), fused silica and calcium fluoride (Malitson, 1965 and
/// 1963), and diamond (Peter, 1923).
std::span<const NamedGlass> glass_catalogue();

} // namespace raylane::core
