#include "scenes/formats/structure/polyhedra_layer.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace raylane::scenes {

using core::Vec3d;
using core::Vec3f;

namespace {

constexpr double in_plane = 0.05; // angstrom
constexpr float edge_radius = 0.02F;
constexpr std::size_t min_neighbours = 4, max_neighbours = 64;

using Face = std::vector<std::size_t>; // indices

/// Returns the points on the plane through three of them, if no point is in front of the plane.
Face face_through(std::span<const Vec3d> points, const Vec3d& at, const Vec3d& normal) {
    Face face;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double before = core::dot(points[i] - at, normal);
        if (before > in_plane) return {};
        if (before >= -in_plane) face.push_back(i);
    }
    return face;
}

/// Sorts the points of a face counter-clockwise around its normal, and drops those inside of it.
void sort_around(std::span<const Vec3d> points, const Vec3d& normal, Face& face) {
    // Gift wrapping in the plane: the next corner has all others on its left.
    Face around;
    const Vec3d away = points[face[1]] - points[face[0]];
    std::size_t corner = *std::max_element(face.begin(), face.end(), [&](auto a, auto b) {
        return core::dot(points[a], away) < core::dot(points[b], away);
    });
    do {
        around.push_back(corner);
        std::size_t next = corner == face[0] ? face[1] : face[0];
        for (const std::size_t other : face) {
            const Vec3d way = points[next] - points[corner], to = points[other] - points[corner];
            const double turn = core::dot(core::cross(way, to), normal);
            if (other != corner &&
                (turn < 0.0 || (turn == 0.0 && core::dot(to, to) > core::dot(way, way))))
                next = other;
        }
        corner = next;
    } while (corner != around.front() && around.size() <= face.size());
    face = std::move(around);
}

using Polygon = std::vector<Vec3d>; ///< corners, counter-clockwise from outside

/// Returns true if the corners of a triangle are on one line, as cuts near corners may leave them.
bool is_flat(const core::Triangle& triangle) {
    const Vec3d a = core::convert<double>(triangle.a);
    return core::cross(core::convert<double>(triangle.b) - a,
                       core::convert<double>(triangle.c) - a) == Vec3d(0.0);
}

/// Returns where an edge crosses a plane: the same point for both directions of the edge.
/// `a_above` and `b_above`: how far the ends are above the plane, with different signs.
Vec3d crossing_of(const Vec3d& a, double a_above, const Vec3d& b, double b_above) {
    if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z))
        return crossing_of(b, b_above, a, a_above);
    return a + a_above / (a_above - b_above) * (b - a);
}

/// Returns the polygon that a plane cuts from a convex polyhedron, from its corners in any order.
Polygon face_of(std::vector<Vec3d> corners, const Vec3d& normal) {
    Vec3d middle(0.0);
    for (const Vec3d& corner : corners)
        middle += 1.0 / static_cast<double>(corners.size()) * corner;
    const Vec3d u = corners.front() - middle, v = core::cross(normal, u);
    // Grows with the angle around the middle.
    const auto turn = [&](const Vec3d& corner) {
        const double x = core::dot(corner - middle, u) * core::length(normal);
        const double y = core::dot(corner - middle, v);
        const double share = x / (std::abs(x) + std::abs(y));
        return y < 0.0 ? share - 1.0 : 1.0 - share;
    };
    std::sort(corners.begin(), corners.end(),
              [&](const Vec3d& p, const Vec3d& q) { return turn(p) < turn(q); });
    return corners;
}

/// Returns the part of a convex polyhedron that a plane keeps, with a face on the plane.
std::vector<Polygon> clipped(const std::vector<Polygon>& polygons, const CutPlane& plane) {
    const auto above = [&](const Vec3d& p) { return core::dot(plane.normal, p) - plane.offset; };
    std::vector<Polygon> kept;
    std::vector<Vec3d> on_plane;
    bool is_below = false;
    for (const Polygon& polygon : polygons) {
        Polygon part;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vec3d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
            const double a_above = above(a), b_above = above(b);
            is_below = is_below || a_above < 0.0;
            if (a_above <= 0.0) part.push_back(a);
            if (a_above == 0.0) on_plane.push_back(a);
            if (a_above * b_above < 0.0) {
                part.push_back(crossing_of(a, a_above, b, b_above));
                on_plane.push_back(part.back());
            }
        }
        if (part.size() >= 3) kept.push_back(std::move(part));
    }
    if (!is_below) return {};
    const auto by_place = [](const Vec3d& p, const Vec3d& q) {
        return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    };
    std::sort(on_plane.begin(), on_plane.end(), by_place);
    on_plane.erase(std::unique(on_plane.begin(), on_plane.end()), on_plane.end());
    if (on_plane.size() >= 3 && polygons.size() > 1)
        kept.push_back(face_of(std::move(on_plane), plane.normal));
    return kept;
}

} // namespace

std::vector<std::vector<std::size_t>> hull_of(std::span<const Vec3d> points) {
    constexpr double min_sine = 1e-3;
    std::set<Face> known;
    std::vector<std::pair<Face, Vec3d>> found;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < points.size(); ++j)
            for (std::size_t k = std::min(i, j) + 1; k < points.size(); ++k) {
                if (j == i || k == i || k == j) continue;
                const Vec3d u = points[j] - points[i], v = points[k] - points[i];
                const Vec3d across = core::cross(u, v);
                const double size = core::length(across);
                if (!(size > min_sine * core::length(u) * core::length(v))) continue;
                const Vec3d normal = 1.0 / size * across;
                Face face = face_through(points, points[i], normal);
                if (face.size() >= 3 && known.insert(face).second)
                    found.emplace_back(std::move(face), normal);
            }
    std::vector<Face> faces;
    for (const auto& each : found) {
        const Face& face = each.first;
        const bool is_part = std::any_of(known.begin(), known.end(), [&](const Face& other) {
            return other.size() > face.size() &&
                   std::includes(other.begin(), other.end(), face.begin(), face.end());
        });
        if (is_part) continue;
        faces.push_back(face);
        sort_around(points, each.second, faces.back());
    }
    return faces;
}

std::size_t add_polyhedra_layer(const DrawnAtoms& atoms, const AtomLayer& layer,
                                DrawnShapes& shapes) {
    const Style style = *layer.look.style;
    Palette faces(shapes.builder(), *layer.look.opacity, atoms.finish),
        edges(shapes.builder(), 1.0F, atoms.finish);
    const Structure& structure = atoms.all();
    std::vector<std::vector<Vec3d>> neighbours(atoms.complete);
    for (const Bond& bond : atoms.bonds)
        for (const auto& [of, other] : {std::pair{bond.a, bond.b}, std::pair{bond.b, bond.a}})
            if (of < neighbours.size() && layer.has(atoms, atoms.original(of)))
                neighbours[of].push_back(core::convert<double>(structure.positions[other]));
    std::size_t count = 0;
    for (AtomIndex i = 0; i < neighbours.size(); ++i) {
        const std::vector<Vec3d>& points = neighbours[i];
        if (points.size() < min_neighbours || points.size() > max_neighbours) continue;
        ++count;
        core::Bounds bounds;
        for (const Vec3d& point : points)
            core::include_point(bounds, point);
        const auto through = planes_through(bounds, shapes.cuts());
        if (!through) continue;
        const AtomIndex atom = atoms.original(i);
        const auto name = [&] { return layer.colors.meaning_of(atom); };
        const std::uint32_t color = layer.colors.of(atom);
        const core::MaterialIndex of_face = faces.of(color, name);
        const core::MaterialIndex of_edge = edges.of(darker(color), name);
        std::set<std::pair<std::size_t, std::size_t>> done;
        std::vector<char> has_corner(points.size());
        const std::vector<Face> hull = hull_of(points);
        std::vector<Polygon> polygons;
        for (const Face& face : hull) {
            Polygon& polygon = polygons.emplace_back();
            for (const std::size_t corner : face)
                polygon.push_back(points[corner]);
        }
        for (const CutPlane& plane : *through)
            polygons = clipped(polygons, plane);
        for (const Polygon& polygon : polygons)
            for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
                const core::Triangle triangle{core::convert<float>(polygon[0]),
                                              core::convert<float>(polygon[k]),
                                              core::convert<float>(polygon[k + 1])};
                if (!is_flat(triangle)) shapes.add_whole(triangle, of_face, {atom, atom});
            }
        for (const Face& face : hull) {
            const auto at = [&](std::size_t corner) {
                return core::convert<float>(points[face[corner % face.size()]]);
            };
            for (std::size_t k = 0; k < face.size(); ++k) {
                if (std::exchange(has_corner[face[k]], 1) == 0)
                    shapes.add(core::Sphere{at(k), edge_radius}, of_edge, style, 1.0F,
                               {atom, atom});
                if (done.insert(std::minmax(face[k], face[(k + 1) % face.size()])).second)
                    shapes.add(core::CappedCylinder{at(k), at(k + 1) - at(k), edge_radius}, of_edge,
                               style, 1.0F, {atom, atom});
            }
        }
    }
    return count;
}

} // namespace raylane::scenes
