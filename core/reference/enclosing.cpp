#include "core/reference/enclosing.hpp"

#include "core/shapes/shapes.hpp"

namespace raylane::core {

namespace {

/// Returns true if a solid below a node of the hierarchy is transmissive and has bounds that meet
/// the box.
bool any_solid_meets(const Scene& scene, std::uint32_t index, const Bounds& box) {
    const auto in_block = [&]<class Shape>(const Table<Shape>& table, std::uint32_t block) {
        bool any = false;
        for_each_in_block(table, block, [&](Place place, ShapeId id) {
            // The inside of a solid is within the bounds of its parts.
            if (const Bounds* of_part = scene.solids().bounds_of(id)) {
                any = any || (scene.materials()[scene.medium_index_of(id)].transmits() &&
                              of_part->meets(box));
            } else if constexpr (is_solid<Shape>) {
                any = any ||
                      (scene.material_of(id).transmits() && bounds_of(table.get(place)).meets(box));
            }
        });
        return any;
    };
    const WideNode& node = scene.hierarchy().nodes[index];
    for (int i = 0; i < block_size; ++i) {
        if (!node.bounds(i).meets(box)) continue;
        const Child child = node.children[i];
        if (child.is_block()
                ? with_table(scene.shapes(), child.kind(),
                             [&](const auto& table) { return in_block(table, child.index()); })
                : any_solid_meets(scene, child.index(), box))
            return true;
    }
    return false;
}

} // namespace

bool may_be_in_body(const Scene& scene, const Bounds& box) {
    const TransmissiveShapes& shapes = scene.transmissive();
    return shapes.bounds.meets(box) && (shapes.open.meets(box) || any_solid_meets(scene, 0, box));
}

} // namespace raylane::core
