#include "core/solids/lens.hpp"

#include "core/solids/transform.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::core {

namespace {

/// Returns the sagitta: how far a surface is behind its vertex at the distance `at` from the axis;
/// NaN if the surface does not reach so far.
double sag(double radius, double conic, double at) {
    if (radius == 0.0) return 0.0;
    const double curvature = 1.0 / radius;
    return curvature * at * at /
           (1.0 + std::sqrt(1.0 - (1.0 + conic) * curvature * curvature * at * at));
}

/// Returns the solid on that side of a curved surface on which its centre of curvature is.
PartShape behind(double vertex, double radius, double conic) {
    if (conic == 0.0) return SphereOf<double>{{0.0, 0.0, vertex + radius}, std::abs(radius)};
    // x^2 + y^2 + (1 + k) z^2 - 2 R z = 0
    QuadricOf<double> form{};
    form.center = {0.0, 0.0, vertex};
    form.xx = form.yy = 1.0;
    form.zz = 1.0 + conic;
    form.z = -radius;
    form.lower = Vec3d(-1.0);
    form.upper = Vec3d(1.0);
    return form;
}

/// Returns the half-space on the side of z opposite to `outward`, which is 1 or -1 along the axis.
Solid half_space(double z, double outward) {
    return of_shape(PlaneOf<double>{{0.0, 0.0, z}, {0.0, 0.0, outward}});
}

Solid of_two(Made by, Solid first, Solid second) {
    Solid solid{by};
    solid.parts.push_back(std::move(first));
    solid.parts.push_back(std::move(second));
    return solid;
}

/// The two sides of a lens, the front at z = 0.
struct Sides {
    const Lens& lens;
    double edges[2]; ///< z at the rim

    double vertex(int side) const { return side == 0 ? 0.0 : lens.thickness; }
    bool is_flat(int side) const { return lens.radii[side] == 0.0; }
    bool bulges(int side) const { return is_flat(side) || (lens.radii[side] > 0.0) == (side == 0); }
    /// Returns the middle of an ellipsoid, or the point midway between the sheets of a hyperboloid;
    /// not finite for a paraboloid.
    double middle(int side) const {
        return vertex(side) + lens.radii[side] / (1.0 + lens.conics[side]);
    }

    /// Returns the solid behind a bulging surface, or in front of a hollow one, as far as the lens
    /// reaches.
    Solid body(int side) const {
        const double into = side == 0 ? 1.0 : -1.0; // direction into the lens, along z
        if (is_flat(side)) return half_space(vertex(side), -into);
        Solid round = of_shape(behind(vertex(side), lens.radii[side], lens.conics[side]));
        const double conic = lens.conics[side];
        const double across = 2.0 * into * lens.radii[side] / (1.0 + conic);
        const double depth = side == 0 ? std::max(lens.thickness, edges[1])
                                       : lens.thickness - std::min(0.0, edges[0]);
        // The far side of an ellipsoid and the other sheet of a hyperboloid are not parts of the
        // lens.
        if (bulges(side)) {
            const double rim = std::abs(edges[side] - vertex(side));
            const bool is_ball = lens.radii[0] == -lens.radii[1] &&
                                 lens.conics[0] == lens.conics[1] && across >= lens.thickness;
            if (conic > -1.0 && !is_ball && !(across - rim >= depth))
                return of_two(Made::by_union, std::move(round), half_space(middle(side), -into));
        } else if (conic < -1.0 && across <= depth) {
            return of_two(Made::by_intersection, std::move(round), half_space(middle(side), into));
        }
        return round;
    }
};

/// Returns a rotation from the axis z to another axis.
Transform turned_to(const Vec3d& axis) {
    if (axis.x == 0.0 && axis.y == 0.0)
        return axis.z > 0.0 ? Transform() : Transform::rotation({180.0, 0.0, 0.0});
    const Vec3d z = normalized(axis);
    const Vec3d x = normalized(std::abs(z.x) < 0.9 ? cross(Vec3d(1.0, 0.0, 0.0), z)
                                                   : cross(Vec3d(0.0, 1.0, 0.0), z));
    const Vec3d y = cross(z, x);
    return Transform::turn(x, y, z);
}

} // namespace

Solid solid_of(const Lens& lens) {
    checks::require_point("vertex", lens.vertex);
    checks::require_direction("axis", lens.axis);
    checks::require_positive("thickness", lens.thickness);
    checks::require_positive("radius", lens.radius);
    Sides surfaces{lens, {}};
    auto& edges = surfaces.edges;
    for (int side = 0; side < 2; ++side) {
        const checks::Field field = checks::Field("radii").at(side);
        checks::require_coordinate(field, lens.radii[side]);
        checks::require_coordinate(checks::Field("conics").at(side), lens.conics[side]);
        edges[side] = sag(lens.radii[side], lens.conics[side], lens.radius) + surfaces.vertex(side);
        if (!std::isfinite(edges[side]))
            throw InvalidValue(field.text(),
                               "must make a surface that reaches the radius of the lens, got " +
                                   checks::text_of(lens.radii[side]));
    }
    if (!(edges[0] <= edges[1]))
        throw InvalidValue("thickness",
                           "must keep the surfaces apart within the radius of the lens, got " +
                               checks::text_of(lens.thickness));

    // The cylinder's ends are outside of the lens, and in front of a conic's other sheet.
    double beyond = 0.5 * lens.thickness;
    for (int side = 0; side < 2; ++side)
        if (lens.conics[side] < -1.0)
            beyond = std::min(beyond, std::abs(lens.radii[side] / (1.0 + lens.conics[side])));
    double ends[2] = {std::min(0.0, edges[0]) - beyond,
                      std::max(lens.thickness, edges[1]) + beyond};
    Solid solid{Made::by_difference};
    Solid inside{Made::by_intersection};
    for (int side = 0; side < 2; ++side) {
        const bool bulges = surfaces.bulges(side);
        (bulges ? inside : solid).parts.push_back(surfaces.body(side));
        if (bulges || !(lens.conics[side] > -1.0)) continue;
        // The cylinder must not extend beyond the middle of a hollow ellipsoid, which narrows
        // there.
        const double middle = surfaces.middle(side);
        ends[side] = side == 0 ? std::max(ends[0], middle) : std::min(ends[1], middle);
    }
    inside.parts.push_back(of_shape(CylinderOf<double, Ends::capped>{
        {0.0, 0.0, ends[0]}, {0.0, 0.0, ends[1] - ends[0]}, lens.radius}));
    Solid result = std::move(inside);
    if (!solid.parts.empty()) {
        solid.parts.insert(solid.parts.begin(), std::move(result));
        result = std::move(solid);
    }
    return Transform::translation(lens.vertex).after(turned_to(lens.axis))(result);
}

} // namespace raylane::core
