#pragma once

#include "core/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

/// The shapes of a scene with the numbers that its builder was given, also if equal shapes count as
/// one.
namespace raylane::core {

/// Returns a shape. For the quadrics of solids, its box is that in which it is visible. Takes time
/// in proportion to the number of shapes. `id` must be one of the scene.
PartShape given_shape(const Scene& scene, ShapeId id);

/// The shapes of one kind, except parts of solids, in the order of their ids.
template <class Shape>
struct GivenShapes {
    std::vector<ShapeId> ids;
    std::vector<InDouble<Shape>> shapes;
};

template <class Shape>
GivenShapes<Shape> given_shapes(const Scene& scene) {
    const auto& table = std::get<Table<Shape>>(scene.shapes());
    const auto& merged = scene.merged()[static_cast<std::size_t>(kind_of<Shape>)];
    const auto for_each_stored = [&](const auto& visit) {
        for (std::uint32_t block = 0; block < table.block_count(); ++block)
            for_each_in_block(table, block, [&](Place place, ShapeId id) {
                if (!scene.solids().has(id)) visit(place, id);
            });
    };
    std::vector<std::uint32_t> row_of(scene.shape_count()); // first: 1 if there is one
    for_each_stored([&](Place, ShapeId id) { row_of[id] = 1; });
    for (const MergedShape& shape : merged)
        row_of[shape.id] = 1;

    GivenShapes<Shape> given;
    for (std::size_t id = 0; id < row_of.size(); ++id)
        if (row_of[id] != 0) {
            row_of[id] = static_cast<std::uint32_t>(given.ids.size());
            given.ids.push_back(static_cast<ShapeId>(id));
        }
    given.shapes.resize(given.ids.size());
    for_each_stored([&](Place place, ShapeId id) { given.shapes[row_of[id]] = table.get(place); });
    for (const MergedShape& shape : merged)
        given.shapes[row_of[shape.id]] = given.shapes[row_of[shape.first]];
    return given;
}

} // namespace raylane::core
