#pragma once

#include "simd/isa.hpp"
#include "simd/render.hpp"

#include <vector>

namespace raylane::tests {

/// Returns the image of a scene with its settings, row by row.
inline std::vector<core::Color> picture(const core::Scene& scene, simd::Engine engine,
                                        simd::Isa isa = simd::best_isa()) {
    return simd::render(scene, scene.settings(), {.engine = engine, .isa = isa}).film.pixels();
}

} // namespace raylane::tests
