#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/tool/checkpoint/checkpoint.hpp"
#include "scenes/tool/checkpoint/fingerprint.hpp"
#include "tests/places.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"

#include <atomic>
#include <string>
#include <thread>
#include <vector>

/// Tests of several threads at a time, for ThreadSanitizer.
using namespace raylane;

namespace {

/// Calls `body` on this many threads at once, with the thread's number.
template <class Body>
void on_threads(int count, const Body& body) {
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i)
        threads.emplace_back([&body, i] { body(i); });
    for (std::thread& thread : threads)
        thread.join();
}

struct Input {
    std::string name, text;
};

/// Returns scenes of nearly all formats, and files with mistakes.
std::vector<Input> inputs() {
    const std::filesystem::path root(RAYLANE_SOURCE_DIR), seeds = root / "tests/fuzz/seeds";
    std::vector<Input> inputs_of_test = {
        {"a.json", tests::content_of(root / "scenes/lens.json")},
        {"b.json", tests::content_of(root / "scenes/prism.json")},
        {"a.pov", "camera { location -6*z look_at 0 }\nlight_source { 9, rgb 1 }\n"
                  "#macro M(I) sphere { I*x, 1 } #end\nunion { M(1) M(2) texture { pigment { "
                  "color rgb <1, 0, 0> } } }\n"},
        {"bad.json", "{\"objects\": [{\"type\": \"sphere\"}]}"},
        {"bad.pov", "sphere { 0 }"}};
    const std::pair<const char*, const char*> of_seeds[] = {
        {"a.cif", "cif.small"},    {"m.cif", "cif.macromolecule"},
        {"a.gro", "gro.plain"},    {"a.lmp", "lammps_data.plain"},
        {"a.nff", "nff.plain"},    {"a.lammpstrj", "lammps_dump.plain"},
        {"a.pdb", "pdb.plain"},    {"a.xyz", "xyz.plain"},
        {"b.xyz", "xyz.extended"}, {"a.mol", "mol.v2000"},
        {"b.mol", "mol.v3000"},    {"a.mol2", "mol2.plain"},
        {"a.pqr", "pqr.plain"}};
    for (const auto& [name, seed] : of_seeds)
        inputs_of_test.push_back({name, tests::content_of(seeds / seed)});
    return inputs_of_test;
}

/// Returns the fingerprint of the scene that is read, or the error.
std::string outcome_of(const Input& input) {
    try {
        return scenes::fingerprint_of(
            scenes::parse_scene(input.name, input.text, {.on_remark = [](const std::string&) {}}));
    } catch (const scenes::BadInput& bad) {
        return bad.what();
    }
}

struct Drawing {
    core::Scene scene =
        scenes::load_scene(std::filesystem::path(RAYLANE_SOURCE_DIR) / "scenes/mirrors.json");
    core::Settings settings = [&] {
        core::Settings small = scene.settings();
        small.width = 64;
        small.height = 48;
        small.grid = 1;
        return small;
    }();
    simd::RenderOptions options{.tile = 8, .threads = 4};
};

} // namespace

TEST_CASE("several threads can read scenes at a time") {
    const std::vector<Input> inputs_of_test = inputs();
    std::vector<std::string> alone;
    for (const Input& input : inputs_of_test)
        alone.push_back(outcome_of(input));
    std::atomic<int> wrong = 0;
    on_threads(4, [&](int thread) {
        for (std::size_t i = 0; i < 2 * inputs_of_test.size(); ++i) {
            const std::size_t which =
                (i + static_cast<std::size_t>(5 * thread)) % inputs_of_test.size();
            wrong += outcome_of(inputs_of_test[which]) == alone[which] ? 0 : 1;
        }
    });
    CHECK(wrong == 0);
}

TEST_CASE(
    "a checkpoint records tiles of several threads until another stops them and restores them") {
    const tests::TemporaryDirectory directory;
    Drawing drawing;
    const simd::Rendering whole_rendering =
        simd::render(drawing.scene, drawing.settings, drawing.options);
    const auto draw = [&](bool stops) {
        scenes::Checkpoint checkpoint(directory.path() / "picture",
                                      {scenes::fingerprint_of(drawing.scene), "options"},
                                      {drawing.settings, drawing.options});
        simd::RenderOptions with = drawing.options;
        simd::Progress progress;
        with.progress = &progress;
        with.recall = [&](const simd::TileToFill& tile) { return checkpoint.recall(tile); };
        with.after_tile = [&](const simd::FinishedTile& tile) { checkpoint.note(tile); };
        std::thread other([&] {
            while (stops && progress.pixels < 64 * 48 / 3)
                std::this_thread::yield();
            if (stops) progress.stop = true;
        });
        simd::Rendering rendering = simd::render(drawing.scene, drawing.settings, with);
        other.join();
        CHECK(checkpoint.keep());
        return rendering;
    };
    static_cast<void>(draw(true));
    const simd::Rendering rest = draw(false);
    CHECK(rest.complete);
    CHECK(rest.film.pixels() == whole_rendering.film.pixels());
    CHECK(rest.counters.rays() == whole_rendering.counters.rays());
}

TEST_CASE("several renderings can be abandoned at a time") {
    const Drawing drawing;
    core::Settings hours = drawing.settings;
    hours.grid = 256;
    std::atomic<int> complete = 0;
    on_threads(3, [&](int thread) {
        simd::Progress progress;
        simd::RenderOptions with = drawing.options;
        with.progress = &progress;
        std::thread other([&] {
            while (progress.rays == 0 && thread != 0)
                std::this_thread::yield();
            progress.abandon = progress.stop = true;
        });
        complete += simd::render(drawing.scene, hours, with).complete ? 1 : 0;
        other.join();
    });
    CHECK(complete == 0);
}
