#include "calls.hpp"
#include "values.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

using namespace raylane;
using namespace raylane::c;

namespace {

raylane_progress to_c(const Progress& progress) {
    const Tile& tile = progress.tile;
    return {progress.pixels, progress.total_pixels, progress.rays, tile.x,           tile.y,
            tile.width,      tile.height,           tile.rgb,      tile.floats_a_row};
}

template <class Value>
void give(const std::vector<Value>& values, Value* to) {
    if (to != nullptr) std::copy(values.begin(), values.end(), to);
}

raylane_status render_to(const raylane_scene* scene, const raylane_render_options& from,
                         const raylane_image& to) {
    const Scene& drawn = checked("scene", scene).scene;
    RenderOptions options;
    options.settings =
        from.settings != nullptr ? converted<Settings>(*from.settings) : drawn.settings();
    options.settings->alpha = to.alpha != nullptr || drawn.settings().alpha;
    options.threads = from.threads;
    options.precision = enum_from_int<Precision>("precision", from.precision);
    if (from.crop_width != 0 || from.crop_height != 0)
        options.crop = {from.crop_x, from.crop_y, from.crop_width, from.crop_height};
    options.aovs = to.depth != nullptr || to.normal != nullptr || to.shape_id != nullptr ||
                   to.material != nullptr || to.samples != nullptr;
    if (from.annotations != nullptr) options.annotations = from.annotations;
    options.on_remark = keeping_remarks();
    const std::optional<Image> image = render(drawn, options, [&](const Progress& done) {
        if (from.progress == nullptr) return true;
        const raylane_progress told = to_c(done);
        return from.progress(&told, from.user) != 0;
    });
    if (!image) return failed(RAYLANE_CANCELLED, "cancelled");
    give(image->rgb, to.rgb);
    give(image->alpha, to.alpha);
    give(image->aovs.depth, to.depth);
    give(image->aovs.normal, to.normal);
    give(image->aovs.shape_id, to.shape_id);
    give(image->aovs.material, to.material);
    give(image->aovs.samples, to.samples);
    return RAYLANE_OK;
}

template <class Component>
raylane_status texture_of(int width, int height, const Component* components,
                          raylane_texture** texture) noexcept {
    return handle_of("texture", texture, [&] {
        const bool is_empty = width <= 0 || height <= 0;
        const auto count = is_empty ? 0
                                    : std::size_t{3} * static_cast<std::size_t>(width) *
                                          static_cast<std::size_t>(height);
        return Texture(width, height, std::span(&checked("components", components), count));
    });
}

} // namespace

raylane_status raylane_texture_from_codes(int width, int height, const uint8_t* srgb,
                                          raylane_texture** texture) {
    return texture_of(width, height, srgb, texture);
}

raylane_status raylane_texture_from_floats(int width, int height, const float* linear,
                                           raylane_texture** texture) {
    return texture_of(width, height, linear, texture);
}

void raylane_texture_release(raylane_texture* texture) {
    delete texture;
}

raylane_status raylane_render(const raylane_scene* scene, const raylane_settings* settings,
                              int threads, int precision, raylane_progress_callback progress,
                              void* user, float* rgb) {
    return guarded([&] {
        raylane_image image{};
        image.rgb = &checked("rgb", rgb);
        return render_to(scene, {settings, threads, precision, 0, 0, 0, 0, progress, user, nullptr},
                         image);
    });
}

raylane_render_options raylane_default_render_options(void) {
    return {nullptr, 0, RAYLANE_EXACT, 0, 0, 0, 0, nullptr, nullptr, nullptr};
}

raylane_status raylane_render_image(const raylane_scene* scene,
                                    const raylane_render_options* options,
                                    const raylane_image* image) {
    return guarded([&] {
        return render_to(scene, options != nullptr ? *options : raylane_default_render_options(),
                         checked("image", image));
    });
}
