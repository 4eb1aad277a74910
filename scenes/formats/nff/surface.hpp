#pragma once

#include "core/scene/scene.hpp"

#include <array>
#include <map>

namespace raylane::scenes {

/// NFF's fill color and shading parameters, named as in its text. Defaults to a matte grey, as NFF
/// does not define the look of objects before the first fill.
struct NffFill {
    core::Color color{0.5F};
    float kd = 1.0F;
    float ks = 0.0F;
    float shine = 0.0F;
    float t = 0.0F;
    float index = 1.0F;
};

/// Throws core::InvalidValue. Kd and Ks may be above 1, as the text states.
void validate(const NffFill& fill);

/// Returns the relative intensity that the Standard Procedural Databases' Readme proposes for each
/// of `lights` lights and for the ambient light.
float nff_intensity(std::size_t lights);

/// Returns the material of a valid `fill` for this intensity of the ambient light.
///
/// Ks is also the reflected fraction: the text has no other parameter for it, and the Readme wants
/// a reflection ray from each specular surface. T is the fraction seen through the surface, which
/// core::Material has as a fraction of the light that is not reflected.
core::Material material_of(const NffFill& fill, float intensity, core::Visible visible);

/// Adds materials to a scene, each only once even if a file repeats it.
class NffMaterials {
  public:
    NffMaterials(core::SceneBuilder& builder, float intensity)
        : builder_(builder), intensity_(intensity) {}

    core::MaterialIndex index_of(const NffFill& fill, core::Visible visible);

  private:
    core::SceneBuilder& builder_;
    float intensity_;
    std::map<std::array<float, 9>, core::MaterialIndex> indices_;
};

} // namespace raylane::scenes
