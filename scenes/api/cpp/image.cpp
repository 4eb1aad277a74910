#include "raylane/image.hpp"

#include "core/scene/validate.hpp"
#include "scenes/api/cpp/convert.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "scenes/api/cpp/translate.hpp"
#include "simd/threads/threads.hpp"
#include "simd/wavefront/render.hpp"

#include <algorithm>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace raylane {

using library::converted;
using library::translated;

namespace {

/// Returns the result of f(). Names the settings in the errors that it throws.
auto of_settings(const auto& f) {
    try {
        return f();
    } catch (const core::InvalidValue& invalid) {
        throw InvalidValue("settings/" + invalid.field, invalid.expectation);
    }
}

core::Settings settings_for(const Scene& scene, const RenderOptions& options) {
    if (!options.settings) return library::Internals::of(scene).settings();
    const auto settings = converted<core::Settings>(*options.settings);
    of_settings([&] { core::validate(settings); });
    return settings;
}

/// Returns the scene with an automatic camera placed for the proportions of an image.
core::Scene placed_for(const core::Settings& settings, const Scene& scene) {
    core::Scene result = library::Internals::of(scene);
    const core::Settings& own = result.settings();
    const bool is_similar =
        std::int64_t{settings.width} * own.height == std::int64_t{own.width} * settings.height;
    const core::AutoCamera auto_camera = result.auto_camera();
    if (!auto_camera.fit_camera || is_similar) return result;
    const core::View view = core::staged(result, auto_camera, settings);
    return std::move(result).seen(auto_camera, view);
}

simd::Rendering render_with(const core::Scene& scene, const core::Settings& settings,
                            const simd::RenderOptions& options) {
    library::require_threads(options.threads);
    if (options.threads == 0)
        translated(
            [] { static_cast<void>(simd::default_threads()); }); // throws without "settings/"
    return of_settings([&] { return simd::render(scene, settings, options); });
}

simd::RenderOptions inner_options(const core::Settings& settings, const RenderOptions& options) {
    simd::RenderOptions inner;
    inner.threads = options.threads;
    inner.precision = library::core_precision(options.precision);
    inner.aovs = options.aovs;
    if (const auto& crop = options.crop) {
        const auto is_within = [](int first, int count, int size) { // no sum, which could overflow
            return first >= 0 && count >= 1 &&
                   count <= std::min(size, core::Settings::max_size) - first;
        };
        if (!is_within(crop->x, crop->width, settings.width) ||
            !is_within(crop->y, crop->height, settings.height))
            throw InvalidValue("crop", "must lie within the image");
        inner.crop = {crop->x, crop->y, crop->x + crop->width, crop->y + crop->height};
    }
    return inner;
}

/// Returns a function that puts a scene's annotations over a film or into a file. It is empty for a
/// scene without annotations. `placed`: the scene with its camera for the image.
std::function<void(core::Film&)> annotating(const Scene& scene, const core::Scene& placed,
                                            const core::Settings& settings,
                                            const std::optional<core::Region>& crop,
                                            const RenderOptions& options) {
    const auto& annotations = library::Internals::annotations_of(scene);
    if (annotations != nullptr &&
        (options.annotations.empty() || options.annotations.extension() == ".svg")) {
        const core::Region part =
            crop.value_or(core::Region{0, 0, settings.width, settings.height});
        return annotations->of_image(placed, settings, part, options.annotations,
                                     options.on_remark);
    }
    if (options.annotations.empty()) return {};
    throw InvalidValue("annotations",
                       annotations != nullptr
                           ? "must end with .svg, got \"" + options.annotations.string() + '"'
                           : "goes with a scene of atoms that has annotations, "
                             "such as label or scale_bar");
}

template <class Vector>
std::vector<float> components_of(const std::vector<Vector>& vectors) {
    std::vector<float> components;
    components.reserve(3 * vectors.size());
    for (const Vector& vector : vectors)
        components.insert(components.end(), {vector.x, vector.y, vector.z});
    return components;
}

Image image_of(simd::Rendering rendering) {
    const core::Film& film = rendering.film;
    core::Aovs& aovs = rendering.aovs;
    return {film.width(),
            film.height(),
            components_of(film.pixels()),
            film.alphas(),
            {std::move(aovs.depth), components_of(aovs.normal), std::move(aovs.shape),
             std::move(aovs.material), std::move(aovs.samples)}};
}

Tile tile_of(const core::Film& film, const core::Region& region) {
    static_assert(sizeof(core::Color) == 3 * sizeof(float));
    return {region.x0,
            region.y0,
            region.x1 - region.x0,
            region.y1 - region.y0,
            &film.at(region.x0, region.y0).x,
            std::size_t{3} * film.width(),
            film.has_alpha() ? &film.alphas()[film.index(region.x0, region.y0)] : nullptr};
}

} // namespace

Image render(const Scene& scene, const RenderOptions& options) {
    const core::Settings settings = settings_for(scene, options);
    const simd::RenderOptions inner = inner_options(settings, options);
    const core::Scene placed = placed_for(settings, scene);
    const auto annotate = annotating(scene, placed, settings, inner.crop, options);
    simd::Rendering rendering = render_with(placed, settings, inner);
    if (annotate) annotate(rendering.film);
    return image_of(std::move(rendering));
}

std::optional<Image> render(const Scene& scene, const RenderOptions& options,
                            const ProgressCallback& progress) {
    if (!progress) return render(scene, options);
    const core::Settings settings = settings_for(scene, options);
    simd::RenderOptions inner = inner_options(settings, options);
    const core::Scene placed = placed_for(settings, scene);
    const auto annotate = annotating(scene, placed, settings, inner.crop, options);
    const core::Region drawn = simd::drawn_part(settings, inner.crop);
    const std::int64_t total = std::int64_t{drawn.x1 - drawn.x0} * (drawn.y1 - drawn.y0);
    simd::Progress made;
    std::mutex calling;
    bool has_ended = false; // true once the callback has returned false or thrown
    inner.progress = &made;
    inner.after_tile = [&](const simd::FinishedTile& tile) {
        const std::lock_guard lock(calling);
        if (has_ended) return;
        has_ended = true;
        has_ended = !progress({made.pixels, total, made.rays, tile_of(tile.film, tile.region)});
        made.stop = made.abandon = has_ended;
    };
    simd::Rendering rendering = render_with(placed, settings, inner);
    if (!rendering.complete || has_ended) return std::nullopt;
    if (annotate) annotate(rendering.film);
    return image_of(std::move(rendering));
}

} // namespace raylane
