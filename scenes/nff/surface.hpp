#pragma once

#include "core/scene/scene.hpp"

#include <array>
#include <map>
#include <optional>

namespace raylane::scenes {

/// NFF's fill color and shading parameters, as its text names them. Where a file has none it does
/// not say what objects look like: a matte grey.
struct NffFill {
    core::Color color{0.5F};
    float kd = 1.0F;
    float ks = 0.0F;
    float shine = 0.0F;
    float t = 0.0F;
    float index = 1.0F;
};

/// Throws core::InvalidValue. Kd and Ks may be above 1: the text says so.
void validate(const NffFill& fill);

/// The relative intensity of each of `lights` lights and of the ambient light that the Standard
/// Procedural Databases' Readme proposes.
float nff_intensity(std::size_t lights);

/// The material of a valid `fill` where the ambient light has that intensity.
///
/// Ks is the reflected fraction as well: the text knows no other, and the Readme wants a reflection
/// ray from each specular surface. T is the fraction of what is seen through the surface, which
/// core::Material states as a fraction of what is not reflected.
core::Material material_of(const NffFill& fill, float intensity, core::Visible visible);

/// Adds materials to a scene, each once however often a file states it.
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
