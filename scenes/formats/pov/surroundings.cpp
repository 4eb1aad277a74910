#include "scenes/formats/pov/surroundings.hpp"

#include "core/scene/field_of_view.hpp"
#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/finishes.hpp"
#include "scenes/formats/pov/objects.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::scenes::pov {

namespace {

using core::Vec3d, core::Vec3f;

Vec3d rgb_of(const Tuple& tuple) {
    return {tuple.at[0], tuple.at[1], tuple.at[2]};
}

bool is_projection(const Token& word) {
    static constexpr std::string_view others[] = {"fisheye",    "ultra_wide_angle", "omnimax",
                                                  "panoramic",  "spherical",        "cylinder",
                                                  "mesh_camera"};
    return std::find(std::begin(others), std::end(others), word.text) != std::end(others);
}

} // namespace

Camera read_camera(Tokens& tokens) {
    Camera camera;
    Place angle_place = tokens.peek().place;
    bool is_wide = false; // the projection's angles have other bounds
    tokens.expect("{");
    while (!tokens.accept("}")) {
        if (const auto known = tokens.accept_value<Camera>()) {
            camera = *known;
            continue;
        }
        if (const auto motion = read_motion(tokens)) {
            camera.motion = both(camera.motion, motion);
            continue;
        }
        const Token word = tokens.next();
        if (word.is("location")) {
            camera.location = read_vector(tokens);
        } else if (word.is("direction")) {
            camera.direction = read_vector(tokens);
        } else if (word.is("right") || word.is("up")) {
            (word.is("up") ? camera.up : camera.right) = read_vector(tokens);
            camera.has_size = true;
        } else if (word.is("sky")) {
            camera.sky = read_vector(tokens);
        } else if (word.is("look_at")) {
            camera.look_at = read_vector(tokens);
        } else if (word.is("angle")) {
            camera.angle = read_number(tokens);
            angle_place = word.place;
            if (tokens.accept(",") || (is_wide && at_tuple(tokens))) read_number(tokens);
        } else if (word.is("orthographic") || word.is("perspective")) {
            camera.orthographic = word.is("orthographic");
        } else if (is_projection(word)) {
            if (word.is("cylinder")) read_number(tokens);
            if (word.is("mesh_camera")) tokens.skip_braces();
            is_wide = true;
            tokens.remark(word.place, "camera type " + word.quoted() +
                                          " is not supported: the image is in perspective");
        } else if (word.is("aperture") || word.is("blur_samples") || word.is("confidence") ||
                   word.is("variance") || word.is("focal_point") || word.is("bokeh")) {
            if (word.is("bokeh"))
                tokens.skip_braces();
            else
                read_tuple(tokens);
            tokens.accept(",");
            if (at_tuple(tokens)) read_tuple(tokens);
            tokens.remark(word.place, "depth of field is ignored: the image is sharp everywhere");
        } else if (word.is("normal")) {
            tokens.skip_braces();
            tokens.remark(word.place, "normal of the camera is ignored: its rays stay straight");
        } else {
            fail(word.place, "must be of a camera, got " + word.quoted());
        }
    }
    if (camera.angle && !(*camera.angle > 0.0 && *camera.angle < 180.0)) {
        // POV-Ray ignores an angle of 0, which ASE writes.
        if (!is_wide && *camera.angle != 0.0)
            fail(angle_place, "must be an angle between 0 and 180 degrees");
        camera.angle.reset();
    }
    return camera;
}

View view_of(const Camera& given, Tokens& tokens, const Place& place) {
    Vec3d direction = given.direction, right = given.right, up = given.up;
    double focus = core::length(direction);
    const double width = core::length(right), height = core::length(up);
    const bool is_left = core::dot(core::cross(direction, up), right) < 0.0;
    Vec3d location = given.location;
    Vec3d sky = given.look_at ? given.sky : up;
    View view;
    if (given.look_at) {
        direction = *given.look_at - location;
        if (direction == Vec3d(0.0)) fail(place, "must look at a point other than its location");
        const Vec3d sight = core::normalized(direction);
        Vec3d aside = core::cross(given.sky, sight);
        if (core::length(aside) < 1e-10) aside = right; // POV-Ray's bound
        aside = core::normalized(aside);
        right = (is_left ? width : -width) * aside;
        up = height * core::cross(sight, aside);
        // In floats, a sky close to the line of sight would turn the image.
        constexpr double oblique = 0x1p-10;
        if (!(core::length(core::cross(core::normalized(given.sky), sight)) > oblique)) sky = up;
    }
    if (given.angle) focus = 0.5 * width / core::slope_of_view(*given.angle);
    double size = 1.0; // of an orthographic image, relative to right and up
    if (given.look_at && (!given.has_size || given.angle)) size = core::length(direction) / focus;
    Vec3d at = location + direction;
    // These points must differ as floats.
    if (!given.look_at)
        at = location + std::max(1.0, core::length(location)) * core::normalized(direction);
    if (given.motion != nullptr) {
        location = given.motion->point(location);
        at = given.motion->point(at);
        sky = given.motion->direction(sky);
        right = given.motion->direction(right);
        up = given.motion->direction(up);
        direction = given.motion->direction(direction);
    }
    for (const Vec3d& axis : {direction, right, up})
        if (!(core::length(axis) > 0.0 && std::isfinite(core::length(axis))))
            fail(place,
                 "must have a right, an up and a direction that are not 0 or along each other");
    const auto is_across = [](const Vec3d& a, const Vec3d& b) {
        return std::abs(core::dot(a, b)) <= 1e-6 * core::length(a) * core::length(b);
    };
    if (!is_across(direction, right) || !is_across(direction, up) || !is_across(right, up))
        tokens.remark(place, "oblique axes of a camera are not supported: right angles are used");
    view.mirrored = core::dot(core::cross(direction, up), right) < 0.0;
    view.aspect = core::length(right) / core::length(up);
    core::Camera& camera = view.camera;
    camera.projection =
        given.orthographic ? core::Projection::orthographic : core::Projection::perspective;
    const auto seen = [&](Vec3d v) {
        if (view.mirrored) v.z = 0.0 - v.z;
        return core::convert<float>(v);
    };
    camera.from = seen(location);
    camera.at = seen(at);
    camera.up = seen(sky);
    if (given.orthographic)
        camera.height = static_cast<float>(core::length(up) * size);
    else
        camera.field_of_view = core::field_of_view(0.5 * core::length(up) / focus);
    return view;
}

LightSource read_light(Tokens& tokens) {
    LightSource light;
    tokens.expect("{");
    light.place = tokens.peek().place;
    if (const auto known = tokens.accept_value<Object>()) {
        if (known->light == nullptr) fail(light.place, "must be a light, got another object");
        light = known->light->moved(known->motion);
    } else {
        light.position = read_vector(tokens);
        tokens.accept(",");
        if (at_tuple(tokens)) light.color = rgb_of(read_color(tokens));
    }
    Vec3d first(0.0);
    double fade_distance = 0.0, fade_power = 0.0;
    bool has_area = false, is_ball = false;
    while (!tokens.accept("}")) {
        if (const auto motion = read_motion(tokens)) {
            light = light.moved(motion);
            continue;
        }
        if (at_tuple(tokens)) {
            light.color = rgb_of(read_color(tokens));
            continue;
        }
        const Token word = tokens.next();
        const auto remark = [&](const std::string& what) { tokens.remark(word.place, what); };
        if (word.is("parallel")) {
            light.parallel = true;
        } else if (word.is("point_at")) {
            light.point_at = read_vector(tokens);
        } else if (word.is("spotlight") || word.is("cylinder")) {
            remark(std::string(word.text) + " is ignored: the light shines in all directions");
        } else if (word.is("shadowless")) {
            remark("shadowless is ignored: the lights cast shadows");
        } else if (word.is("area_light")) {
            has_area = true;
            first = read_vector(tokens);
            for (int i = 0; i < 3; ++i) {
                tokens.accept(",");
                read_tuple(tokens);
            }
        } else if (word.is("circular")) {
            is_ball = true;
        } else if (word.is("fade_distance")) {
            fade_distance = read_number(tokens);
        } else if (word.is("fade_power")) {
            fade_power = read_number(tokens);
        } else if (word.is("radius") || word.is("falloff") || word.is("tightness") ||
                   word.is("adaptive") || word.is("media_interaction") ||
                   word.is("area_illumination")) {
            if (at_tuple(tokens)) read_number(tokens);
        } else if (word.is("media_attenuation")) {
            light.is_dimmed = !at_tuple(tokens) || read_number(tokens) != 0.0;
        } else if (word.is("looks_like") || word.is("projected_through")) {
            tokens.skip_braces();
            remark(word.quoted() + " of a light is ignored");
        } else if (word.is("photons")) {
            tokens.skip_braces();
        } else if (!word.is("orient") && !word.is("jitter")) {
            fail(word.place, "must be of a light, got " + word.quoted());
        }
    }
    for (int channel = 0; channel < 3; ++channel) {
        if (light.color[channel] >= 0.0) continue;
        light.color[channel] = 0.0;
        tokens.remark(light.place, "negative components of lights are not supported: 0 is used");
    }
    const double radius = 0.5 * core::length(first);
    // POV-Ray's light fades by 2 / (1 + (d / fade_distance)^2), raylane's by (radius / d)^2.
    if (is_ball && fade_power == 2.0 && fade_distance > 0.0 && radius >= 64.0 * fade_distance) {
        light.radius = radius;
        const double share = fade_distance / radius;
        light.color = (2.0 * share * share) * light.color;
        return light;
    }
    if (has_area) tokens.remark(light.place, "area_light is ignored: shadows have sharp edges");
    if (fade_distance > 0.0 && fade_power > 0.0)
        tokens.remark(light.place, "fade_distance is ignored: lights do not fade");
    return light;
}

core::Light light_of(const LightSource& source) {
    core::Light light{.position = core::convert<float>(source.position),
                      .color = core::convert<float>(source.color)};
    if (source.parallel) {
        light.kind = core::LightKind::directional;
        light.direction = core::convert<float>(Vec3d(source.point_at - source.position));
    } else if (source.radius > 0.0) {
        light.kind = core::LightKind::sphere;
        light.radius = static_cast<float>(source.radius);
    }
    return light;
}

core::Fog read_fog(Tokens& tokens) {
    core::Fog fog;
    double distance = 0.0;
    bool is_ground = false; // omitted: everywhere, it would hide the rest
    tokens.expect("{");
    while (!tokens.accept("}")) {
        if (const auto known = tokens.accept_value<core::Fog>()) {
            fog = *known;
            continue;
        }
        if (read_motion(tokens) != nullptr) continue;
        if (at_tuple(tokens)) {
            const Tuple color = read_color(tokens);
            fog.color = core::convert<float>(rgb_of(color));
            if (color.at[3] != 0.0 || color.at[4] != 0.0)
                tokens.remark(tokens.peek().place,
                              "transparent fog is not supported: distant fog is opaque");
            continue;
        }
        const Token word = tokens.next();
        if (word.is("distance")) {
            distance = read_number(tokens);
        } else if (word.is("fog_type")) {
            is_ground = read_number(tokens) != 1.0;
            if (is_ground) tokens.remark(word.place, "ground fog is omitted");
        } else if (word.is("turbulence") || word.is("turb_depth") || word.is("omega") ||
                   word.is("lambda") || word.is("octaves") || word.is("fog_offset") ||
                   word.is("fog_alt") || word.is("up")) {
            read_tuple(tokens);
        } else {
            fail(word.place, "must be of fog, got " + word.quoted());
        }
    }
    if (distance > 0.0 && !is_ground) {
        fog.kind = core::FogKind::exponential;
        fog.density = static_cast<float>(1.0 / distance);
    }
    return fog;
}

Sky read_sky(Tokens& tokens) {
    Sky sky;
    tokens.expect("{");
    while (!tokens.accept("}")) {
        if (const auto known = tokens.accept_value<Sky>()) {
            sky = *known;
            continue;
        }
        if (read_motion(tokens) != nullptr) continue;
        const Token word = tokens.next();
        if (word.is("pigment")) {
            const Tuple color = color_of(read_pigment(tokens, {}));
            const double through = std::clamp(color.at[3] + color.at[4], 0.0, 1.0);
            for (std::size_t i = 0; i < 3; ++i)
                sky.color.at[i] = (1.0 - through) * color.at[i] + through * sky.color.at[i];
        } else if (word.is("emission")) {
            read_color(tokens);
        } else {
            fail(word.place, "must be of a sky_sphere, got " + word.quoted());
        }
    }
    return sky;
}

void read_global_settings(Tokens& tokens, GlobalSettings& settings) {
    tokens.expect("{");
    while (!tokens.accept("}")) {
        const Token word = tokens.next();
        if (word.is("assumed_gamma")) {
            tokens.assumed_gamma = tokens.accept("srgb") ? 0.0 : read_number(tokens);
        } else if (word.is("max_trace_level")) {
            settings.max_trace_level =
                static_cast<int>(std::clamp(read_number(tokens), 1.0, 256.0));
        } else if (word.is("adc_bailout")) {
            settings.adc_bailout = std::clamp(read_number(tokens), 0.0, 1.0);
        } else if (word.is("ambient_light")) {
            const Vec3d color = rgb_of(read_color(tokens));
            settings.ambient_light = (color.x + color.y + color.z) / 3.0;
            if (color.x != color.y || color.y != color.z)
                tokens.remark(word.place,
                              "coloured ambient_light is not supported: its mean is used");
        } else if (word.is("radiosity") || word.is("photons") || word.is("subsurface")) {
            tokens.skip_braces();
            tokens.remark(word.place, word.quoted() + " is ignored");
        } else if (word.is("charset")) {
            tokens.next();
        } else if (word.is("hf_gray_16") || word.is("irid_wavelength") ||
                   word.is("number_of_waves") || word.is("noise_generator") ||
                   word.is("max_intersections") || word.is("mm_per_unit")) {
            if (at_tuple(tokens)) read_color(tokens);
        } else {
            fail(word.place, "must be of global_settings, got " + word.quoted());
        }
    }
}

} // namespace raylane::scenes::pov
