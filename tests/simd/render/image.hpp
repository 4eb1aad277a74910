#pragma once

#include "simd/isa/isa.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace raylane::tests {

/// Returns the image of a scene with its settings, row by row.
inline std::vector<core::Color> image(const core::Scene& scene, simd::Engine engine,
                                      simd::Isa isa = simd::best_isa(),
                                      core::Precision precision = core::Precision::exact) {
    return simd::render(scene, scene.settings(),
                        {.engine = engine, .isa = isa, .precision = precision})
        .film.pixels();
}

/// Checks that both engines render the same image, and all instruction sets the same bits.
inline void check_engines_agree(const core::Scene& scene) {
    const std::vector<core::Color> vector = image(scene, simd::Engine::vector);
    const std::vector<core::Color> reference = image(scene, simd::Engine::reference);
    int differ = 0;
    for (std::size_t i = 0; i < vector.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            differ += std::abs(vector[i][channel] - reference[i][channel]) > 1e-5F ? 1 : 0;
    CHECK(differ == 0);
    for (const simd::Isa isa : simd::available_isas())
        CHECK(image(scene, simd::Engine::vector, isa) == vector);
}

/// Returns the sRGB value that an image shows for a linear one, by IEC 61966-2-1.
inline double shown(float linear) {
    const double x = std::clamp(static_cast<double>(linear), 0.0, 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

} // namespace raylane::tests
