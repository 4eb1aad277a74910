#include "core/scene/given_shapes.hpp"

#include "core/scene/solid_description.hpp"

#include <algorithm>

namespace raylane::core {

PartShape given_shape(const Scene& scene, ShapeId id) {
    const Solids& solids = scene.solids();
    if (scene.material_indices().stored_index(id) == MaterialIndices::no_index) {
        const Copies::Copy copy = scene.copies()->copy_with(id);
        const Placer placer(scene.copies()->placement(copy.set.first_copy + copy.number));
        return std::visit(
            [&](const auto& shape) -> PartShape {
                if constexpr (requires { placer(shape); }) return placer(shape);
                return shape;
            },
            given_shape(*copy.set.prototype, id - Copies::first_id_of(copy)));
    }
    if (solids.has(id)) return shape_of_part(scene, solids.node(solids.part_of(id)));
    PartShape shape;
    for_each_table(scene.shapes(), [&]<class Shape>(const Table<Shape>& table) {
        const auto& merged = scene.merged()[static_cast<std::size_t>(kind_of<Shape>)];
        const auto found = std::ranges::lower_bound(merged, id, {}, &MergedShape::id);
        const ShapeId stored = found != merged.end() && found->id == id ? found->first : id;
        for (std::uint32_t block = 0; block < table.block_count(); ++block)
            for_each_in_block(table, block, [&](Place place, ShapeId listed) {
                if (listed == stored) shape = table.get(place);
            });
    });
    return shape;
}

} // namespace raylane::core
