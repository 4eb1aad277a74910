#pragma once

#include "core/scene/film.hpp"
#include "scenes/image/reader.hpp"

#include <cstdint>

namespace raylane::scenes {

/// Difference of two pictures. The difference of two components is the absolute one; it is 0 for
/// equal infinities and for two NaNs, and infinite where just one is NaN or the infinities differ.
/// If one of the pictures has an alpha, that is a component, too, and colours are compared as they
/// are multiplied by it: what cannot be seen is no difference.
struct Comparison {
    double rmse = 0.0;          ///< root of the mean square difference of all components
    double psnr = 0.0;          ///< dB, for a peak of 1; infinite if the pictures are equal
    double largest = 0.0;       ///< difference of any component
    int x = 0;                  ///< the first pixel that has it, from the left
    int y = 0;                  ///< from the top
    std::int64_t differing = 0; ///< pixels with a difference above the tolerance
    std::int64_t pixels = 0;    ///< in all
};

/// Throws BadInput, in b's name, if the pictures differ in size, or in kind: codes against linear
/// floats.
Comparison compare(const Image& a, const Image& b, float tolerance);

/// The differences by component, amplified so that the largest finite one is 1. An infinite one
/// is 1. Those of an alpha show in all components. Throws as compare does.
core::Film difference_image(const Image& a, const Image& b);

} // namespace raylane::scenes
