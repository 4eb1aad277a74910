#pragma once

#include "core/shapes/shape_table.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace raylane::bench {

/// Places of the shapes of a table, in the order in which they were added to the scene. The table
/// itself has them in that of the hierarchy, which would help whoever else gets them.
template <class Shape>
std::vector<std::pair<core::ShapeId, core::Place>> places_by_id(const core::Table<Shape>& table) {
    std::vector<std::pair<core::ShapeId, core::Place>> places;
    places.reserve(table.size());
    for (std::uint32_t block = 0; block < table.blocks().size(); ++block)
        for (std::uint8_t lane = 0; lane < core::block_size; ++lane)
            if (const core::ShapeId id = table.blocks()[block].ids[lane]; id != core::no_shape)
                places.push_back({id, {block, lane}});
    std::sort(places.begin(), places.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    return places;
}

} // namespace raylane::bench
