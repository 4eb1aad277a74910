#include "scenes/formats/json/surroundings.hpp"

#include "core/scene/validate.hpp"
#include "scenes/formats/json/fields.hpp"

#include <cmath>

namespace raylane::scenes {

using core::Projection;

namespace {

/// Reads a view: its name, or the direction in which the camera looks.
void read_view(const JsonValue& value, core::FitCamera& fit_camera) {
    if (value.type() == JsonType::array) {
        fit_camera.direction = value.vector();
        fit_camera.up = core::upright(fit_camera.direction);
        return;
    }
    std::vector<std::pair<std::string_view, const core::NamedView*>> choices;
    for (const core::NamedView& view : core::named_views())
        choices.emplace_back(view.name, &view);
    const auto* view = value.choice(JsonValue::Choices<const core::NamedView*>(choices));
    fit_camera.direction = view->direction;
    fit_camera.up = view->up;
}

core::AutoCamera read_auto_camera(const JsonValue& value) {
    value.allow_only({"type", "view", "up", "zoom", "orthographic", "field_of_view", "depth_cue"});
    value.exclude("orthographic", "field_of_view");
    core::FitCamera fit_camera;
    if (const auto view = value.find("view")) read_view(*view, fit_camera);
    if (const auto up = value.find("up")) fit_camera.up = up->vector();
    if (const auto zoom = value.find("zoom")) fit_camera.zoom = zoom->number();
    if (const auto orthographic = value.find("orthographic"))
        fit_camera.projection =
            orthographic->boolean() ? Projection::orthographic : Projection::perspective;
    if (const auto angle = value.find("field_of_view")) fit_camera.field_of_view = angle->number();
    core::AutoCamera auto_camera{.fit_camera = fit_camera};
    if (const auto cue = value.find("depth_cue")) auto_camera.depth_cue = cue->number();
    try {
        core::validate(auto_camera);
    } catch (const core::InvalidValue& invalid) {
        constexpr std::string_view view = "direction";
        if (!invalid.field.starts_with(view)) value.fail(invalid);
        value.fail({"view" + invalid.field.substr(view.size()), invalid.expectation});
    }
    return auto_camera;
}

} // namespace

void read_parameter(std::string_view name, const JsonValue& value, Parameters& parameters) {
    if (!is_parameter_name(name)) {
        InputError wrong = value.error("must be named by letters, digits and underscores");
        wrong.position = value.positions().key;
        throw BadInput({wrong});
    }
    parameters.forget_wrong(name);
    try {
        const double number = value.real();
        if (!(std::abs(number) <= 1e30)) value.fail_expecting("a number from -1e30 to 1e30");
        parameters.add_default(name, number);
    } catch (const BadInput&) {
        parameters.add_wrong(name);
        throw;
    }
}

core::Outline read_outline(const JsonValue& value) {
    core::Outline outline;
    read_only_fields(value, outline);
    return outline;
}

core::Camera read_camera(const JsonValue& value, core::AutoCamera& auto_camera) {
    core::Camera camera;
    if (value.type() == JsonType::string) {
        auto_camera.fit_camera = value.choice<core::FitCamera>({{"auto", {}}});
        return camera;
    }
    if (const auto type = value.find("type")) {
        const std::size_t kind = read_word(*type, core::fields::projection, "auto");
        if (kind == std::size(core::fields::projection_words)) {
            const bool lights = auto_camera.lights;
            auto_camera = read_auto_camera(value);
            auto_camera.lights = lights;
            return camera;
        }
        camera.projection = static_cast<Projection>(kind);
    }
    read_only_fields(value, camera);
    return camera;
}

core::Fog read_fog(const JsonValue& value) {
    core::Fog fog{
        .kind = static_cast<core::FogKind>(read_word(value.at("type"), core::fields::fog_kind))};
    read_only_fields(value, fog);
    return fog;
}

std::optional<core::Light> read_light(const JsonValue& value) {
    const std::size_t kind = read_word(value.at("type"), core::fields::light_kind, "camera");
    if (kind == std::size(core::fields::light_words)) {
        value.allow_only({"type"});
        return std::nullopt;
    }
    core::Light light{.kind = static_cast<core::LightKind>(kind)};
    read_only_fields(value, light);
    if (light.kind == core::LightKind::sky && !value.find("ground")) light.ground = light.color;
    return light;
}

} // namespace raylane::scenes
