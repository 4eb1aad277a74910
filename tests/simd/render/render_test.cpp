#include "core/shapes/invalid_value.hpp"
#include "simd/wavefront/render.hpp"
#include "simd/wavefront/tiles.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <atomic>
#include <stdexcept>
#include <vector>

using namespace raylane;
using namespace little_scene;

namespace {

Scene mirrored_ball() {
    Builder builder;
    builder.settings.width = 70;
    builder.settings.height = 50;
    builder.background = {0.25F, 0.5F, 0.75F};
    builder.add_shape(Sphere{{0, 0, 0}, 1}, mirror(0.5F));
    builder.add_shape(Plane{{0, -1, 0}, {0, 1, 0}}, ruler({3, 0, 3}));
    return builder.finish();
}

} // namespace

TEST_CASE("every pixel is in one tile") {
    for (const int width : {1, 15, 16, 17, 100})
        for (const int height : {1, 16, 33}) {
            std::vector<std::atomic<int>> visits(static_cast<std::size_t>(width) * height);
            simd::for_each_tile({{0, 0, width, height}, 16}, 2, [&](const Region& region) {
                for (int y = region.y0; y < region.y1; ++y)
                    for (int x = region.x0; x < region.x1; ++x)
                        ++visits[static_cast<std::size_t>(y) * width + x];
            });
            CHECK(std::all_of(visits.begin(), visits.end(),
                              [](const auto& count) { return count == 1; }));
        }
}

TEST_CASE("an exception in a tile propagates out of the loop") {
    const auto fail = [](const Region&) { throw std::runtime_error("tile"); };
    CHECK_THROWS_AS(simd::for_each_tile({{0, 0, 100, 100}, 16}, 2, fail), std::runtime_error);
}

TEST_CASE("a source chooses the tiles and is cancelled after an exception") {
    struct Source : simd::TileSource {
        std::atomic<std::size_t> taken = 0;
        std::atomic<bool> is_cancelled = false;
        std::optional<std::size_t> next() override {
            const std::size_t number = 2 * taken++;
            if (number >= 49 || is_cancelled) return std::nullopt;
            return number;
        }
        void cancel() override { is_cancelled = true; }
    };
    const simd::TileGrid grid({3, 5, 103, 105}, 16);
    REQUIRE(grid.count() == 49);
    for (std::size_t number = 0; number < grid.count(); ++number)
        CHECK(grid.number_of(grid.tile(number)) == number);
    Source source;
    std::array<std::atomic<int>, 49> visits{};
    simd::for_each_tile(
        grid, 3, [&](const Region& region) { ++visits[grid.number_of(region)]; }, &source);
    for (std::size_t number = 0; number < grid.count(); ++number)
        CHECK(visits[number] == (number % 2 == 0 ? 1 : 0));
    CHECK_FALSE(source.is_cancelled);

    Source broken;
    const auto fail = [](const Region&) { throw std::runtime_error("tile"); };
    CHECK_THROWS_AS(simd::for_each_tile(grid, 3, fail, &broken), std::runtime_error);
    CHECK(broken.is_cancelled);
}

TEST_CASE("an image does not depend on the number of threads") {
    const Scene scene = mirrored_ball();
    simd::RenderOptions one, many;
    one.threads = 1;
    many.threads = 5;
    simd::Progress progress;
    many.progress = &progress;
    const simd::Rendering a = simd::render(scene, scene.settings(), one);
    const simd::Rendering b = simd::render(scene, scene.settings(), many);
    CHECK(a.film.pixels() == b.film.pixels());
    CHECK(a.counters.rays() == b.counters.rays());
    CHECK(progress.pixels == 70 * 50);
    CHECK(progress.rays == b.counters.rays());
    CHECK(a.counters.primary == 70 * 50);
}

TEST_CASE("invalid settings are refused before rendering") {
    const Scene scene = mirrored_ball();
    Settings settings = scene.settings();
    settings.grid = 0;
    CHECK_THROWS_AS(simd::render(scene, settings, {}), InvalidValue);
}

TEST_CASE("paths of the greatest depth fit the threads' stacks", "[native]") {
    Builder builder;
    builder.settings.width = builder.settings.height = 32;
    builder.settings.max_depth = Settings::depth_limit;
    builder.camera.from = {0, 0, 0.5F};
    Material shine = mirror();
    shine.ambient = 1.0F;
    shine.pattern.colors[0] = Color(1.0F);
    builder.add_shape(Plane{{0, 0, 0}, {0, 0, 1}}, shine);
    builder.add_shape(Plane{{0, 0, 1}, {0, 0, -1}}, shine);
    const Scene scene = builder.finish();
    for (const auto precision : {core::Precision::robust, core::Precision::exact}) {
        const simd::Rendering rendering =
            simd::render(scene, scene.settings(),
                         {.engine = simd::Engine::reference, .precision = precision, .threads = 2});
        CHECK(rendering.film.at(16, 16).x == 1001.0F);
    }
    CHECK(simd::render(scene, scene.settings(), {}).film.at(16, 16).x == 1001.0F);
}

TEST_CASE("a rendering that is stopped begins no more tiles") {
    const Scene scene = mirrored_ball();
    simd::Progress progress;
    simd::RenderOptions options{.tile = 16, .threads = 1, .progress = &progress};
    int tiles = 0;
    options.after_tile = [&](const simd::FinishedTile&) { progress.stop = ++tiles == 3; };
    CHECK(!simd::render(scene, scene.settings(), options).complete);
    CHECK(tiles == 3);
    CHECK(progress.pixels <= 3 * 16 * 16);
    CHECK(progress.pixels < 70 * 50);

    progress.stop = false;
    options.after_tile = nullptr;
    CHECK(simd::render(scene, scene.settings(), options).complete);
}
