#pragma once

#include "core/shapes/shape_table.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace raylane::bench {

/// Returns the places of a table's shapes, in the order in which these were added to the scene. The
/// table itself has the hierarchy's order, which would help any other renderer that gets the
/// shapes.
template <class Shape>
std::vector<std::pair<core::ShapeId, core::Place>> places_by_id(const core::Table<Shape>& table) {
    std::vector<std::pair<core::ShapeId, core::Place>> places;
    places.reserve(table.size());
    for (std::uint32_t block = 0; block < table.block_count(); ++block)
        core::for_each_in_block(table, block, [&](core::Place place, core::ShapeId id) {
            places.push_back({id, place});
        });
    std::sort(places.begin(), places.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    return places;
}

} // namespace raylane::bench
