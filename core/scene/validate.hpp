#pragma once

#include "core/scene/invalid_value.hpp"
#include "core/scene/surroundings.hpp"
#include "core/shapes/shapes.hpp"

/// What makes a value one that a scene may hold. All functions throw InvalidValue.
namespace raylane::core {

/// Coordinates and lengths are at most this large, so that no product in the solvers can overflow.
inline constexpr float coordinate_limit = 1e30F;

void validate(const Sphere& sphere);
void validate(const Plane& plane);
void validate(const Disc& disc);
void validate(const Triangle& triangle);
void validate(const SmoothTriangle& triangle);
void validate(const Box& box);
void validate(const OpenCylinder& cylinder);
void validate(const CappedCylinder& cylinder);
void validate(const OpenCone& cone);
void validate(const CappedCone& cone);
void validate(const Quadric& quadric);
void validate(const Material& material);
void validate(const Light& light);
void validate(const Fog& fog);
void validate(const Camera& camera);
void validate(const Settings& settings);

/// A colour: components >= 0.
void validate_color(const char* field, const Color& color);

} // namespace raylane::core
