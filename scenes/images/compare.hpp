#pragma once

#include "core/scene/film.hpp"
#include "scenes/images/reader.hpp"

#include <cstdint>

namespace raylane::scenes {

/// The difference between two images. The difference between two components is its absolute
/// value. It is 0 for equal infinities and for two NaNs. It is infinite if only one component is
/// NaN, or if an infinity differs from the other component. If at least one of the images has an
/// alpha, alpha is a component, too, and colours are multiplied by alpha before they are compared:
/// differences that cannot be seen do not count.
struct Comparison {
    double rmse = 0.0;          ///< root of the mean square difference of all components
    double psnr = 0.0;          ///< dB, for a peak of 1; infinite if the images are equal
    double largest = 0.0;       ///< largest difference of any component
    int x = 0;                  ///< column of the first pixel that has it, from the left
    int y = 0;                  ///< row of that pixel, from the top
    std::int64_t differing = 0; ///< pixels with a difference above the tolerance
    std::int64_t pixels = 0;    ///< all pixels
};

/// Throws BadInput with b's name if the images differ in size or in kind (integer codes or linear
/// floats).
Comparison compare(const Image& a, const Image& b, float tolerance);

/// Returns the differences by component, scaled so that the largest finite one is 1. Infinite ones
/// are 1. Differences of alpha show in all components. Throws the same as compare().
core::Film difference_image(const Image& a, const Image& b);

} // namespace raylane::scenes
