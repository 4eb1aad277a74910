#include "calls.hpp"
#include "values.hpp"

#include <algorithm>
#include <optional>

using namespace raylane;
using namespace raylane::c;

namespace {

raylane_progress to_c(const Progress& progress) {
    const Tile& tile = progress.tile;
    return {progress.pixels, progress.total_pixels, progress.rays, tile.x,           tile.y,
            tile.width,      tile.height,           tile.rgb,      tile.floats_a_row};
}

} // namespace

raylane_status raylane_render(const raylane_scene* scene, const raylane_settings* settings,
                              int threads, int precision, raylane_progress_callback progress,
                              void* user, float* rgb) {
    return guarded([&] {
        static_cast<void>(checked("rgb", rgb));
        const Scene& drawn = checked("scene", scene).scene;
        RenderOptions options;
        if (settings != nullptr) {
            options.settings = converted<Settings>(*settings);
            options.settings->alpha = drawn.settings().alpha;
        }
        options.threads = threads;
        options.precision = enum_from_int<Precision>("precision", precision);
        const std::optional<Image> image = render(drawn, options, [&](const Progress& done) {
            if (progress == nullptr) return true;
            const raylane_progress told = to_c(done);
            return progress(&told, user) != 0;
        });
        if (!image) return failed(RAYLANE_CANCELLED, "cancelled");
        std::copy(image->rgb.begin(), image->rgb.end(), rgb);
        return RAYLANE_OK;
    });
}
