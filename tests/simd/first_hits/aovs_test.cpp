#include "core/scene/camera_rays.hpp"
#include "core/shapes/invalid_value.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <numeric>

/// AOVs beside an image's colours, and crops of images.
using namespace raylane;
using namespace little_scene;

namespace {

/// Returns a ball on a floor, behind a triangle and a sheet that is visible only from its back;
/// 41 x 33 pixels.
Scene still_life(float quality = 0.0F) {
    Builder builder;
    builder.settings.width = 41;
    builder.settings.height = 33;
    builder.settings.grid = 2;
    builder.settings.quality = quality;
    builder.settings.max_depth = 2;
    builder.background = {0.25F, 0.5F, 0.75F};
    builder.camera.from = {1, 2, 8};
    builder.camera.field_of_view = 30.0F;
    builder.add_shape(Plane{{0, -1, 0}, {0, 1, 0}}, ruler({3, 0, 3}));
    builder.add_shape(Sphere{{0, 0, 0}, 1}, mirror(0.5F));
    builder.add_shape(Sphere{{0, 0, 0}, 1}, mirror(0.5F)); // another material, so it is not dropped
    Material sheet = luminous();
    sheet.visible = Visible::inside;
    builder.add_shape(Disc{{0, 0, 3}, {0, 0, 1}, 0.7F}, sheet);
    builder.add_shape(Triangle{{1, -1, 1}, {2, -1, 1}, {1, 1, 0}}, luminous());
    return builder.finish();
}

core::Aovs aovs_of(const Scene& scene, simd::RenderOptions options = {}) {
    options.aovs = true;
    return simd::render(scene, scene.settings(), options).aovs;
}

bool same(const core::Aovs& a, const core::Aovs& b) {
    return a.width == b.width && a.height == b.height && a.depth == b.depth &&
           a.normal == b.normal && a.shape == b.shape && a.material == b.material &&
           a.samples == b.samples;
}

} // namespace

TEST_CASE("AOVs hold the first hit of the ray through a pixel's middle") {
    const Scene scene = still_life();
    const core::Aovs aovs = aovs_of(scene);
    Settings settings = scene.settings();
    settings.grid = 1;
    const CameraRays<double> rays(scene.camera(), settings);
    Searcher<double> searcher(scene, Search::hierarchy, Precision::exact);
    std::vector<int> seen(scene.shape_count() + 1);
    REQUIRE(aovs.width == 41);
    REQUIRE(aovs.height == 33);
    for (int y = 0; y < aovs.height; ++y)
        for (int x = 0; x < aovs.width; ++x) {
            const Ray<double> ray = rays.ray(x, y, 0);
            const Hit<double> hit =
                searcher
                    .nearest(
                        ray, {},
                        [&](const Hit<double>& candidate) {
                            return scene.material_of(candidate.shape).is_seen(candidate.enters());
                        })
                    .hit;
            const std::size_t pixel = aovs.index(x, y);
            CHECK(aovs.shape[pixel] == hit.shape);
            CHECK(aovs.depth[pixel] == static_cast<float>(hit.t));
            CHECK(aovs.samples[pixel] == 4);
            ++seen[hit.any() ? hit.shape : scene.shape_count()];
            if (!hit.any()) {
                CHECK(aovs.material[pixel] == no_material);
                CHECK(aovs.normal[pixel] == Vec3f(0.0F));
                continue;
            }
            CHECK(aovs.material[pixel] == scene.material_index_of(hit.shape));
            const Vec3d normal = convert<double>(aovs.normal[pixel]);
            CHECK(std::abs(length(normal) - 1.0) < 1e-6);
            CHECK(dot(normal, ray.direction) < 0.0);
            Vec3d true_normal = searcher.surface_at(ray, {}, hit).normal;
            if (!hit.entering) true_normal = -true_normal;
            CHECK(length(Vec3d(normal - true_normal)) < 1e-6);
        }
    for (const std::size_t shape : {0U, 1U, 4U, 5U}) // the last is for misses
        CHECK(seen[shape] != 0);
    CHECK(seen[3] == 0); // visible only from its back
}

TEST_CASE("AOVs have the same bits for all threads and engines and instruction sets") {
    const Scene scene = still_life();
    const core::Aovs aovs = aovs_of(scene);
    simd::RenderOptions options{.tile = 8, .threads = 5};
    CHECK(same(aovs, aovs_of(scene, options)));
    options.precision = Precision::fast;
    CHECK(same(aovs, aovs_of(scene, options)));
    options.engine = simd::Engine::reference;
    CHECK(same(aovs, aovs_of(scene, options)));
    for (const simd::Isa isa : simd::available_isas()) {
        options = {};
        options.isa = isa;
        CHECK(same(aovs, aovs_of(scene, options)));
    }
    CHECK(simd::render(scene, scene.settings(), {}).aovs.width == 0); // not requested
}

TEST_CASE("AOVs count the samples that a quality takes") {
    const Scene scene = still_life(25.0F);
    const simd::Rendering rendering = simd::render(scene, scene.settings(), {.aovs = true});
    const auto& samples = rendering.aovs.samples;
    CHECK(*std::min_element(samples.begin(), samples.end()) == 1);
    CHECK(*std::max_element(samples.begin(), samples.end()) >= 4);
    // Primary rays include a sample in the middle of each pixel, which counts only in pixels that
    // get no more samples.
    const std::uint64_t total = std::accumulate(samples.begin(), samples.end(), 0ULL);
    CHECK(total <= rendering.counters.primary);
    CHECK(total + samples.size() >= rendering.counters.primary);
}

TEST_CASE("a crop has the same bits as in the whole image") {
    for (const float quality : {0.0F, 25.0F})
        for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference}) {
            if (quality != 0.0F && engine == simd::Engine::reference) continue; // it takes long
            const Scene scene = still_life(quality);
            Settings settings = scene.settings();
            settings.outline.width = 3.0F;
            settings.outline.color = {1, 0, 0};
            simd::RenderOptions options{.engine = engine, .aovs = true};
            const simd::Rendering whole_rendering = simd::render(scene, settings, options);
            for (const Region& crop :
                 {Region{0, 0, 41, 33}, {5, 3, 6, 4}, {17, 0, 41, 20}, {9, 15, 37, 33}}) {
                options.crop = crop;
                const simd::Rendering part = simd::render(scene, settings, options);
                CHECK(part.film.pixels() == whole_rendering.film.cropped(crop).pixels());
                REQUIRE(part.aovs.depth.size() == static_cast<std::size_t>(crop.pixels()));
                for (int y = crop.y0; y < crop.y1; ++y)
                    for (int x = crop.x0; x < crop.x1; ++x) {
                        const std::size_t part_index = part.aovs.index(x - crop.x0, y - crop.y0);
                        const std::size_t whole_index = whole_rendering.aovs.index(x, y);
                        CHECK(part.aovs.shape[part_index] ==
                              whole_rendering.aovs.shape[whole_index]);
                        CHECK(part.aovs.samples[part_index] ==
                              whole_rendering.aovs.samples[whole_index]);
                    }
            }
        }
}

TEST_CASE("a crop that is not inside of the image is refused") {
    const Scene scene = still_life();
    for (const Region& crop :
         {Region{0, 0, 42, 33}, {-1, 0, 3, 3}, {3, 3, 3, 5}, {40, 32, 41, 34}, {5, 5, 4, 6}}) {
        CHECK_THROWS_AS(simd::render(scene, scene.settings(), {.crop = crop}), InvalidValue);
    }
}
