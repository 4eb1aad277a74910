#include "scenes/formats/structure/polyhedra_layer.hpp"

#include "scenes/formats/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <set>
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
                polygon.push_back({points[corner]});
        }
        for (const CutPlane& plane : *through)
            polygons = clipped(polygons, plane.normal, plane.offset);
        for (const core::Triangle& triangle : triangles_of(polygons))
            shapes.add_whole(triangle, of_face, {atom, atom});
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
