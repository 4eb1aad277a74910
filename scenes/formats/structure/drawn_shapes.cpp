#include "scenes/formats/structure/drawn_shapes.hpp"

#include "scenes/formats/polygon.hpp"

#include <algorithm>
#include <functional>

namespace raylane::scenes {

using core::MaterialIndex;
using core::Solid;

/// Returns the material of the faces in which planes cut a union.
MaterialIndex DrawnShapes::material_of_faces(const std::vector<Part>& parts) {
    const MaterialIndex first = parts.front().solid.material;
    if (std::all_of(parts.begin(), parts.end(),
                    [&](const Part& part) { return part.solid.material == first; }))
        return first;
    core::Material material = builder_.material(first);
    material.pattern.kind = core::PatternKind::cutaway;
    const MaterialIndex index = builder_.add_material(material);
    builder_.name_material(index, "cut");
    return index;
}

/// Adds parts of one style and opacity as one solid.
void DrawnShapes::add_union(std::vector<Part>& parts) {
    Solid all{.made = core::Made::by_union};
    std::vector<AtomPair> atoms;
    const bool is_cut = std::any_of(parts.begin(), parts.end(), std::mem_fn(&Part::is_cut));
    const MaterialIndex of_faces = is_cut ? material_of_faces(parts) : core::no_material;
    for (Part& part : parts) {
        all.parts.push_back(std::move(part.solid));
        atoms.push_back(part.atoms);
    }
    if (all.parts.size() == 1) all = Solid(all.parts[0]);
    if (is_cut) {
        all.material = of_faces;
        all = cut_by(std::move(all), cuts_);
        atoms.insert(atoms.end(), cuts_.size(), no_atoms); // faces of several atoms
    }
    builder_.add_solid(all, all.material);
    if (atoms_of_shape_ != nullptr)
        atoms_of_shape_->insert(atoms_of_shape_->end(), atoms.begin(), atoms.end());
}

void DrawnShapes::add(std::span<const core::SmoothTriangle> surface, MaterialIndex material,
                      const AtomPair& atoms) {
    core::Bounds bounds;
    for (const core::SmoothTriangle& triangle : surface)
        bounds.include(core::bounds_of(triangle));
    const auto through = planes_through(bounds, cuts_);
    if (!through) return;
    const auto add_all = [&](std::span<const core::SmoothTriangle> triangles) {
        for (const core::SmoothTriangle& triangle : triangles)
            add_whole(triangle, material, atoms);
    };
    if (through->empty()) return add_all(surface);
    std::vector<Polygon> body;
    for (const core::SmoothTriangle& triangle : surface)
        body.push_back(polygon_of(triangle));
    for (const CutPlane& plane : *through)
        body = clipped(body, plane.normal, plane.offset);
    add_all(smooth_triangles_of(body));
}

void DrawnShapes::finish() {
    for (auto& [key, parts] : parts_)
        add_union(parts);
    parts_.clear();
}

} // namespace raylane::scenes
