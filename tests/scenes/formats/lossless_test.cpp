#include "core/reference/tracer.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/places.hpp"
#include "tests/scenes/shared_scene.hpp"
#include "tests/support/catch.hpp"

#include <cstring>

using namespace raylane;

namespace {

/// Checks that the middle of a scene's image is the same with the hierarchy and by testing every
/// shape.
template <class Real>
void check_crop(const std::filesystem::path& path, int size) {
    const core::Scene scene = scenes::load_scene(path);
    core::Settings settings = scene.settings();
    settings.grid = 1;
    const int x = (settings.width - size) / 2, y = (settings.height - size) / 2;
    const core::Region crop{x, y, x + size, y + size};

    core::ReferenceTracer<Real> by_hierarchy(scene, settings, core::Search::hierarchy);
    core::ReferenceTracer<Real> by_trying(scene, settings, core::Search::every_shape);
    core::Film with(settings.width, settings.height), without(settings.width, settings.height);
    by_hierarchy.render(crop, with);
    by_trying.render(crop, without);

    CAPTURE(path.filename());
    CHECK(std::memcmp(with.pixels().data(), without.pixels().data(),
                      with.pixels().size() * sizeof(core::Color)) == 0);
    // Both traced as many rays: a lost hit would lead to fewer.
    CHECK(by_hierarchy.counters().rays() == by_trying.counters().rays());
    CHECK(by_hierarchy.counters().rays() > by_hierarchy.counters().primary);
    CHECK(by_hierarchy.counters().shapes < by_trying.counters().shapes / 10);
}

void check(const std::filesystem::path& path) {
#ifdef RAYLANE_FEW_RAYS
    constexpr int size = 8;
#else
    constexpr int size = 28;
#endif
    check_crop<double>(path, size);
    check_crop<float>(path, size / 4);
}

void check_shared(const std::string& name) {
    if (const auto path = tests::shared_scene(name)) check(*path);
}

} // namespace

TEST_CASE("the hierarchy loses no hit of the sphereflake") {
    check(RAYLANE_SOURCE_DIR "/scenes/sphereflake.json");
}

TEST_CASE("the hierarchy loses no hit of the databases' balls") {
    check_shared("balls.nff");
}

TEST_CASE("the hierarchy loses no hit of the databases' rings") {
    check_shared("rings.nff");
}

TEST_CASE("the hierarchy loses no hit of the databases' tree") {
    check_shared("tree.nff");
}
