#include "core/optics/soft_light.hpp"

#include "core/numbers/vector.hpp"
#include "core/scene/surroundings.hpp"

namespace raylane::core {

namespace {

void copy(const Vec3d& from, double (&to)[3]) {
    for (int axis = 0; axis < 3; ++axis)
        to[axis] = from[axis];
}

/// Returns a unit vector perpendicular to a unit vector.
Vec3d across(const Vec3d& v) {
    const Vec3d other = std::abs(v.x) < 0.5 ? Vec3d(1.0, 0.0, 0.0) : Vec3d(0.0, 1.0, 0.0);
    return normalized(cross(v, other));
}

} // namespace

SoftLight prepared(const Light& light) {
    SoftLight soft{};
    soft.kind = light.kind;
    copy(convert<double>(light.color), soft.color);
    copy(convert<double>(light.ground), soft.ground);
    copy(convert<double>(light.position), soft.middle);
    soft.reach = static_cast<double>(light.reach);
    soft.radius = static_cast<double>(light.radius);
    if (light.kind == LightKind::rectangle) {
        const Vec3d u = convert<double>(light.edge_u), v = convert<double>(light.edge_v);
        // The edges are perpendicular except for rounding.
        const Vec3d normal = normalized(cross(u, v)), unit = normalized(u);
        copy(unit, soft.axis[0]);
        copy(cross(normal, unit), soft.axis[1]);
        copy(normal, soft.axis[2]);
        soft.extent[0] = length(u);
        soft.extent[1] = length(v);
        return soft;
    }
    const double sign = light.kind == LightKind::sky ? -1.0 : 1.0;
    const Vec3d axis = sign * normalized(convert<double>(light.direction));
    copy(across(axis), soft.axis[0]);
    copy(cross(axis, across(axis)), soft.axis[1]);
    copy(axis, soft.axis[2]);
    return soft;
}

} // namespace raylane::core
