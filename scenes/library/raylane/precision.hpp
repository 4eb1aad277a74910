#pragma once

#include "raylane/api.h"

#include <cstdint>

namespace RAYLANE_API raylane {

/// Method by which the hits of rays are found. `exact` decides as real arithmetic does for the
/// numbers given, and is hardly slower than `robust`: the others are there to compare with, and for
/// previews. Scenes with solids that are made of others (Solid) are asked exactly, whatever is
/// wanted.
enum class Precision : std::uint8_t {
    fast,         ///< float, by the textbooks' formulas: wrong where these cancel
    robust,       ///< float, by the best formulas that float has
    exact,        ///< certified by proven error bounds
    plain_double, ///< double, by robust's formulas
};

} // namespace raylane
