#include "values.hpp"

namespace raylane::c {

namespace {

/// Converts enumerators, which have the same numbers on both sides. The library rejects invalid
/// ones.
template <class Enum>
Enum enum_from(std::uint8_t number) {
    return static_cast<Enum>(number);
}
template <class Enum>
std::uint8_t number_of(Enum value) {
    return static_cast<std::uint8_t>(value);
}

} // namespace

Material from_c(const raylane_material& m) {
    Material material;
    material.pattern.kind = enum_from<PatternKind>(m.pattern.kind);
    for (int i = 0; i < 2; ++i)
        material.pattern.colors[i] = from_c(m.pattern.colors[i]);
    material.pattern.size = m.pattern.size;
    material.pattern.axes = m.pattern.axes;
    material.pattern.direction = from_c(m.pattern.direction);
    material.pattern.from = from_c(m.pattern.from);
    material.pattern.to = from_c(m.pattern.to);
    material.ambient = m.ambient;
    material.diffuse = m.diffuse;
    material.specular = m.specular;
    material.exponent = m.exponent;
    material.reflection = enum_from<Reflection>(m.reflection);
    material.reflectivity = m.reflectivity;
    material.transmission = m.transmission;
    material.index = m.index;
    material.absorption = from_c(m.absorption);
    material.visible = enum_from<Visible>(m.visible);
    material.opacity = m.opacity;
    return material;
}

Light from_c(const raylane_light& light) {
    return {enum_from<LightKind>(light.kind),
            from_c(light.position),
            from_c(light.direction),
            from_c(light.color),
            light.radius,
            from_c(light.edge_u),
            from_c(light.edge_v),
            from_c(light.ground),
            light.reach};
}

Fog from_c(const raylane_fog& fog) {
    return {enum_from<FogKind>(fog.kind), from_c(fog.color), fog.start, fog.end, fog.density};
}

Camera from_c(const raylane_camera& camera) {
    return {enum_from<Projection>(camera.projection),
            from_c(camera.from),
            from_c(camera.at),
            from_c(camera.up),
            camera.field_of_view,
            camera.height,
            camera.lens_radius,
            camera.focus_distance};
}

Settings from_c(const raylane_settings& s) {
    Settings settings;
    settings.width = s.width;
    settings.height = s.height;
    settings.grid = s.grid;
    settings.samples = enum_from<SamplePattern>(s.samples);
    settings.transfer = enum_from<Transfer>(s.transfer);
    settings.max_depth = s.max_depth;
    settings.max_see_through = s.max_see_through;
    settings.min_weight = s.min_weight;
    settings.quality = s.quality;
    settings.filter = enum_from<PixelFilter>(s.filter);
    settings.light_samples = s.light_samples;
    settings.outline = {s.outline.width, from_c(s.outline.color), s.outline.creases};
    return settings;
}

raylane_settings to_c(const Settings& s) {
    return {s.width,
            s.height,
            s.grid,
            number_of(s.samples),
            number_of(s.transfer),
            s.max_depth,
            s.min_weight,
            s.quality,
            number_of(s.filter),
            s.light_samples,
            s.max_see_through,
            {s.outline.width, to_c(s.outline.color), s.outline.creases}};
}

} // namespace raylane::c

using namespace raylane;
using namespace raylane::c;

raylane_material raylane_default_material(void) {
    const Material m;
    return {{number_of(m.pattern.kind),
             {to_c(m.pattern.colors[0]), to_c(m.pattern.colors[1])},
             m.pattern.size,
             m.pattern.axes,
             to_c(m.pattern.direction),
             to_c(m.pattern.from),
             to_c(m.pattern.to)},
            m.ambient,
            m.diffuse,
            m.specular,
            m.exponent,
            number_of(m.reflection),
            m.reflectivity,
            m.transmission,
            m.index,
            to_c(m.absorption),
            number_of(m.visible),
            m.opacity};
}

raylane_light raylane_default_light(void) {
    const Light light;
    return {number_of(light.kind), to_c(light.position), to_c(light.direction),
            to_c(light.color),     light.radius,         to_c(light.edge_u),
            to_c(light.edge_v),    to_c(light.ground),   light.reach};
}

raylane_fog raylane_default_fog(void) {
    const Fog fog;
    return {number_of(fog.kind), to_c(fog.color), fog.start, fog.end, fog.density};
}

raylane_camera raylane_default_camera(void) {
    const Camera camera;
    return {
        number_of(camera.projection), to_c(camera.from), to_c(camera.at),    to_c(camera.up),
        camera.field_of_view,         camera.height,     camera.lens_radius, camera.focus_distance};
}

raylane_settings raylane_default_settings(void) {
    return to_c(Settings{});
}
