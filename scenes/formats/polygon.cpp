#include "scenes/formats/polygon.hpp"

#include "core/shapes/checks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace raylane::scenes {

namespace {

using core::Vec3d, core::Vec3f;

std::tuple<double, double, double> key_of(const Vec3d& p) {
    return {p.x, p.y, p.z};
}

/// Returns where an edge crosses a plane. `a_above` and `b_above`: how far the ends are above the
/// plane, with different signs.
PolygonCorner crossing_of(const PolygonCorner& a, double a_above, const PolygonCorner& b,
                          double b_above) {
    if (key_of(b.at) < key_of(a.at)) return crossing_of(b, b_above, a, a_above);
    const double share = a_above / (a_above - b_above);
    return {a.at + share * (b.at - a.at), a.normal + share * (b.normal - a.normal)};
}

/// Clips a polygon by the algorithm of Sutherland and Hodgman. Appends its corners on the plane.
Polygon clipped(const Polygon& polygon, const Vec3d& normal, double offset,
                std::vector<Vec3d>& on_plane) {
    const auto above = [&](const PolygonCorner& corner) {
        return core::dot(normal, corner.at) - offset;
    };
    Polygon part;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const PolygonCorner &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double a_above = above(a), b_above = above(b);
        if (a_above <= 0.0) part.push_back(a);
        if (a_above == 0.0) on_plane.push_back(a.at);
        if ((a_above < 0.0 && b_above > 0.0) || (a_above > 0.0 && b_above < 0.0)) {
            part.push_back(crossing_of(a, a_above, b, b_above));
            on_plane.push_back(part.back().at);
        }
    }
    return part;
}

/// Returns the convex polygon with these corners, which are in any order.
Polygon face_of(const std::vector<Vec3d>& corners, const Vec3d& normal) {
    Vec3d middle(0.0);
    for (const Vec3d& corner : corners)
        middle += 1.0 / static_cast<double>(corners.size()) * corner;
    const Vec3d u = corners.front() - middle, v = core::cross(normal, u);
    // Grows with the angle around the middle.
    const auto turn = [&](const PolygonCorner& corner) {
        const double x = core::dot(corner.at - middle, u) * core::length(normal);
        const double y = core::dot(corner.at - middle, v);
        const double share = x / (std::abs(x) + std::abs(y));
        return y < 0.0 ? share - 1.0 : 1.0 - share;
    };
    Polygon face;
    for (const Vec3d& corner : corners)
        face.push_back({corner, normal});
    std::sort(face.begin(), face.end(),
              [&](const PolygonCorner& p, const PolygonCorner& q) { return turn(p) < turn(q); });
    return face;
}

/// Calls use(a, b, c) with the corners of each triangle of the polygons' fans that has an area in
/// floats.
template <class Use>
void for_each_triangle(const std::vector<Polygon>& polygons, const Use& use) {
    const auto point = [](const PolygonCorner& corner) { return core::convert<float>(corner.at); };
    for (const Polygon& polygon : polygons)
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            const PolygonCorner &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
            if (!core::checks::are_collinear(point(a), point(b), point(c))) use(a, b, c);
        }
}

} // namespace

Polygon polygon_of(const core::SmoothTriangle& t) {
    return {{core::convert<double>(t.a), core::convert<double>(t.normal_a)},
            {core::convert<double>(t.b), core::convert<double>(t.normal_b)},
            {core::convert<double>(t.c), core::convert<double>(t.normal_c)}};
}

Polygon clipped(const Polygon& polygon, const Vec3d& normal, double offset) {
    std::vector<Vec3d> on_plane;
    return clipped(polygon, normal, offset, on_plane);
}

std::vector<Polygon> clipped(const std::vector<Polygon>& body, const Vec3d& normal, double offset) {
    std::vector<Polygon> kept;
    std::vector<Vec3d> on_plane;
    bool is_below = false;
    for (const Polygon& polygon : body) {
        const std::size_t before = on_plane.size();
        Polygon part = clipped(polygon, normal, offset, on_plane);
        is_below = is_below || part.size() > on_plane.size() - before;
        if (part.size() >= 3) kept.push_back(std::move(part));
    }
    if (!is_below) return {};
    const auto by_place = [](const Vec3d& p, const Vec3d& q) { return key_of(p) < key_of(q); };
    std::sort(on_plane.begin(), on_plane.end(), by_place);
    on_plane.erase(std::unique(on_plane.begin(), on_plane.end()), on_plane.end());
    if (on_plane.size() >= 3 && body.size() > 1) kept.push_back(face_of(on_plane, normal));
    return kept;
}

std::vector<core::SmoothTriangle> smooth_triangles_of(const std::vector<Polygon>& polygons) {
    std::vector<core::SmoothTriangle> triangles;
    for_each_triangle(polygons, [&](const auto& a, const auto& b, const auto& c) {
        triangles.push_back({core::convert<float>(a.at), core::convert<float>(b.at),
                             core::convert<float>(c.at), core::convert<float>(a.normal),
                             core::convert<float>(b.normal), core::convert<float>(c.normal)});
    });
    return triangles;
}

std::vector<core::Triangle> triangles_of(const std::vector<Polygon>& polygons) {
    std::vector<core::Triangle> triangles;
    for_each_triangle(polygons, [&](const auto& a, const auto& b, const auto& c) {
        triangles.push_back(
            {core::convert<float>(a.at), core::convert<float>(b.at), core::convert<float>(c.at)});
    });
    return triangles;
}

} // namespace raylane::scenes
