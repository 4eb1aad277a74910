#include "core/scene/validate.hpp"

#include "core/shapes/checks.hpp"

namespace raylane::core {

using namespace checks;

namespace {

/// Checks a channel of a colour, also a light's, or a material's ambient, diffuse or specular. A
/// pixel is a sum of products of three of them. It stays finite: a float has room for 10^8 such
/// products.
void require_brightness(const Field& field, float value) {
    require(value >= 0.0F, field, "must not be negative", value);
    require(value <= 1e10F, field, "must be at most 1e10", value);
}

void validate(const Pattern& pattern) {
    require_enumerator("kind", pattern.kind, PatternKind::back_plane);
    validate_color("colors/0", pattern.colors[0]);
    validate_color("colors/1", pattern.colors[1]);
    require_positive("size", pattern.size);
    require_direction("direction", pattern.direction);
    require_point("from", pattern.from);
    require_point("to", pattern.to);
    if (pattern.kind == PatternKind::gradient && pattern.from == pattern.to)
        throw InvalidValue("to", "must differ from \"from\", got " + text_of(pattern.to));
    if ((pattern.axes & 7) == 0 || pattern.axes > 63)
        throw InvalidValue("axes", "must be one or more of x, y and z");
}

} // namespace

void validate_color(const char* field, const Color& color) {
    for (int channel = 0; channel < 3; ++channel)
        require_brightness(Field(field).at(channel), color[channel]);
}

void validate(const Material& material) {
    try {
        validate(material.pattern);
    } catch (const InvalidValue& invalid) {
        throw InvalidValue("pattern/" + invalid.field, invalid.expectation);
    }
    require_brightness("ambient", material.ambient);
    require_brightness("diffuse", material.diffuse);
    require_brightness("specular", material.specular);
    require_not_negative("exponent", material.exponent);
    require_enumerator("reflection", material.reflection, Reflection::dielectric);
    require_fraction("reflectivity", material.reflectivity);
    require_fraction("transmission", material.transmission);
    require_fraction("opacity", material.opacity);
    require_positive("index", material.index);
    if (material.glass.any() && !is_index(index_at(material.glass, line_d)))
        throw InvalidValue("glass", "must have an index of refraction for 587.56 nm");
    for (int channel = 0; channel < 3; ++channel)
        require_not_negative(Field("absorption").at(channel), material.absorption[channel]);
    require_enumerator("visible", material.visible, Visible::inside);
}

void validate(const Light& light) {
    require_enumerator("kind", light.kind, LightKind::rectangle);
    require_point("position", light.position);
    if (light.kind == LightKind::directional || light.kind == LightKind::sky ||
        light.kind == LightKind::disc)
        require_direction("direction", light.direction);
    validate_color("color", light.color);
    switch (light.kind) {
    case LightKind::point:
    case LightKind::directional:
        break;
    case LightKind::sky:
        validate_color("ground", light.ground);
        if (!(light.reach > 0.0F)) refuse("reach", "must be positive", light.reach);
        break;
    case LightKind::sphere:
    case LightKind::disc:
        require_positive("radius", light.radius);
        break;
    case LightKind::rectangle:
        require_direction("edge_u", light.edge_u);
        require_direction("edge_v", light.edge_v);
        // The edges are rounded separately.
        if (!(std::abs(dot(normalized(convert<double>(light.edge_u)),
                           normalized(convert<double>(light.edge_v)))) < 0x1p-20))
            throw InvalidValue("edge_v", "must be perpendicular to edge_u's " +
                                             text_of(light.edge_u) + ", got " +
                                             text_of(light.edge_v));
        break;
    }
}

void validate(const Fog& fog) {
    require_enumerator("kind", fog.kind, FogKind::exponential);
    if (fog.kind == FogKind::none) return;
    validate_color("color", fog.color);
    if (fog.kind == FogKind::exponential) {
        require_positive("density", fog.density);
        return;
    }
    require_coordinate("start", fog.start);
    require_coordinate("end", fog.end);
    if (fog.kind == FogKind::linear) {
        require_not_negative("start", fog.start);
        if (!(fog.end > fog.start))
            refuse("end", "must be more than start's " + text_of(fog.start), fog.end);
    }
    require(fog.end != fog.start, "end", "must differ from start", fog.end);
}

void validate(const Camera& camera) {
    require_enumerator("projection", camera.projection, Projection::orthographic);
    require_point("from", camera.from);
    require_point("at", camera.at);
    require_direction("up", camera.up);
    if (camera.from == camera.at)
        throw InvalidValue("at", "must differ from \"from\", got " + text_of(camera.at));
    // If `up` is this close to the line of sight, rounding of the inputs decides its direction
    // across.
    const Vec3d sight = normalized(convert<double>(camera.at) - convert<double>(camera.from));
    const Vec3d up = normalized(convert<double>(camera.up));
    if (!(length(cross(sight, up)) > 0x1p-22))
        throw InvalidValue("up", "must not be along the line of sight, got " + text_of(camera.up));
    if (camera.projection == Projection::perspective)
        require(camera.field_of_view > 0.0F && camera.field_of_view < 180.0F, "field_of_view",
                "must be between 0 and 180 degrees, both excluded", camera.field_of_view);
    else
        require_positive("height", camera.height);
    require_not_negative("lens_radius", camera.lens_radius);
    require_not_negative("focus_distance", camera.focus_distance);
}

void validate(const Outline& outline) {
    require(outline.width >= 0.0F && outline.width <= Outline::max_width, "width",
            "must be between 0 and 32 pixels", outline.width);
    require(outline.creases >= 0.0F && outline.creases <= 180.0F, "creases",
            "must be between 0 and 180 degrees", outline.creases);
    validate_color("color", outline.color);
}

void validate(const Settings& settings) {
    require_count("width", settings.width, 1, Settings::max_size);
    require_count("height", settings.height, 1, Settings::max_size);
    if (std::int64_t{settings.width} * settings.height > Settings::max_pixels)
        throw InvalidValue("width", "must make at most " + std::to_string(Settings::max_pixels) +
                                        " pixels, got " + std::to_string(settings.width) + " x " +
                                        std::to_string(settings.height));
    require_count("grid", settings.grid, 1, Settings::max_grid);
    require_enumerator("samples", settings.samples, SamplePattern::stratified);
    require_enumerator("filter", settings.filter, PixelFilter::blackman_harris);
    if (settings.quality != 0.0F && !(settings.quality >= 10.0F && settings.quality <= 80.0F))
        refuse("quality", "must be 0 or between 10 and 80 decibels", settings.quality);
    require_count("light_samples", settings.light_samples, Settings::hard_light,
                  Settings::max_light_samples);
    require_enumerator("transfer", settings.transfer, Transfer::linear);
    require_count("max_depth", settings.max_depth, 0, Settings::depth_limit);
    require_count("max_see_through", settings.max_see_through, 1, Settings::see_through_limit);
    require_fraction("min_weight", settings.min_weight);
    try {
        validate(settings.outline);
    } catch (const InvalidValue& invalid) {
        throw InvalidValue("outline/" + invalid.field, invalid.expectation);
    }
}

} // namespace raylane::core
