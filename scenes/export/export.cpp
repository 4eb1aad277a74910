#include "scenes/export/export.hpp"

#include "scenes/export/writers.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/built/built_file.hpp"

namespace raylane::scenes {

namespace {

enum class Format { json, nff, pov, built };

Format format_of(const std::filesystem::path& path) {
    if (path == "-") return Format::json;
    const std::string ending = ending_of(path);
    if (ending == ".json") return Format::json;
    if (ending == ".nff") return Format::nff;
    if (ending == ".pov") return Format::pov;
    if (ending == ".rl") return Format::built;
    throw BadInput(path.string(), "", "must end in .json, .nff, .pov or .rl");
}

} // namespace

void require_scene_ending(const std::filesystem::path& path) {
    static_cast<void>(format_of(path));
}

std::vector<std::string> export_scene(const std::filesystem::path& path, const core::Scene& scene) {
    const Format format = format_of(path);
    AtomicFile file(path);
    TextFile text(file);
    Differences differences;
    try {
        switch (format) {
        case Format::json:
            write_json(text, scene, differences, path.parent_path());
            break;
        case Format::nff:
            write_nff(text, scene, differences);
            break;
        case Format::pov:
            write_pov(text, scene, differences);
            break;
        case Format::built:
            write_built(file, scene);
        }
    } catch (const core::InvalidValue& invalid) {
        throw BadInput(path.string(), "", invalid.what());
    }
    text.flush();
    file.commit();
    return {differences.begin(), differences.end()};
}

} // namespace raylane::scenes
