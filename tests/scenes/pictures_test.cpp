#include "core/scene/transfer.hpp"
#include "scenes/formats/scene_file.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/places.hpp"
#include "tests/scenes/shared_scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

/// Tests of whole images by the vector engine. They equal the reference's, up to a few pixels, and
/// do not depend on the instruction set, the tiles or the threads.
using namespace raylane;

namespace {

core::Settings test_settings(const core::Scene& scene) {
    const int longest = tests::fixed_rounds(80, 48, 160); // pixels
    core::Settings settings = tests::scaled_down(scene.settings(), longest);
    settings.grid = std::min(settings.grid, 2);
    return settings;
}

core::Film image_of(const core::Scene& scene, const core::Settings& settings,
                    const simd::RenderOptions& options) {
    return simd::render(scene, settings, options).film;
}

/// Returns the largest difference of two colours, in 8-bit codes.
int difference(const core::Color& a, const core::Color& b, core::Transfer transfer) {
    int largest = 0;
    for (int channel = 0; channel < 3; ++channel)
        largest = std::max(largest, std::abs(core::encode(a[channel], transfer) -
                                             core::encode(b[channel], transfer)));
    return largest;
}

/// Returns the contrast of an image around a pixel, in 8-bit codes.
int contrast(const core::Film& film, int x, int y, core::Transfer transfer) {
    int largest = 0;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, film.height() - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, film.width() - 1); ++u)
            largest = std::max(largest, difference(film.at(x, y), film.at(u, v), transfer));
    return largest;
}

void check(const std::filesystem::path& path) {
    CAPTURE(path.filename());
    const core::Scene scene = scenes::load_scene(path);
    const core::Settings settings = test_settings(scene);

    const simd::RenderOptions reference{.engine = simd::Engine::reference};
    const core::Film expected = image_of(scene, settings, reference);
    const core::Film film = image_of(scene, settings, {});

    int differing = 0;
    for (int y = 0; y < settings.height; ++y)
        for (int x = 0; x < settings.width; ++x) {
            const int found = difference(film.at(x, y), expected.at(x, y), settings.transfer);
            if (found <= 1) continue;
            ++differing;
            CHECK(contrast(expected, x, y, settings.transfer) >= std::max(found / 2, 8));
        }
    CHECK(differing * 10000 <= settings.width * settings.height);

    for (const simd::Isa isa : simd::available_isas()) {
        const simd::RenderOptions options{.isa = isa, .threads = 1};
        CAPTURE(simd::name_of(isa));
        CHECK(image_of(scene, settings, options).pixels() == film.pixels());
    }
    for (const int tile : {8, 23, 64}) {
        const simd::RenderOptions options{.tile = tile, .threads = 2};
        CAPTURE(tile);
        CHECK(image_of(scene, settings, options).pixels() == film.pixels());
    }
}

void check_shared(const std::string& name) {
    if (const auto path = tests::shared_scene(name)) check(*path);
}

} // namespace

TEST_CASE("the vector engine renders the shipped scenes as the reference does", "[native]") {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(RAYLANE_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".json" ||
            entry.path().filename().string().find("schema") != std::string::npos)
            continue;
        check(entry.path());
        ++scenes;
    }
    CHECK(scenes >= 14);
}

TEST_CASE("the vector engine renders the databases' balls as the reference does") {
    check_shared("balls.nff");
}

TEST_CASE("the vector engine renders the databases' rings as the reference does") {
    check_shared("rings.nff");
}

TEST_CASE("the vector engine renders the databases' tree as the reference does") {
    check_shared("tree.nff");
}
