#include "scenes/formats/nff/surface.hpp"

#include "core/scene/validate.hpp"
#include "scenes/files/number.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::scenes {

namespace {

void require(bool good, const char* field, const char* must, float got) {
    if (!good) throw core::InvalidValue(field, std::string(must) + ", got " + to_text(got));
}

} // namespace

void validate(const NffFill& fill) {
    core::validate_color("color", fill.color);
    require(fill.kd >= 0.0F, "Kd", "must not be negative", fill.kd);
    require(fill.ks >= 0.0F, "Ks", "must not be negative", fill.ks);
    require(fill.shine >= 0.0F, "Shine", "must not be negative", fill.shine);
    require(fill.t >= 0.0F && fill.t <= 1.0F, "T", "must be from 0 to 1", fill.t);
    // The Standard Procedural Databases have an index of 0 on opaque objects.
    require(fill.index > 0.0F || (fill.index == 0.0F && fill.t == 0.0F), "index of refraction",
            "must be positive", fill.index);
    core::validate(material_of(fill, 1.0F, core::Visible::both)); // finds values that are too large
}

float nff_intensity(std::size_t lights) {
    const auto count = static_cast<double>(std::max<std::size_t>(lights, 1));
    return static_cast<float>(std::sqrt(count) / (2.0 * count));
}

core::Material material_of(const NffFill& fill, float intensity, core::Visible visible) {
    core::Material material;
    material.pattern.colors[0] = fill.color;
    material.ambient = intensity * fill.kd;
    material.diffuse = fill.kd;
    material.specular = fill.ks;
    material.exponent = fill.shine;
    material.reflectivity = std::min(fill.ks, 1.0F);
    material.transmission = fill.ks < 1.0F ? std::min(fill.t / (1.0F - fill.ks), 1.0F) : 0.0F;
    material.index = fill.index > 0.0F ? fill.index : 1.0F;
    material.visible = visible;
    return material;
}

core::MaterialIndex NffMaterials::index_of(const NffFill& fill, core::Visible visible) {
    const std::array<float, 9> key = {fill.color.x, fill.color.y, fill.color.z,
                                      fill.kd,      fill.ks,      fill.shine,
                                      fill.t,       fill.index,   static_cast<float>(visible)};
    const auto [place, is_new] = indices_.try_emplace(key);
    if (is_new) place->second = builder_.add_material(material_of(fill, intensity_, visible));
    return place->second;
}

} // namespace raylane::scenes
