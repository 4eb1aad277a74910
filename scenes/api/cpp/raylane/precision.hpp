#pragma once

#include "raylane/api.hpp"

#include <cstdint>

namespace RAYLANE_API raylane {

/// Method by which hits are found. `exact` decides as real arithmetic does for the given numbers,
/// and is hardly slower than `robust`. The other methods serve comparisons and previews. Scenes
/// with constructed solids (Solid) are always traced with `exact`.
enum class Precision : std::uint8_t {
    fast,         ///< float, textbook formulas: wrong where terms cancel
    robust,       ///< float, the most accurate formulas known for float
    exact,        ///< certified by proven error bounds
    plain_double, ///< double, with the formulas of `robust`
};

} // namespace raylane
