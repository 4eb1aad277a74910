#include "scenes/formats/tachyon/surroundings.hpp"

#include "core/scene/field_of_view.hpp"
#include "core/scene/validate.hpp"
#include "scenes/files/number.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

using core::InvalidValue;

void read_projection(TachyonWords& words, TachyonCamera& camera) {
    if (words.accept("ORTHOGRAPHIC")) {
        camera.projection = core::Projection::orthographic;
    } else if (words.accept("PERSPECTIVE_DOF")) {
        words.named_number("FOCALLENGTH");
        camera.aperture = words.named_number("APERTURE");
    } else if (words.accept("FISHEYE")) {
        words.remark("FISHEYE is not supported: the image is in perspective");
    } else if (!words.accept("PERSPECTIVE")) {
        words.refuse_next("PERSPECTIVE, PERSPECTIVE_DOF, ORTHOGRAPHIC or FISHEYE");
    }
}

void read_frustum(TachyonWords& words, TachyonCamera& camera) {
    const float left = words.number("FRUSTUM"), right = words.number("FRUSTUM");
    camera.bottom = words.number("FRUSTUM");
    camera.top = words.number("FRUSTUM");
    camera.has_frustum = true;
    if (left != -right || camera.bottom != -camera.top)
        words.remark("an off-centre FRUSTUM is not supported: the image is centred");
}

void scale(core::Light& light, TachyonWords& words) {
    if (!words.accept("ATTENUATION")) return;
    const float constant = words.named_number("CONSTANT");
    const float linear = words.named_number("LINEAR");
    const float quadratic = words.named_number("QUADRATIC");
    if (linear != 0.0F || quadratic != 0.0F)
        words.remark("ATTENUATION is ignored: lights do not fade with distance");
    if (constant > 0.0F) light.color = core::Color(1.0F / constant);
}

core::Vec3d middle_of(const core::Vec3d& a, const core::Vec3d& b) {
    return 0.5 * (a + b);
}

} // namespace

TachyonCamera read_camera(TachyonWords& words) {
    TachyonCamera camera;
    if (words.accept("PROJECTION")) read_projection(words, camera);
    camera.zoom = words.named_number("ZOOM");
    if (!(camera.zoom > 0.0F))
        throw InvalidValue("zoom", "must be positive, got " + to_text(camera.zoom));
    if (words.named_number("ASPECTRATIO") != 1.0F)
        words.remark("ASPECTRATIO is ignored: pixels are square");
    words.expect("ANTIALIASING");
    camera.antialiasing = words.whole_number("ANTIALIASING", 0, max_int);
    words.expect("RAYDEPTH");
    camera.ray_depth = words.whole_number("RAYDEPTH", 0, max_int);
    camera.center = words.named_vector("CENTER");
    camera.direction = words.named_vector("VIEWDIR");
    camera.up = words.named_vector("UPDIR");
    if (words.accept("FRUSTUM")) read_frustum(words, camera);
    words.expect("END_CAMERA");
    return camera;
}

std::optional<TachyonFog> read_fog(TachyonWords& words) {
    if (words.accept("OFF")) return {};
    TachyonFog fog;
    if (words.accept("EXP"))
        fog.falloff = TachyonFog::Falloff::exponential;
    else if (words.accept("EXP2"))
        fog.falloff = TachyonFog::Falloff::squared;
    else if (!words.accept("LINEAR"))
        words.refuse_next("LINEAR, EXP, EXP2 or OFF");
    bool has_color = false;
    while (!has_color) {
        if (words.accept("START"))
            fog.start = words.number("START");
        else if (words.accept("END"))
            fog.end = words.number("END");
        else if (words.accept("DENSITY"))
            fog.density = words.number("DENSITY");
        else
            has_color = true;
    }
    fog.color = words.named_triple("COLOR");
    return fog;
}

core::Light read_point_light(TachyonWords& words) {
    core::Light light{.position = words.named_vector("CENTER")};
    if (words.named_number("RAD") > 0.0F)
        words.remark("RAD is ignored: the sphere of a light is invisible");
    scale(light, words);
    light.color *= words.named_triple("COLOR");
    return light;
}

core::Light read_directional_light(TachyonWords& words) {
    core::Light light{.kind = core::LightKind::directional};
    light.direction = words.named_vector("DIRECTION");
    light.color = words.named_triple("COLOR");
    return light;
}

core::Light read_spotlight(TachyonWords& words) {
    core::Light light{.position = words.named_vector("CENTER")};
    words.named_number("RAD");
    words.named_vector("DIRECTION");
    words.named_number("FALLOFF_START");
    words.named_number("FALLOFF_END");
    scale(light, words);
    light.color *= words.named_triple("COLOR");
    words.remark("SPOTLIGHT is not supported: the light shines in all directions");
    return light;
}

core::Color read_background_gradient(TachyonWords& words) {
    if (!words.accept("SKY_SPHERE") && !words.accept("SKY_ORTHO_PLANE"))
        words.refuse_next("SKY_SPHERE or SKY_ORTHO_PLANE");
    words.named_vector("UPDIR");
    words.named_number("TOPVAL");
    words.named_number("BOTTOMVAL");
    const auto top = core::convert<double>(words.named_triple("TOPCOLOR"));
    const auto bottom = core::convert<double>(words.named_triple("BOTTOMCOLOR"));
    if (top != bottom)
        words.remark("BACKGROUND_GRADIENT is not supported: the colour of its middle is used");
    return core::convert<float>(middle_of(top, bottom));
}

/// Sets camera and settings. With zoom 1, the image shows 1 unit of length from its lower to its
/// upper edge, at distance 1 in perspective.
void set_camera(core::SceneBuilder& builder, const TachyonCamera& camera) {
    core::Camera& result = builder.camera;
    result.projection = camera.projection;
    result.from = camera.center;
    // The look-at point has float coordinates. At the camera's distance from the origin, it is near
    // enough for floats, and far enough to keep the direction precise.
    const auto from = core::convert<double>(camera.center);
    const auto direction = core::convert<double>(camera.direction);
    const double along = core::length(direction);
    const double far = std::max(along, core::length(from));
    result.at =
        core::convert<float>(along > 0.0 ? core::Vec3d(from + direction * (far / along)) : from);
    result.up = camera.up;
    const double height = camera.has_frustum
                              ? static_cast<double>(camera.top) - static_cast<double>(camera.bottom)
                              : 1.0 / static_cast<double>(camera.zoom);
    result.height = static_cast<float>(height);
    result.field_of_view = core::field_of_view(0.5 * height);
    if (camera.aperture > 0.0F) {
        result.lens_radius = 0.5F * camera.aperture;
        result.focus_distance = 1.0F; // as in 0.99, whatever FOCALLENGTH is
    }
    core::Settings& settings = builder.settings;
    settings.transfer = core::Transfer::linear; // its colours are the image file's codes
    settings.max_depth = std::clamp(camera.ray_depth - 1, 0, core::Settings::depth_limit);
    settings.grid = grid_of_samples(camera.antialiasing);
    core::validate(result);
}

/// Sets the fog. Squared fog, 1 - exp(-x^2), is approximated by the line through the points where
/// it is 1/4 and 3/4. Exponential fog begins at the camera.
void set_fog(core::SceneBuilder& builder, const TachyonFog& fog, const TachyonCamera& camera,
             bool planar, TachyonWords& words) {
    using Falloff = TachyonFog::Falloff;
    core::Fog& result = builder.fog;
    result.color = fog.color;
    if (planar && builder.background != fog.color)
        words.remark("FOG_VMD: the background has the colour of the fog");
    const bool is_by_depth = camera.projection == core::Projection::orthographic;
    if (fog.falloff == Falloff::exponential) {
        if (fog.start != 0.0F) words.remark("START of EXP fog is ignored: it begins at the camera");
        if (planar && !is_by_depth)
            words.remark("FOG_VMD is ignored: fog depends on distance, not on depth");
        result.kind = core::FogKind::exponential;
        result.density = fog.density;
        core::validate(result);
        return;
    }
    auto start = static_cast<double>(fog.start);
    auto end = static_cast<double>(fog.end);
    if (fog.falloff == Falloff::squared) {
        words.remark("EXP2 fog is not supported: the nearest linear fog is used");
        constexpr double at_quarter = 0.53636, at_three_quarters = 1.17741;
        constexpr double slope = 0.5 / (at_three_quarters - at_quarter);
        constexpr double none = at_quarter - 0.25 / slope, all = none + 1.0 / slope;
        if (!(fog.density > 0.0F))
            throw InvalidValue("density", "must be positive, got " + to_text(fog.density));
        end = start + all / static_cast<double>(fog.density);
        start += none / static_cast<double>(fog.density);
    }
    const bool along_z = camera.direction.x == 0.0F && camera.direction.y == 0.0F;
    if (planar && along_z) {
        const double way = camera.direction.z < 0.0F ? -1.0 : 1.0;
        const auto z = static_cast<double>(camera.center.z);
        result.kind = core::FogKind::linear_z;
        result.start = static_cast<float>(z + way * start);
        result.end = static_cast<float>(z + way * end);
    } else {
        if (planar && !is_by_depth)
            words.remark("FOG_VMD is ignored: fog depends on distance, not on depth");
        result.kind = core::FogKind::linear;
        result.start = static_cast<float>(std::max(start, 0.0));
        result.end = static_cast<float>(end);
    }
    core::validate(result);
}

} // namespace raylane::scenes
