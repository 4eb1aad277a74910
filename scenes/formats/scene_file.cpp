#include "scenes/formats/scene_file.hpp"

#include "core/scene/best_view.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/built/built_file.hpp"
#include "scenes/formats/format.hpp"
#include "scenes/formats/json/reader.hpp"
#include "scenes/formats/nff/reader.hpp"
#include "scenes/formats/pov/reader.hpp"
#include "scenes/formats/structure/frames.hpp"
#include "scenes/formats/structure/structure_file.hpp"
#include "scenes/formats/tachyon/reader.hpp"

namespace raylane::scenes {

namespace {

/// Returns a scene whose camera will have the best view once it is placed.
core::Scene seen_best(core::Scene scene) {
    core::AutoCamera auto_camera = scene.auto_camera();
    const core::NamedView best = core::best_view(scene);
    if (!auto_camera.fit_camera) auto_camera.fit_camera = core::fit_camera_of(scene.camera());
    auto_camera.fit_camera->direction = best.direction;
    auto_camera.fit_camera->up = best.up;
    const auto own = static_cast<std::ptrdiff_t>(scene.own_light_count());
    const core::View view = {
        scene.camera(), scene.fog(), {scene.lights().begin() + own, scene.lights().end()}};
    return std::move(scene).seen(auto_camera, view);
}

core::Scene read_other(InputFile& file, Format format, const LoadOptions& options) {
    if (format == Format::built) return read_built(file, options.workers);
    if (format == Format::pov) return read_pov(file, options.workers, options.on_remark);
    if (format == Format::tachyon)
        return read_tachyon(file, options.workers, options.on_remark, options.tachyon);
    return format == Format::json ? read_json(file, options.workers, options.parameters)
                                  : read_nff(file, options.workers, options.on_remark);
}

core::Scene read_format(InputFile& file, const LoadOptions& options) {
    file.on_read = options.on_read;
    const Format format = format_of(file);
    if (!options.parameters.empty() && format != Format::json)
        throw BadInput(file.name(), "",
                       "has no parameter \"$" + printable(options.parameters.begin()->first) +
                           "\": only JSON scenes have parameters");
    if (is_structure(format))
        return read_structure(file, format, options.reader(), options.drawing, options.workers,
                              options.legend);
    if (!options.option_for_atoms.empty())
        throw BadInput(options.option_for_atoms, "",
                       "goes with a file of atoms, but " + printable(file.name(), 4096) +
                           " is a scene");
    const std::optional<core::NamedView>& view = options.drawing.view;
    core::Scene scene = read_other(file, format, options);
    return view && view->name == core::best_view_name ? seen_best(std::move(scene))
                                                      : std::move(scene);
}

core::Scene read_scene(InputFile& file, const LoadOptions& options) {
    core::Scene scene = read_format(file, options);
    if (scene.shape_count() == 0 && options.on_remark)
        options.on_remark(
            text_of({file.name(), {}, "", "has no objects: the image shows only the background"}));
    return scene;
}

} // namespace

void LoadOptions::set_drawing(DrawingOptions given) {
    if (!given.empty()) option_for_atoms = given.front().first;
    std::erase_if(given, [&](const auto& option) {
        const std::string name = listed_name(option.first);
        if (name == "atom-style") atom_style = option.second;
        if (name == "frame") frames = frame_range_of(option.first, option.second);
        return name == "atom-style" || name == "frame";
    });
    drawing = drawing_with(given);
}

core::Scene load_scene(const std::filesystem::path& path, const LoadOptions& options) {
    InputFile file(path);
    return read_scene(file, options);
}

core::Scene parse_scene(const std::string& name, std::string_view text,
                        const LoadOptions& options) {
    InputFile file(name, text);
    return read_scene(file, options);
}

} // namespace raylane::scenes
