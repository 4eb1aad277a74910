#pragma once

#include "core/optics/media.hpp"
#include "core/reference/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

/// Media that enclose a point, such as a camera's place.
namespace raylane::core {

/// The transmissive materials that a ray leaves without having entered them, those left first in
/// front. What is unbounded, and has an inside without end, does not count.
template <class Real>
std::vector<MaterialIndex> left_along(const Scene& scene, Searcher<Real>& searcher,
                                      const Ray<Real>& ray) {
    std::vector<Hit<Real>> hits;
    searcher.each(ray, OriginSurfaces<Real>{}, std::numeric_limits<Real>::infinity(),
                  [&](const Hit<Real>& hit) {
                      if (traits_of(hit.kind).bounded && scene.material_of(hit.shape).transmits())
                          hits.push_back(hit);
                      return true;
                  });
    searcher.sort(ray, {}, hits);

    std::vector<MaterialIndex> entered, left;
    for (const Hit<Real>& hit : hits) {
        const MaterialIndex material = scene.material_index_of(hit.shape);
        const auto match = std::find(entered.begin(), entered.end(), material);
        if (hit.entering)
            entered.push_back(material);
        else if (match != entered.end())
            entered.erase(match);
        else
            left.push_back(material);
    }
    return left;
}

/// False if no point of a box is inside of a transmissive body, planes aside: each is outside of
/// the bounds of every solid, and of those around all that could be a body together.
bool may_be_in_body(const Scene& scene, const Bounds& box);

/// Bounds of points, rounded outwards.
template <class Real>
void include_point(Bounds& bounds, const Vec3<Real>& point) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const auto value = static_cast<float>(point[axis]);
        bounds.lower[axis] = std::min(bounds.lower[axis], std::nextafter(value, -infinity));
        bounds.upper[axis] = std::max(bounds.upper[axis], std::nextafter(value, infinity));
    }
}

/// A point is in a body if a line through it leaves the body both ways, and behind a plane if it
/// is. Where no body can be around it, nothing is searched; `may_be_in_a_body`: false if that is
/// known.
template <class Real>
Media enclosing_media(const Scene& scene, Searcher<Real>& searcher, MediaStacks& stacks,
                      const Vec3<Real>& point, bool may_be_in_a_body = true) {
    Media media = empty_space;
    if (!scene.transmissive().any) return media;

    for_each_unbounded_table(scene.shapes(), [&](const auto& table) {
        for_each_shape(table, [&](const auto& plane, ShapeId id) {
            const Vec3<Real> to_plane = convert<Real>(plane.point) - point;
            if (scene.material_of(id).transmits() &&
                dot(to_plane, convert<Real>(plane.normal)) > Real(0))
                media = stacks.entered(media, scene.material_index_of(id));
        });
    });

    if (!may_be_in_a_body) return media;
    Bounds around_point;
    include_point(around_point, point);
    if (!may_be_in_body(scene, around_point)) return media;

    // Any direction does; a round one would run along faces and edges.
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
