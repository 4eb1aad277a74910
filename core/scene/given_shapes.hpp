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
GivenShapes<Shape> given_shapes(const Scene& scene);

/// Returns those that are not in copies.
template <class Shape>
GivenShapes<Shape> given_beside_copies(const Scene& scene) {
    const MaterialIndices& materials = scene.material_indices();
    const auto& table = std::get<Table<Shape>>(scene.shapes());
    const auto& merged = scene.merged()[static_cast<std::size_t>(kind_of<Shape>)];
    const auto for_each_stored = [&](const auto& visit) {
        for (std::uint32_t block = 0; block < table.block_count(); ++block)
            for_each_in_block(table, block, [&](Place place, ShapeId id) {
                if (!scene.solids().has(id)) visit(place, id);
            });
    };
    std::vector<ShapeId> row_of(materials.stored_count(), no_shape); // first: the id
    const auto row = [&](ShapeId id) -> ShapeId& { return row_of[materials.stored_index(id)]; };
    for_each_stored([&](Place, ShapeId id) { row(id) = id; });
    for (const MergedShape& shape : merged)
        row(shape.id) = shape.id;

    GivenShapes<Shape> given;
    for (ShapeId& entry : row_of)
        if (entry != no_shape) {
            given.ids.push_back(entry);
            entry = static_cast<ShapeId>(given.ids.size() - 1);
        }
    const auto shape_of = [&](ShapeId id) -> InDouble<Shape>& { return given.shapes[row(id)]; };
    given.shapes.resize(given.ids.size());
    for_each_stored([&](Place place, ShapeId id) { shape_of(id) = table.get(place); });
    for (const MergedShape& shape : merged)
        shape_of(shape.id) = shape_of(shape.first);
    return given;
}

template <class Shape>
GivenShapes<Shape> given_shapes(const Scene& scene) {
    GivenShapes<Shape> beside = given_beside_copies<Shape>(scene), all;
    if (scene.copies() == nullptr) return beside;
    std::size_t next = 0; // of those beside copies
    const auto add_until = [&](std::size_t end) {
        for (; next < beside.ids.size() && beside.ids[next] < end; ++next) {
            all.ids.push_back(beside.ids[next]);
            all.shapes.push_back(beside.shapes[next]);
        }
    };
    for (const Copies::Set& set : scene.copies()->sets()) {
        const GivenShapes<Shape> of_one = given_shapes<Shape>(*set.prototype);
        add_until(set.first_id);
        for (std::uint32_t copy = 0; copy < set.copy_count; ++copy) {
            const Placer placer(scene.copies()->placement(set.first_copy + copy));
            const ShapeId first = Copies::first_id_of({set, copy});
            for (std::size_t i = 0; i < of_one.ids.size(); ++i)
                if constexpr (requires { placer(of_one.shapes[i]); }) {
                    all.ids.push_back(first + of_one.ids[i]);
                    all.shapes.push_back(placer(of_one.shapes[i]));
                }
        }
    }
    add_until(scene.shape_count());
    return all;
}

} // namespace raylane::core
