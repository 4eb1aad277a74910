#include "scenes/tool/options/scene_options.hpp"

#include "core/scene/field_of_view.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/json/parameters.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/formats/structure/drawing_options.hpp"
#include "scenes/formats/structure/frames.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace raylane::scenes {

namespace {

/// Makes the image `zoom` times as large around the point that the camera looks at.
void zoom_in(core::Camera& camera, float zoom) {
    camera.height /= zoom;
    camera.field_of_view =
        core::field_of_view(core::slope_of_view(camera.field_of_view) / static_cast<double>(zoom));
}

/// Keeps the size at which the point that the camera looks at is seen.
void project(core::Camera& camera, core::Projection projection) {
    if (camera.projection == projection) return;
    const core::Vec3d at = core::convert<double>(camera.at);
    const core::Vec3d back = core::convert<double>(camera.from) - at;
    const double slope = core::slope_of_view(camera.field_of_view);
    camera.projection = projection;
    if (projection == core::Projection::orthographic)
        camera.height = static_cast<float>(2.0 * core::length(back) * slope);
    else
        camera.from = core::convert<float>(at + static_cast<double>(camera.height) /
                                                    (2.0 * slope * core::length(back)) * back);
}

constexpr int max_images = 1'000'000;

std::optional<double> to_double(std::string_view word) {
    if (!is_number(word)) return std::nullopt;
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || !(std::abs(value) <= 1e30)) return std::nullopt;
    return value;
}

std::optional<ParameterSweep> parameter_sweep_of(const std::string& text) {
    const std::size_t equals = text.find('=');
    ParameterSweep sweep{text.substr(0, equals), {}, false};
    if (equals == std::string::npos || !is_parameter_name(sweep.name)) return std::nullopt;
    const std::vector<std::string_view> parts =
        parts_of(std::string_view(text).substr(equals + 1), ':');
    const std::optional<double> first = to_double(parts[0]);
    if (!first || (parts.size() != 1 && parts.size() != 3)) return std::nullopt;
    sweep.values = {*first};
    if (parts.size() == 1) return sweep;
    sweep.is_sweep = true;
    const std::optional<double> last = to_double(parts[1]);
    const std::optional<int> count = to_int(parts[2]);
    if (!last || !count || *count < 1 || *count > max_images) return std::nullopt;
    // The division comes last, so that whole numbers stay whole.
    for (int i = 1; i + 1 < *count; ++i)
        sweep.values.push_back(*first + i * (*last - *first) / (*count - 1));
    if (*count > 1) sweep.values.push_back(*last);
    return sweep;
}

} // namespace

core::AutoCamera ViewChange::auto_camera(const core::Scene& scene, core::Camera& camera) const {
    core::AutoCamera auto_camera = scene.auto_camera();
    auto_camera.turning = turning;
    auto_camera.depth_cue = depth_cue.value_or(auto_camera.depth_cue);
    if (fixed_camera) {
        camera = *fixed_camera;
        auto_camera.fit_camera.reset();
    }
    if (way && way->direction != core::Vec3f(0.0F)) { // others are found with the scene
        if (!auto_camera.fit_camera) auto_camera.fit_camera = core::fit_camera_of(camera);
        auto_camera.fit_camera->direction = way->direction;
        auto_camera.fit_camera->up = way->up;
    }
    if (up) {
        core::Vec3f& of_camera = auto_camera.fit_camera ? auto_camera.fit_camera->up : camera.up;
        const core::Vec3f along = auto_camera.fit_camera ? auto_camera.fit_camera->direction
                                                         : core::fit_camera_of(camera).direction;
        of_camera = *up;
        require_upward(*up, along);
    }
    if (auto_camera.fit_camera) {
        auto_camera.fit_camera->zoom = zoom.value_or(auto_camera.fit_camera->zoom);
        if (projection) auto_camera.fit_camera->projection = *projection;
    } else {
        if (projection) project(camera, *projection);
        if (zoom) zoom_in(camera, *zoom);
    }
    return auto_camera;
}

core::View view_of(const core::Scene& scene) {
    const auto own = static_cast<std::ptrdiff_t>(scene.own_light_count());
    return {scene.camera(), scene.fog(), {scene.lights().begin() + own, scene.lights().end()}};
}

core::Scene seen(core::Scene scene, const ViewChange& change, const core::Settings& settings,
                 const std::optional<core::Frame>& frame) {
    core::Camera camera = scene.camera();
    const core::AutoCamera own = scene.auto_camera(),
                           auto_camera = change.auto_camera(scene, camera);
    const core::Fog fog = scene.fog();
    const bool is_staged = auto_camera.any() || own.any();
    try {
        scene = std::move(scene).seen(own, {camera, fog, {}});
        if (!is_staged) return scene;
        const core::View view = frame && auto_camera.fit_camera
                                    ? core::staged(scene, auto_camera, *frame)
                                    : core::staged(scene, auto_camera, settings);
        return std::move(scene).seen(auto_camera, view);
    } catch (const core::InvalidValue& invalid) {
        throw BadInput(change.way ? "--view" : "camera", "", invalid.expectation);
    }
}

Values<core::NamedView> views() {
    return {"WAY", "", [](const std::string& option, const std::string& text) {
                return view_named(option, text);
            }};
}

Values<core::Camera> cameras() {
    return {"JSON", "", [](const std::string& option, const std::string& text) {
                const std::size_t first = text.find_first_not_of(" \t");
                std::string json =
                    first != std::string::npos && text[first] == '{' ? "\"camera\": " + text : text;
                json.resize(json.find_last_not_of(" \t,") + 1);
                // The reader of scenes names the place of a mistake.
                return parse_scene(option, "{" + json + ", \"objects\": []}").camera();
            }};
}

Values<Background> backgrounds() {
    return {"COLOR", "", [](const std::string& option, const std::string& text) -> Background {
                if (text == "none") return {};
                return {named_color_of(option, text, "none or ")};
            }};
}

Values<core::Vec3f> upward_directions() {
    return {"WAY", "", upward_direction};
}

Values<std::string> drawing_words(std::string type, std::string range) {
    return {std::move(type), std::move(range),
            [](const std::string& option, const std::string& text) {
                Drawing unused;
                set_option(unused, option, text);
                return text;
            }};
}

DrawingOptions DrawingArguments::given() const {
    DrawingOptions given;
    for (const AnyOption* option : options())
        for (const std::string& text : option->texts())
            given.emplace_back(option->name(), option->properties().type.empty() ? "on" : text);
    return given;
}

LoadOptions SceneArguments::load_options() const {
    LoadOptions options;
    options.set_drawing(drawing.given());
    options.drawing.view = view.view.value();
    options.drawing.perspective = view.perspective.is_given();
    if (view.background && view.background->color) {
        options.drawing.background = *view.background->color;
        if (options.option_for_atoms.empty()) options.option_for_atoms = view.background.name();
    }
    if (options.option_for_atoms.empty() && view.view && view.view->name.size() == 1 &&
        view.view->direction == core::Vec3f(0.0F)) // an edge of a cell
        options.option_for_atoms = view.view.name();
    if (frame && frame->frames) {
        options.frames = *frame->frames;
        if (options.option_for_atoms.empty()) options.option_for_atoms = frame->frames.name();
    }
    if (drawing.slab && view.camera) throw BadInput("--slab", "", "goes without --camera");
    options.parameters = parameters.values().front();
    return options;
}

Values<FrameRange> frame_ranges() {
    return {"WHICH", "", frame_range_of};
}

Values<Turn> turns() {
    return {"DEGREES/IMAGES", "", [](const std::string& option, const std::string& text) {
                const std::vector<std::string_view> parts = parts_of(text, '/');
                const std::optional<float> degrees = to_float(parts[0]);
                const int count = parts.size() == 2 ? to_int(parts[1]).value_or(0) : 0;
                if (!degrees || count < 1 || count > max_images)
                    refuse(option, "DEGREES/IMAGES, such as 360/120", text);
                return Turn{static_cast<double>(*degrees), static_cast<std::size_t>(count)};
            }};
}

Values<ParameterSweep> parameter_values(bool sweeps) {
    return {"NAME=VALUE", "", [=](const std::string& option, const std::string& text) {
                const std::optional<ParameterSweep> sweep = parameter_sweep_of(text);
                if (!sweep)
                    refuse(option, "NAME=NUMBER, or NAME=FIRST:LAST:COUNT for a sequence", text);
                if (sweep->values.size() > 1 && !sweeps)
                    refuse(option, "NAME=NUMBER for this command", text);
                return *sweep;
            }};
}

ParameterArguments::ParameterArguments(OptionTable& parent, bool sweeps)
    : OptionTable(parent, group_of_several),
      set(*this, "--set", parameter_values(sweeps).recorded(),
          sweeps ? "Value of \"$NAME\" in a JSON scene: a number, or FIRST:LAST:COUNT for "
                   "a sequence of COUNT images. Several of these advance together."
                 : "Value of \"$NAME\" in a JSON scene, a number.") {}

std::vector<std::map<std::string, double>> ParameterArguments::values() const {
    std::vector<std::map<std::string, double>> images(1);
    for (const ParameterSweep& sweep : *set) {
        if (images.front().contains(sweep.name))
            throw BadInput("--set", "", "must set \"" + printable(sweep.name) + "\" only once");
        const std::size_t count = sweep.values.size();
        if (count > 1 && images.size() > 1 && count != images.size())
            throw BadInput("--set", "",
                           "must have the same number of values in all sweeps, got " +
                               std::to_string(images.size()) + " and " + std::to_string(count));
        if (count > 1) images.resize(count, images.front());
        for (std::size_t i = 0; i < images.size(); ++i)
            images[i][sweep.name] = sweep.values[count == 1 ? 0 : i];
    }
    return images;
}

bool ParameterArguments::has_sweep() const {
    return std::any_of((*set).begin(), (*set).end(),
                       [](const ParameterSweep& sweep) { return sweep.is_sweep; });
}

} // namespace raylane::scenes
