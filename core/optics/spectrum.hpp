#pragma once

#include "core/scene/material.hpp"

#include <span>
#include <vector>

namespace raylane::core {

/// Shares of light of some wavelengths, in nanometres, in linear RGB: of each channel they add up
/// to 1, so that what is the same for all of them keeps its colour. By the CIE's colour matching
/// functions of 1931 (as Wyman, Sloan and Shirley have them, "Simple Analytic Approximations to the
/// CIE XYZ Color Matching Functions", 2013), without what sRGB has no positive share for.
std::vector<Color> shares_of(std::span<const double> wavelengths);

} // namespace raylane::core
