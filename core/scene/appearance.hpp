#pragma once

#include <cstdint>

/// Choices of shading, for the scalar tracer and the kernels alike: enumerators only. A switch over
/// one of them has no default, so that a new enumerator does not compile until it is implemented.
namespace raylane::core {

enum class PatternKind : std::uint8_t {
    solid,
    checker,
    stripes,
    gradient,
    formula,
    image,
    cutaway, ///< the colour of the part that a face of a solid cuts
};

/// Coordinates of the points of a pattern.
enum class PatternSpace : std::uint8_t {
    world,
    object, ///< those in which the object was described, before transforms moved it
};

/// Colours beyond the edges of an image.
enum class ImageWrap : std::uint8_t {
    repeat, ///< those of further copies of the image
    clamp,  ///< those of the nearest edge
};

enum class Reflection : std::uint8_t {
    constant,   ///< `reflectivity`, whatever the angle
    schlick,    ///< Schlick's approximation, from `index`
    dielectric, ///< Fresnel's equations for an unpolarised ray, from `index`
};

/// Cosine whose power is the highlight. n: normal, l: to the light, d: the ray's direction.
enum class Highlight : std::uint8_t {
    blinn, ///< of n and the direction halfway between l and -d
    phong, ///< of l and the direction in which n reflects the ray
};

enum class LightKind : std::uint8_t { point, directional, sky, sphere, disc, rectangle };

/// Returns true for lights that are seen in more than one direction.
constexpr bool is_soft(LightKind kind) {
    return kind != LightKind::point && kind != LightKind::directional;
}

enum class FogKind : std::uint8_t {
    none,
    linear_z,    ///< by world z: none at z = start, all at z = end
    linear,      ///< by the distance along the ray: none at `start`, all at `end`
    exponential, ///< 1 - exp(-density * distance)
};

} // namespace raylane::core
