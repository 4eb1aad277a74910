#pragma once

#include "core/scene/material.hpp"

#include <span>
#include <vector>

namespace raylane::core {

/// Returns the shares of light at some wavelengths, in nanometres, as linear RGB. The shares of
/// each channel add up to 1, so light that is equal at all of them keeps its colour. Source: the
/// CIE's colour matching functions of 1931, as approximated by Wyman, Sloan and Shirley ("Simple
/// Analytic Approximations to the CIE XYZ Color Matching Functions", 2013). Negative sRGB
/// components count as 0.
std::vector<Color> shares_of(std::span<const double> wavelengths);

} // namespace raylane::core
