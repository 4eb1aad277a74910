#include "simd/query/surface_expressions.hpp"

#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <bit>

namespace raylane::simd {

SurfaceExpressions::SurfaceExpressions(const SceneData& scene) : scene_(scene) {
    if (!scene.looks_through() || scene.has_tree() || !scene.prototypes().empty()) return;
    const core::Solids& solids = scene.scene().solids();
    for (const core::Solids::Node& from : solids.nodes()) {
        SurfaceNode node{};
        if (from.op == core::Solids::Op::part) node = shape_of(from.kind, from.place);
        if (from.op == core::Solids::Op::part && from.traced)
            describe(node);
        else
            node.slot = no_slot;
        node.is_part = true;
        node.reversed = from.reversed;
        node.end = from.end;
        node.parent = from.parent;
        node.of_all = from.op == core::Solids::Op::all;
        nodes_.push_back(node);
    }
    core::for_each_table(scene.scene().shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        for (std::uint32_t block = 0; block < table.block_count(); ++block)
            core::for_each_in_block(table, block, [&](core::Place place, core::ShapeId id) {
                if (solids.has(id)) return;
                SurfaceNode node = shape_of(core::kind_of<Shape>, place);
                describe(node);
                node.end = static_cast<std::uint32_t>(nodes_.size()) + 1;
                nodes_.push_back(node);
            });
    });
    if (nodes_.size() > SurfaceNodes::most) nodes_.clear();
}

SurfaceNode SurfaceExpressions::shape_of(core::Kind kind, core::Place place) {
    SurfaceNode node{};
    node.kind = kind;
    node.id = no_slot - 1; // no ray leaves a shape that rays do not cross
    node.slot = scene_.slot_of(kind, place);
    std::array<double, max_numbers>& numbers = numbers_.emplace_back();
    node.numbers = numbers.data();
    core::with_table(
        scene_.scene().shapes(), kind, [&]<class Shape>(const core::Table<Shape>& table) {
            const auto exact = table.get(place);
            const auto shape_numbers = std::bit_cast<core::Numbers<core::InDouble<Shape>>>(exact);
            static_assert(shape_numbers.size() <= max_numbers);
            std::copy(shape_numbers.begin(), shape_numbers.end(), numbers.begin());
        });
    return node;
}

/// Sets the properties of a shape that rays cross.
void SurfaceExpressions::describe(SurfaceNode& node) const {
    const SceneData::ShapeRecord shape = scene_.record_of(node.slot);
    const core::Material& material = scene_.scene().materials()[shape.material];
    node.id = shape.id;
    for (const bool enters : {false, true})
        node.seen[enters ? 1 : 0] = material.is_seen(enters != shape.reversed);
}

} // namespace raylane::simd
