#pragma once

#include "core/reference/tracer.hpp"

/// Scenes of a few shapes whose colours are known in closed form.
namespace little_scene {

using namespace raylane::core;

/// Returns a material that shows its own colour in any light.
inline Material luminous(const Color& color = Color(1.0F)) {
    Material material;
    material.pattern.colors[0] = color;
    material.ambient = 1.0F;
    material.diffuse = 0.0F;
    return material;
}

/// Returns a material that shows the position along the way from 0 to `end`, as a fraction in all
/// channels.
inline Material ruler(const Vec3f& end) {
    Material material = luminous();
    material.pattern.kind = PatternKind::gradient;
    material.pattern.colors = {Color(0.0F), Color(1.0F)};
    material.pattern.from = Vec3f(0.0F);
    material.pattern.to = end;
    return material;
}

inline Material black() {
    Material material = luminous(Color(0.0F));
    material.ambient = 0.0F;
    return material;
}

inline Material mirror(float reflectivity = 1.0F) {
    Material material = black();
    material.reflectivity = reflectivity;
    return material;
}

inline Material glass(float index, Reflection reflection = Reflection::constant) {
    Material material = black();
    material.transmission = 1.0F;
    material.index = index;
    material.reflection = reflection;
    return material;
}

class Builder : public SceneBuilder {
  public:
    Builder() {
        settings.max_depth = 16;
        settings.min_weight = 0.0F;
    }

    template <class Shape>
    ShapeId add_shape(const Shape& shape, const Material& material) {
        return add(shape, add_material(material));
    }

    /// Builds the scene with a light, as scenes need one even if nothing reflects it.
    Scene finish() { return finish({.kind = LightKind::directional}); }

    Scene finish(const Light& light) {
        add_light(light);
        return std::move(*this).build();
    }
};

/// Returns the colour along a ray in the given direction, which need not be of unit length.
template <class Real>
Vec3<Real> color_along(const Scene& scene, const Vec3<Real>& origin, const Vec3<Real>& direction) {
    ReferenceTracer<Real> tracer(scene, scene.settings());
    return tracer.trace({origin, normalized(direction)});
}

inline double gray_along(const Scene& scene, const Vec3d& origin, const Vec3d& direction) {
    return color_along<double>(scene, origin, direction).x;
}

} // namespace little_scene
