#pragma once

#include "core/scene/layers.hpp"
#include "simd/layers/first_hits.hpp"

namespace raylane::simd {

/// Fills in a region of the layers of a picture, or of a part of it, `of`, but for the samples.
void fill_layers(FirstHits& tracer, const core::Region& region, const core::Region& of,
                 core::Layers& layers);

} // namespace raylane::simd
