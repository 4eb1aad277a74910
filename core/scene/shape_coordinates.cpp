#include "core/scene/shape_coordinates.hpp"

#include "core/numbers/more_functions.hpp"
#include "core/shapes/box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raylane::core {

namespace {

/// Two unit vectors across an axis: upwards seen from its end, and to the right of that.
struct Across {
    Vec3d right, up;

    explicit Across(const Vec3d& along) {
        const Vec3d axis = normalized(along);
        const bool is_upright = std::abs(axis.y) > 0.9;
        const Vec3d upwards = is_upright ? Vec3d(0.0, 0.0, -1.0) : Vec3d(0.0, 1.0, 0.0);
        up = normalized(Vec3d(upwards - dot(upwards, axis) * axis));
        right = cross(up, axis);
    }
};

/// Returns the angle of (x, y) as a fraction of a turn, from 0 to 1.
double turn(double x, double y) {
    const double angle = atan2(y, x) * (0.5 / std::numbers::pi);
    return angle < 0.0 ? angle + 1.0 : angle;
}

/// A point on a shape.
struct Spot {
    Vec3d point;
    Face face;
    const ObjectSpace* space; ///< may be null
    Vec3d pole;

    Vec3d vector(const Vec3d& v) const { return space == nullptr ? v : space->vector(v); }
    Vec3d normal(const Vec3d& n) const { return space == nullptr ? n : space->normal(n); }
};

/// Returns the coordinates of a direction on a sphere with a pole.
ShapeCoordinates on_globe(const Vec3d& direction, const Vec3d& pole) {
    Vec3d d = direction;
    if (pole != Vec3d(0.0, 1.0, 0.0)) {
        const Across across(pole);
        d = {dot(direction, across.right), dot(direction, normalized(pole)),
             -dot(direction, across.up)};
    }
    const double latitude = atan2(d.y, std::sqrt(d.x * d.x + d.z * d.z));
    return {turn(d.x, -d.z), 0.5 + latitude / std::numbers::pi};
}

/// Returns (a, b, c) of offset = a u + b v + c w.
Vec3d parts_along(const Vec3d& offset, const Vec3d& u, const Vec3d& v, const Vec3d& w) {
    const Vec3d across_u = cross(v, w), across_v = cross(w, u), across_w = cross(u, v);
    return Vec3d(dot(across_u, offset), dot(across_v, offset), dot(across_w, offset)) /
           dot(across_u, u);
}

ShapeCoordinates on(const SphereOf<double>& s, const Spot& spot) {
    return on_globe(spot.vector((spot.point - s.center) / s.radius), spot.pole);
}
/// Transforms keep the parts along the axes.
ShapeCoordinates on(const EllipsoidOf<double>& s, const Spot& spot) {
    return on_globe(parts_along(spot.point - s.center, s.axis_u, s.axis_v, s.axis_w), spot.pole);
}
ShapeCoordinates on_axial(const Vec3d& axis, const Vec3d& offset) {
    const Across across(axis);
    return {turn(dot(offset, across.right), dot(offset, across.up)),
            std::clamp(dot(offset, axis) / squared_length(axis), 0.0, 1.0)};
}
template <Ends ends>
ShapeCoordinates on(const CylinderOf<double, ends>& s, const Spot& spot) {
    return on_axial(spot.vector(s.axis), spot.vector(spot.point - s.base));
}
template <Ends ends>
ShapeCoordinates on(const ConeOf<double, ends>& s, const Spot& spot) {
    return on_axial(spot.vector(s.axis), spot.vector(spot.point - s.base));
}
ShapeCoordinates on_flat(const Vec3d& normal, const Vec3d& offset, double unit) {
    const Across across(normal);
    return {dot(offset, across.right) / unit, dot(offset, across.up) / unit};
}
ShapeCoordinates on(const PlaneOf<double>& s, const Spot& spot) {
    return on_flat(spot.normal(s.normal), spot.vector(spot.point - s.point), 1.0);
}
/// Transforms scale discs by one factor.
ShapeCoordinates on(const DiscOf<double>& s, const Spot& spot) {
    const double scale = spot.space == nullptr ? 1.0 : length(spot.space->rows[0]);
    return on_flat(spot.normal(s.normal), spot.vector(spot.point - s.center), scale * s.radius);
}
/// A mirrored triangle has its corners b and c exchanged.
template <AnyTriangle Triangle>
ShapeCoordinates on(const Triangle& s, const Spot& spot) {
    const Vec3d ab = s.b - s.a, ac = s.c - s.a;
    const Vec3d weights = parts_along(spot.point - s.a, ab, ac, cross(ab, ac));
    if (spot.space != nullptr && spot.space->is_mirrored()) return {weights.y, weights.x};
    return {weights.x, weights.y};
}
ShapeCoordinates on(const BoxOf<double>& s, const Spot& spot) {
    const Vec3d parts = parts_along(spot.point - s.corner, s.edge_u, s.edge_v, s.edge_w);
    const int across = spot.face / 2;
    return {parts[(across + 1) % 3], parts[(across + 2) % 3]};
}
ShapeCoordinates on(const QuadricOf<double>&, const Spot&) {
    return {};
}

} // namespace

ShapeCoordinates coordinates_on(const Tables& shapes, Kind kind, Place place, Face face,
                                const Vec3d& point, const ObjectSpace* space, const Vec3d& pole) {
    return with_table(shapes, kind, [&](const auto& table) {
        return on(table.get(place), Spot{point, face, space, pole});
    });
}

} // namespace raylane::core
