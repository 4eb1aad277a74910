#include "scenes/formats/pov/materials.hpp"

#include "core/shapes/invalid_value.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::scenes::pov {

namespace {

using core::Vec3d;

core::Color color_of(const Tuple& tuple) {
    core::Color color;
    for (int channel = 0; channel < 3; ++channel)
        color[channel] =
            static_cast<float>(std::max(tuple.at[static_cast<std::size_t>(channel)], 0.0));
    return color;
}

bool takes_light(const Tuple& color) {
    return std::any_of(color.at.begin(), color.at.begin() + 3,
                       [](double channel) { return channel < 0.0; });
}

Vec3d column(const Motion& motion, int axis) {
    return {motion.rows[0][axis], motion.rows[1][axis], motion.rows[2][axis]};
}

/// Sets a checker. Returns false unless its cells are axis-parallel cubes at multiples of their
/// size.
bool set_checker(const Pigment& pigment, const Motion& motion, const core::PlaneOf<double>* plane,
                 core::Pattern& pattern) {
    constexpr double too_long = 1e5; // longer edges are not meant as cells
    pattern.kind = core::PatternKind::checker;
    pattern.axes = 0;
    double size = 0.0, parity = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d across = column(motion, axis);
        const double edge = across[axis], offset = motion.rows[axis][3];
        across[axis] = 0.0;
        if (across != Vec3d(0.0) || edge == 0.0) return false;
        const bool is_constant = plane != nullptr && plane->normal[(axis + 1) % 3] == 0.0 &&
                                 plane->normal[(axis + 2) % 3] == 0.0;
        if (is_constant || std::abs(edge) >= too_long) {
            // POV-Ray counts a point on a border as part of the cell above the border.
            constexpr double border = 1e-10;
            const double place = is_constant ? plane->point[axis] : 0.0;
            parity += std::floor((place - offset) / edge + border);
            continue;
        }
        if (size == 0.0) size = std::abs(edge);
        const double cells = offset / size;
        if (std::abs(edge) != size || cells != std::floor(cells)) return false;
        // POV-Ray counts an edge as part of the cell above it.
        const int bits = edge < 0.0 ? 1 | 8 : 1;
        pattern.axes = static_cast<std::uint8_t>(pattern.axes | bits << axis);
        parity += cells + (edge < 0.0 ? 1.0 : 0.0);
    }
    if (pattern.axes == 0) return false;
    pattern.size = static_cast<float>(size);
    pattern.colors = {color_of(pigment.color), color_of(pigment.other)};
    if (std::fmod(parity, 2.0) != 0.0) std::swap(pattern.colors[0], pattern.colors[1]);
    return true;
}

/// Sets a gradient or stripes. They start at the transformed origin. Their direction is transformed
/// by the inverse transpose of the map.
bool set_gradient(const Pigment& pigment, const Motion& motion, core::Pattern& pattern) {
    if (pigment.direction == Vec3d(0.0)) return false;
    const Vec3d x = column(motion, 0), y = column(motion, 1), z = column(motion, 2);
    const Vec3d unit = core::normalized(pigment.direction);
    const double det = core::dot(x, core::cross(y, z));
    if (det == 0.0) return false;
    const Vec3d slope =
        (unit.x * core::cross(y, z) + unit.y * core::cross(z, x) + unit.z * core::cross(x, y)) /
        det;
    const Vec3d run = slope / core::dot(slope, slope), from = column(motion, 3);
    pattern.colors = {color_of(pigment.color), color_of(pigment.other)};
    if (!pigment.in_steps) {
        pattern.kind = core::PatternKind::gradient;
        pattern.from = core::convert<float>(from);
        pattern.to = core::convert<float>(Vec3d(from + run));
        return pattern.from != pattern.to;
    }
    pattern.kind = core::PatternKind::stripes;
    pattern.direction = core::convert<float>(slope);
    pattern.size = static_cast<float>(0.5 * core::length(run));
    const double halves = 2.0 * core::dot(slope, from), whole = std::round(halves);
    if (std::abs(halves - whole) > 1e-6) return false;
    if (std::fmod(whole, 2.0) != 0.0) std::swap(pattern.colors[0], pattern.colors[1]);
    return true;
}

std::array<float, 24> key_of(const core::Material& m) {
    const core::Pattern& p = m.pattern;
    return {static_cast<float>(p.kind),
            p.colors[0].x,
            p.colors[0].y,
            p.colors[0].z,
            p.colors[1].x,
            p.colors[1].y,
            p.colors[1].z,
            p.size,
            static_cast<float>(p.axes),
            p.kind == core::PatternKind::stripes ? p.direction.x : p.from.x,
            p.kind == core::PatternKind::stripes ? p.direction.y : p.from.y,
            p.kind == core::PatternKind::stripes ? p.direction.z : p.from.z,
            p.to.x,
            p.to.y,
            p.to.z,
            m.ambient,
            m.diffuse,
            m.specular,
            m.exponent,
            static_cast<float>(m.reflection),
            m.reflectivity,
            m.transmission,
            m.index,
            m.opacity};
}

/// Sets the stronger of both highlights. Phong's highlight, by the reflected ray, with exponent n
/// is about Blinn's, by the halfway vector, with exponent 4 * n.
void set_highlight(const Finish& finish, core::Material& material, Tokens& tokens,
                   const Place& place) {
    if (finish.specular > 0.0 && finish.phong > 0.0)
        tokens.remark(place,
                      "two highlights in a finish are not supported: the stronger one is used");
    const bool is_phong = finish.phong > std::max(finish.specular, 0.0);
    material.specular =
        static_cast<float>(is_phong ? finish.phong : std::max(finish.specular, 0.0));
    material.exponent = material.specular == 0.0F ? 32.0F
                        : is_phong ? static_cast<float>(4.0 * std::max(finish.phong_size, 0.0))
                                   : static_cast<float>(1.0 / finish.roughness);
}

} // namespace

core::Material Materials::material_of(const Look& look, const Place& place,
                                      const core::PlaneOf<double>* plane) {
    const Texture& texture = look.texture != nullptr ? *look.texture : *tokens_.default_texture;
    const Pigment& pigment = texture.pigment;
    const Finish& finish = texture.finish;
    core::Material material;
    if (takes_light(pigment.color) ||
        (pigment.kind != PigmentKind::color && takes_light(pigment.other)))
        tokens_.remark(place, "negative components of colours are not supported: 0 is used");
    material.pattern.colors[0] = color_of(pigment.color);
    if (pigment.kind != PigmentKind::color) {
        const Shared<Motion> motion = both(pigment.motion, look.above);
        const Motion& object_motion = motion != nullptr ? *motion : Motion{};
        core::Pattern pattern;
        const bool is_set = pigment.kind == PigmentKind::checker
                                ? set_checker(pigment, object_motion, plane, pattern)
                                : set_gradient(pigment, object_motion, pattern);
        if (is_set) {
            material.pattern = pattern;
            // In scenes that convert writes, gradients are visible only between their ends.
            if (pattern.kind == core::PatternKind::gradient && !tokens_.is_by_convert())
                tokens_.remark(place, "repetition of a gradient is not supported: beyond its ends "
                                      "it has the colours of the ends");
        } else {
            material.pattern.colors[0] = 0.5F * (color_of(pigment.color) + color_of(pigment.other));
            tokens_.remark(place,
                           "this position of a pattern is not supported: its mean colour is used");
        }
    }
    const auto& color = pigment.color.at;
    if (pigment.kind != PigmentKind::color &&
        (color[3] != pigment.other.at[3] || color[4] != pigment.other.at[4]))
        tokens_.remark(
            place,
            "different transparencies in a pattern are not supported: the first one is used");
    const double largest = std::clamp(std::max({color[0], color[1], color[2]}), 0.0, 1.0);
    if (color[3] != 0.0)
        tokens_.remark(place, "filter of a colour is not supported: light passes without colour");
    const double through = std::clamp(color[4] + color[3] * largest, 0.0, 1.0);
    // POV-Ray's diffuse light follows cos^brilliance, raylane's follows cos. With this factor,
    // their means over the hemisphere, weighted by cos^2, are equal.
    const double diffuse = std::max(finish.diffuse, 0.0) * (4.0 / (3.0 + finish.brilliance));
    material.ambient =
        static_cast<float>(std::max(finish.ambient * ambient_light + finish.emission, 0.0));
    material.diffuse = static_cast<float>(diffuse);
    set_highlight(finish, material, tokens_, place);
    const bool bends = look.interior != nullptr && look.interior->has_index;
    if (bends) material.index = static_cast<float>(look.interior->index);
    double reflection = std::clamp(finish.reflection, 0.0, 1.0);
    if (through > 0.0) {
        if (bends) {
            // POV-Ray multiplies the surface's ambient and diffuse light by 1 - through.
            material.transmission = static_cast<float>(through);
            material.ambient =
                static_cast<float>(static_cast<double>(material.ambient) * (1.0 - through));
            material.diffuse = static_cast<float>(diffuse * (1.0 - through));
        } else {
            // In POV-Ray, highlights and reflections apply to the whole surface. In raylane, they
            // apply to the opaque share of the surface only.
            material.opacity = static_cast<float>(1.0 - through);
            const double sum_of_series = through < 1.0 ? 1.0 / (1.0 - through) : 1.0;
            material.specular *= static_cast<float>(sum_of_series);
            reflection = std::min(reflection * sum_of_series, 1.0);
        }
    }
    if (finish.fresnel)
        material.reflection = core::Reflection::dielectric;
    else
        material.reflectivity = static_cast<float>(reflection);
    return material;
}

core::MaterialIndex Materials::index_of(const Look& look, const Place& place,
                                        const core::PlaneOf<double>* plane) {
    if (last_index_ != core::no_material && plane == nullptr && look.texture == last_.texture &&
        look.texture != nullptr && look.interior == last_.interior && look.above == last_.above)
        return last_index_;
    const core::Material material = material_of(look, place, plane);
    const auto [found, is_new] = known_.try_emplace(key_of(material), core::no_material);
    if (is_new) {
        tokens_.budget.keep(sizeof(material) + 2 * sizeof(decltype(known_)::value_type), place);
        try {
            found->second = builder_.add_material(material);
        } catch (const core::InvalidValue& invalid) {
            fail(place, "has an invalid material: " + std::string(invalid.what()));
        }
    }
    if (look.texture != nullptr) {
        const Texture& texture = *look.texture;
        constexpr std::size_t longest = 256; // POV-Ray's limit is 40; a loop makes many copies
        const std::string_view name = texture.name.empty() ? texture.pigment.name : texture.name;
        if (!name.empty()) builder_.name_material(found->second, name.substr(0, longest));
    }
    if (plane == nullptr) {
        last_ = look;
        last_index_ = found->second;
    }
    return found->second;
}

} // namespace raylane::scenes::pov
