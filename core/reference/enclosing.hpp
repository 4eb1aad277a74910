#pragma once

#include "core/optics/media.hpp"
#include "core/reference/containing.hpp"
#include "core/reference/search.hpp"

#include <algorithm>
#include <limits>
#include <vector>

/// Finds the media that enclose a point, such as the camera's position.
namespace raylane::core {

/// Returns true for a part of an unbounded solid.
inline bool is_of_unbounded(const Scene& scene, ShapeId id) {
    const Solids& solids = scene.solids();
    return solids.has(id) && !is_finite(solids.bounds(solids.root_of(solids.part_of(id))));
}

/// Returns the transmissive materials that a ray leaves without having entered them, in the order
/// in which it leaves them. Ignores unbounded shapes, whose inside has no end, and unbounded
/// solids.
template <class Real>
std::vector<MaterialIndex> left_along(const Scene& scene, Searcher<Real>& searcher,
                                      const Ray<Real>& ray) {
    std::vector<Hit<Real>> hits;
    searcher.each(ray, OriginSurfaces<Real>{}, std::numeric_limits<Real>::infinity(),
                  [&](const Hit<Real>& hit) {
                      if (traits_of(hit.kind).bounded && !is_of_unbounded(scene, hit.shape) &&
                          scene.materials()[scene.medium_index_of(hit.shape)].transmits())
                          hits.push_back(hit);
                      return true;
                  });
    searcher.sort(ray, {}, hits);

    std::vector<MaterialIndex> entered, left;
    for (const Hit<Real>& hit : hits) {
        const MaterialIndex material = scene.medium_index_of(hit.shape);
        const auto match = std::find(entered.begin(), entered.end(), material);
        if (hit.enters())
            entered.push_back(material);
        else if (match != entered.end())
            entered.erase(match);
        else
            left.push_back(material);
    }
    return left;
}

/// Returns false if no point of a box is inside of a transmissive body, planes aside. The box is
/// then outside of the bounds of every solid, and of the common bounds of all surfaces that could
/// together enclose a body.
bool may_be_in_body(const Scene& scene, const Bounds& box);

/// Returns the media that enclose a point. A point is in a body if a line through it leaves the
/// body both ways, and behind a plane by its position. Searches only if a body may enclose the
/// point; `may_be_in_a_body`: false if no body does.
template <class Real>
Media enclosing_media(const Scene& scene, Searcher<Real>& searcher, MediaStacks& stacks,
                      const Vec3<Real>& point, bool may_be_in_a_body = true) {
    Media media = empty_space;
    if (!scene.transmissive().any) return media;

    for_each_unbounded_table(scene.shapes(), [&](const auto& table) {
        for_each_shape(table, [&](const auto& plane, ShapeId id) {
            const Vec3<Real> to_plane = convert<Real>(plane.point) - point;
            if (scene.material_of(id).transmits() && !scene.solids().has(id) &&
                dot(to_plane, convert<Real>(plane.normal)) > Real(0))
                media = stacks.entered(media, scene.material_index_of(id));
        });
    });

    if (scene.solids().any()) {
        PointSearcher points(scene);
        for (const Solids::Index solid : points.unbounded()) {
            const MaterialIndex medium = scene.solids().medium(solid);
            if (scene.materials()[medium].transmits() &&
                points.side_of(solid, convert<double>(point)) == Side::inside)
                media = stacks.entered(media, medium);
        }
    }

    if (!may_be_in_a_body) return media;
    Bounds around_point;
    include_point(around_point, point);
    if (!may_be_in_body(scene, around_point)) return media;

    // Any direction works; one with round components would run along faces and edges.
    const Vec3<Real> direction = normalized(Vec3<Real>(Real(0.41), Real(0.57), Real(0.71)));
    const std::vector<MaterialIndex> ahead = left_along(scene, searcher, {point, direction});
    std::vector<MaterialIndex> behind =
        left_along(scene, searcher, {point, Vec3<Real>(-direction)});
    for (auto outermost = ahead.rbegin(); outermost != ahead.rend(); ++outermost) {
        const auto match = std::find(behind.begin(), behind.end(), *outermost);
        if (match == behind.end()) continue;
        behind.erase(match);
        media = stacks.entered(media, *outermost);
    }
    return media;
}

} // namespace raylane::core
