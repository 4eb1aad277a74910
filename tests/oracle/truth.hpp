#pragma once

#include "tests/oracle/normals.hpp"
#include "tests/placing.hpp"

#include <limits>
#include <span>

namespace raylane::oracle {

using tests::AnyShape;

inline std::vector<Hit> crossings(const AnyShape& any, const core::Ray<double>& ray) {
    return std::visit([&](const auto& shape) { return crossings(shape, ray); }, any);
}
inline Direction normal(const AnyShape& any, const core::Ray<double>& ray, const Hit& hit) {
    return std::visit([&](const auto& shape) { return normal(shape, ray, hit); }, any);
}

/// A crossing with one of several shapes.
struct Found {
    Hit hit;
    core::ShapeId shape;

    /// By t; at the same t what is entered before what is left, then by shape.
    bool is_before(const Found& other) const {
        const int order = compare(hit, other.hit);
        if (order != 0) return order < 0;
        if (hit.entering != other.hit.entering) return hit.entering;
        return shape < other.shape;
    }
};

/// All crossings ahead of a ray, in no order.
inline std::vector<Found> all_ahead(std::span<const AnyShape> shapes,
                                    const core::Ray<double>& ray) {
    std::vector<Found> all;
    for (core::ShapeId id = 0; id < shapes.size(); ++id)
        for (const Hit& hit : crossings(shapes[id], ray))
            if (hit.t > 0) all.push_back({hit, id});
    return all;
}

/// The first of those whose rounded t is in (t_min, t_max], or null.
inline const Found* nearest(std::span<const Found> all, float t_min = 0.0F,
                            float t_max = std::numeric_limits<float>::infinity()) {
    const bool unlimited = t_min <= 0.0F && t_max == std::numeric_limits<float>::infinity();
    const Found* first = nullptr;
    for (const Found& found : all) {
        if (!unlimited) {
            const float t = rounded(found.hit.root);
            if (!(t_min < t && t <= t_max)) continue;
        }
        if (first == nullptr || found.is_before(*first)) first = &found;
    }
    return first;
}

} // namespace raylane::oracle
