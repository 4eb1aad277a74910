#include "scenes/formats/scene_file.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/places.hpp"
#include "tests/scenes/shared_scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"
#include "tests/support/scaled_scene.hpp"

#include <cstring>
#include <filesystem>

/// Tests that no number in either engine has an absolute scale: a scene scaled by a power of two
/// gives the same image, to the bit, and as many doubtful rays.
using namespace raylane;

namespace {

core::Settings test_settings(const core::Scene& scene, int longest) {
    longest /= tests::fixed_rounds(2, 4, 1);
    core::Settings settings = tests::scaled_down(scene.settings(), longest);
    settings.grid = 1;
    return settings;
}

long different_pixels(const core::Film& a, const core::Film& b) {
    long count = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        count += std::memcmp(&a.pixels()[i], &b.pixels()[i], sizeof(core::Color)) != 0 ? 1 : 0;
    return count;
}

void check(const std::filesystem::path& path, simd::Engine engine, int longest) {
    CAPTURE(path.filename());
    const core::Scene scene = tests::ScaledScene(scenes::load_scene(path), 1.0F).build();
    core::Settings settings = test_settings(scene, longest);
    const simd::RenderOptions options{.engine = engine};
    if (engine == simd::Engine::reference) settings.quality = 0.0F; // saves time
    const simd::Rendering expected = simd::render(scene, settings, options);
    for (const float factor : {0x1p-20F, 0x1p-3F, 0x1p7F, 0x1p20F}) {
        CAPTURE(factor);
        const core::Scene scaled = tests::ScaledScene(scene, factor).build();
        const simd::Rendering rendering = simd::render(scaled, settings, options);
        CHECK(different_pixels(rendering.film, expected.film) == 0);
        CHECK(rendering.counters.doubtful == expected.counters.doubtful);
    }
}

template <class Visit>
void for_each_scene(const Visit& visit) {
    int scenes = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(RAYLANE_SOURCE_DIR) / "scenes"))
        if (entry.path().extension() == ".json" &&
            entry.path().string().find("schema") == std::string::npos) {
            visit(entry.path());
            ++scenes;
        }
    CHECK(scenes > 10);
}

} // namespace

TEST_CASE("the vector engine's images do not depend on the scale", "[native]") {
    for_each_scene([](const auto& path) { check(path, simd::Engine::vector, 200); });
}

TEST_CASE("the reference's images do not depend on the scale") {
    for_each_scene([](const auto& path) { check(path, simd::Engine::reference, 80); });
}
