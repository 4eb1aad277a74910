#pragma once

#include "core/scene/layers.hpp"
#include "simd/layers/first_hits.hpp"

namespace raylane::simd {

/// Fills in a region of an image's layers, except for the samples. The layers cover the part `of`
/// of the image.
void fill_layers(FirstHits& tracer, const core::Region& region, const core::Region& of,
                 core::Layers& layers);

} // namespace raylane::simd
