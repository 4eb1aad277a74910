#include "scenes/scene_file.hpp"
#include "simd/isa.hpp"
#include "simd/scene_data.hpp"
#include "simd/wavefront/wavefront.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

/// Finds how the rays of each pixel were decided, including those of reflections, refractions and
/// shadows: the most that any of them took. Each pixel is rendered separately, so that the engine's
/// counters are those of the pixel.
///
/// usage: raylane-tiers SCENE WIDTH HEIGHT   writes a PGM of these numbers to standard output
namespace raylane::bench {
namespace {

enum Tier : std::uint8_t {
    certified, ///< bounds in float, and one crossing in double that its error bound separates
    /// All candidates for the first crossing, in double with bounds or with twice the digits; or
    /// shadow rays from surface to surface.
    refined,
    scalar,   ///< one crossing by the scalar code, in double with bounds
    widened,  ///< the same with more digits than double has, or exactly
    followed, ///< the whole path by the reference: surfaces meet, or too many follow each other
};

Tier tier_of(const simd::EngineCounters& counters) {
    if (counters.followed != 0) return followed;
    if (counters.widened != 0) return widened;
    if (counters.doubtful != 0) return scalar;
    if (counters.refined != 0 || counters.walked != 0) return refined;
    return certified;
}

std::vector<std::uint8_t> tiers_of(const core::Scene& scene, int width, int height) {
    core::Settings settings = scene.settings();
    settings.width = width;
    settings.height = height;
    settings.quality = 0.0F; // which squares of pixels would share
    const simd::SceneData data(scene);
    simd::Wavefront wavefront(data, settings, {&simd::kernels_of(simd::best_isa())});
    core::Film film(width, height, settings.alpha);
    std::vector<std::uint8_t> tiers;
    tiers.reserve(static_cast<std::size_t>(width) * static_cast<unsigned>(height));
    simd::EngineCounters before = wavefront.counters();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            wavefront.render({x, y, x + 1, y + 1}, film);
            const simd::EngineCounters after = wavefront.counters();
            simd::EngineCounters of_pixel = after;
            of_pixel -= before;
            tiers.push_back(tier_of(of_pixel));
            before = after;
        }
    return tiers;
}

} // namespace
} // namespace raylane::bench

int main(int argc, char** argv) {
    using namespace raylane;
    const int width = argc == 4 ? std::atoi(argv[2]) : 0;
    const int height = argc == 4 ? std::atoi(argv[3]) : 0;
    if (width < 1 || height < 1 || width > 16384 || height > 16384) {
        std::fputs("usage: raylane-tiers SCENE WIDTH HEIGHT > TIERS.pgm\n", stderr);
        return 2;
    }
    try {
        const auto tiers = bench::tiers_of(scenes::load_scene(argv[1]), width, height);
        std::printf("P5\n%d %d\n%d\n", width, height, static_cast<int>(bench::followed));
        if (std::fwrite(tiers.data(), 1, tiers.size(), stdout) != tiers.size()) return 3;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "raylane-tiers: %s\n", error.what());
        return 2;
    }
    return 0;
}
