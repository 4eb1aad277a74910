#include "scenes/json/surroundings.hpp"

#include <cmath>

namespace raylane::scenes {

using core::FogKind;
using core::LightKind;
using core::Projection;

namespace {

/// Reads a view: its name, or the direction in which the camera looks.
void read_view(const JsonValue& value, core::Framing& framing) {
    if (value.type() == JsonType::array) {
        framing.direction = value.vector();
        if (framing.direction == core::Vec3f(0.0F))
            value.fail("must be a direction other than [0, 0, 0]");
        framing.up = core::upright(framing.direction);
        return;
    }
    std::vector<std::pair<std::string_view, const core::NamedView*>> choices;
    for (const core::NamedView& view : core::named_views())
        choices.emplace_back(view.name, &view);
    const auto* view = value.choice(JsonValue::Choices<const core::NamedView*>(choices));
    framing.direction = view->direction;
    framing.up = view->up;
}

float number_between(const JsonValue& value, float least, float most, const char* expected) {
    const float number = value.number();
    if (!(number >= least && number <= most)) value.fail_expecting(expected);
    return number;
}

core::Framing read_framing(const JsonValue& value) {
    value.allow_only({"type", "view", "up", "zoom", "orthographic", "field_of_view", "depth_cue"});
    value.exclude("orthographic", "field_of_view");
    core::Framing framing;
    if (const auto view = value.find("view")) read_view(*view, framing);
    if (const auto up = value.find("up")) {
        framing.up = up->vector();
        const auto across = core::cross(core::convert<double>(framing.up),
                                        core::convert<double>(framing.direction));
        if (across == core::Vec3d(0.0))
            up->fail("must not be 0 or parallel to the direction of view");
    }
    if (const auto zoom = value.find("zoom"))
        framing.zoom = number_between(*zoom, 0.01F, 1000.0F, "from 0.01 to 1000");
    if (const auto orthographic = value.find("orthographic"))
        framing.projection =
            orthographic->boolean() ? Projection::orthographic : Projection::perspective;
    if (const auto angle = value.find("field_of_view"))
        framing.field_of_view = number_between(*angle, 0.01F, 179.0F, "from 0.01 to 179");
    return framing;
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

void read_image(const JsonValue& value, core::Settings& settings) {
    value.allow_only({"width", "height", "transfer", "alpha"});
    if (const auto width = value.find("width")) settings.width = width->integer();
    if (const auto height = value.find("height")) settings.height = height->integer();
    if (const auto transfer = value.find("transfer"))
        settings.transfer = transfer->choice<core::Transfer>(
            {{"srgb", core::Transfer::srgb}, {"linear", core::Transfer::linear}});
    if (const auto alpha = value.find("alpha")) settings.alpha = alpha->boolean();
}

void read_sampling(const JsonValue& value, core::Settings& settings) {
    value.allow_only({"grid", "pattern", "quality", "filter", "light_samples"});
    if (const auto filter = value.find("filter"))
        settings.filter = filter->choice<core::PixelFilter>(
            {{"box", core::PixelFilter::box},
             {"gaussian", core::PixelFilter::gaussian},
             {"blackman-harris", core::PixelFilter::blackman_harris}});
    if (const auto quality = value.find("quality")) settings.quality = quality->number();
    if (const auto samples = value.find("light_samples"))
        settings.light_samples = samples->integer();
    if (const auto grid = value.find("grid")) settings.grid = grid->integer();
    if (const auto pattern = value.find("pattern"))
        settings.samples =
            pattern->choice<core::SamplePattern>({{"regular", core::SamplePattern::regular},
                                                  {"stratified", core::SamplePattern::stratified}});
}

void read_limits(const JsonValue& value, core::Settings& settings) {
    value.allow_only({"max_depth", "min_weight", "max_see_through"});
    if (const auto depth = value.find("max_depth")) settings.max_depth = depth->integer();
    if (const auto weight = value.find("min_weight")) settings.min_weight = weight->number();
    if (const auto most = value.find("max_see_through")) settings.max_see_through = most->integer();
}

core::Outline read_outline(const JsonValue& value) {
    value.allow_only({"width", "color", "creases"});
    core::Outline outline;
    outline.width = value.at("width").number();
    if (const auto color = value.find("color")) outline.color = color->color();
    if (const auto creases = value.find("creases")) outline.creases = creases->number();
    return outline;
}

core::Camera read_camera(const JsonValue& value, core::Staging& staging) {
    core::Camera camera;
    if (value.type() == JsonType::string) {
        staging.framing = value.choice<core::Framing>({{"auto", {}}});
        return camera;
    }
    std::optional<Projection> projection = Projection::perspective;
    if (const auto type = value.find("type"))
        projection =
            type->choice<std::optional<Projection>>({{"perspective", Projection::perspective},
                                                     {"orthographic", Projection::orthographic},
                                                     {"auto", std::nullopt}});
    if (!projection) {
        staging.framing = read_framing(value);
        if (const auto cue = value.find("depth_cue"))
            staging.depth_cue = number_between(*cue, 0.0F, 0.99F, "from 0 to 0.99");
        return camera;
    }
    camera.projection = *projection;
    if (camera.projection == Projection::perspective) {
        value.allow_only(
            {"type", "from", "at", "up", "field_of_view", "lens_radius", "focus_distance"});
        if (const auto angle = value.find("field_of_view")) camera.field_of_view = angle->number();
    } else {
        value.allow_only({"type", "from", "at", "up", "height", "lens_radius", "focus_distance"});
        camera.height = value.at("height").number();
    }
    camera.from = value.at("from").vector();
    camera.at = value.at("at").vector();
    if (const auto up = value.find("up")) camera.up = up->vector();
    if (const auto radius = value.find("lens_radius")) camera.lens_radius = radius->number();
    if (const auto focus = value.find("focus_distance")) camera.focus_distance = focus->number();
    return camera;
}

core::Fog read_fog(const JsonValue& value) {
    core::Fog fog;
    fog.kind = value.at("type").choice<FogKind>({{"linear-z", FogKind::linear_z},
                                                 {"linear", FogKind::linear},
                                                 {"exponential", FogKind::exponential}});
    if (fog.kind == FogKind::exponential) {
        value.allow_only({"type", "color", "density"});
        fog.density = value.at("density").number();
    } else {
        value.allow_only({"type", "color", "start", "end"});
        fog.start = value.at("start").number();
        fog.end = value.at("end").number();
    }
    if (const auto color = value.find("color")) fog.color = color->color();
    return fog;
}

std::optional<core::Light> read_light(const JsonValue& value) {
    const auto kind =
        value.at("type").choice<std::optional<LightKind>>({{"point", LightKind::point},
                                                           {"directional", LightKind::directional},
                                                           {"sky", LightKind::sky},
                                                           {"sphere", LightKind::sphere},
                                                           {"disc", LightKind::disc},
                                                           {"rectangle", LightKind::rectangle},
                                                           {"camera", std::nullopt}});
    if (!kind) {
        value.allow_only({"type"});
        return std::nullopt;
    }
    core::Light light{.kind = *kind};
    if (const auto color = value.find("color")) light.color = color->color();
    switch (light.kind) {
    case LightKind::point:
        value.allow_only({"type", "position", "color"});
        light.position = value.at("position").vector();
        break;
    case LightKind::directional:
        value.allow_only({"type", "direction", "color"});
        light.direction = value.at("direction").vector();
        break;
    case LightKind::sky: {
        value.allow_only({"type", "direction", "color", "ground", "reach"});
        if (const auto direction = value.find("direction")) light.direction = direction->vector();
        const auto ground = value.find("ground");
        light.ground = ground ? ground->color() : light.color;
        if (const auto reach = value.find("reach")) light.reach = reach->number();
        break;
    }
    case LightKind::sphere:
        value.allow_only({"type", "position", "radius", "color"});
        light.position = value.at("position").vector();
        light.radius = value.at("radius").number();
        break;
    case LightKind::disc:
        value.allow_only({"type", "position", "direction", "radius", "color"});
        light.position = value.at("position").vector();
        light.direction = value.at("direction").vector();
        light.radius = value.at("radius").number();
        break;
    case LightKind::rectangle:
        value.allow_only({"type", "position", "edge_u", "edge_v", "color"});
        light.position = value.at("position").vector();
        light.edge_u = value.at("edge_u").vector();
        light.edge_v = value.at("edge_v").vector();
        break;
    }
    return light;
}

} // namespace raylane::scenes
