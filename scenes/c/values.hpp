#pragma once

#include "raylane/raylane.h"
#include "raylane/raylane.hpp"

#include <cstdint>
#include <string>

/// Conversions between the values of the C++ library and those of the C interface.
namespace raylane::c {

inline Vec3 from_c(const raylane_vec3& v) {
    return {v.x, v.y, v.z};
}
inline raylane_vec3 to_c(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// Converts an enumerator from an int. Throws InvalidValue outside of 0 to 255; the library rejects
/// other invalid ones.
template <class Enum>
Enum enum_from_int(const char* name, int number) {
    if (number < 0 || number > 255)
        throw InvalidValue(name, "must be one of its enumerators, got " + std::to_string(number));
    return static_cast<Enum>(number);
}

Material from_c(const raylane_material& material);
Light from_c(const raylane_light& light);
Fog from_c(const raylane_fog& fog);
Camera from_c(const raylane_camera& camera);
Settings from_c(const raylane_settings& settings);
raylane_settings to_c(const Settings& settings);

} // namespace raylane::c
