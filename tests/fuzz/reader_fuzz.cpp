#include "scenes/files/errors.hpp"
#include "scenes/formats/built/built_file.hpp"
#include "scenes/formats/format.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/formats/structure/structure_file.hpp"
#include "simd/wavefront/render.hpp"

#include <cstdint>
#include <string>
#include <string_view>

/// Reads any bytes with one reader. The result must be a scene, or all frames, or one error that
/// names the file. Anything else (another exception, a sanitizer's finding, memory, time) is a
/// finding.
using namespace raylane;
using scenes::Format;

namespace {

constexpr Format fuzzed = Format::RAYLANE_FUZZ_FORMAT;

/// Returns whether a few bytes rightly make a large scene, which is not of interest here.
bool asks_for_much(std::string_view text) {
    return text.find("sphereflake") != std::string_view::npos ||
           text.find("lattice") != std::string_view::npos;
}

/// Renders the scene, as a reader must not give kernels data that they cannot handle.
void draw(const core::Scene& scene) {
    core::Settings settings = scene.settings();
    settings.width = settings.height = 4;
    settings.grid = 1;
    settings.quality = 0.0F;
    settings.light_samples = 1;
    settings.max_depth = 2;
    settings.max_transparent = 2;
    simd::render(scene, settings, {.threads = 1});
}

void read(std::string_view text, Format format) {
    constexpr const char* endings[] = {"json", "nff", "pov",       "dat", "rl",  "pdb",  "cif",
                                       "xyz",  "gro", "lammpstrj", "lmp", "mol", "mol2", "pqr"};
    const std::string name = std::string("a.") + endings[static_cast<int>(format)];
    scenes::LoadOptions options;
    options.on_remark = [](const std::string&) {};
    if (scenes::is_structure(format)) { // in one of several styles
        const auto& styles = scenes::named_styles();
        options.drawing.style = styles[text.size() % styles.size()].second;
        if (text.find("U_11") != std::string_view::npos ||
            text.find("ANISOU") != std::string_view::npos)
            options.drawing.ellipsoids = static_cast<scenes::Ellipsoids>(text.size() % 4);
        if (text.size() % 7 == 1) options.drawing.boundary = options.drawing.whole = true;
        options.drawing.show_axes = text.size() % 16 == 1;
        options.drawing.hydrogen_bonds = text.size() % 6 == 1;
        if (text.size() % 10 == 1) options.drawing.polyhedra = {"C O 1"};
        options.drawing.show_cell = text.size() % 4 == 1;
        if (text.size() % 8 == 1) options.drawing.repeat = {2, 1, 2};
        if (text.size() % 5 == 1) options.drawing.opacity = 0.5F;
        if (text.size() % 9 == 1)
            options.drawing.show = {{"all: carbons residue"}, {"ligand or x < 0: sticks"}};
    }
    try {
        const core::Scene scene = scenes::parse_scene(name, text, options);
        if (format == Format::built) draw(scene);
    } catch (const scenes::BadInput&) {
        if (!scenes::is_structure(format)) throw;
    }
    if (!scenes::is_structure(format)) return;
    scenes::InputFile file(name, text);
    const auto reader = scenes::open_structure(file, format);
    for (scenes::Structure frame; reader->next(frame);) {
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    if (asks_for_much(text)) return 0;
    try {
        if constexpr (fuzzed == Format::built) {
            std::string sealed(text); // otherwise only checksums are found to be wrong
            scenes::seal(sealed);
            read(sealed, Format::built);
        } else {
            read(text, fuzzed);
        }
    } catch (const scenes::BadInput& bad) {
        const std::string_view message = bad.what();
        // These formats include other files.
        constexpr bool may_be_elsewhere = fuzzed == Format::pov || fuzzed == Format::tachyon;
        const bool names_file = message.starts_with("a.") || may_be_elsewhere;
        if (!names_file || message.empty() || message.size() > 100'000) __builtin_trap();
    } catch (const scenes::SystemRefused&) {
    }
    return 0;
}
