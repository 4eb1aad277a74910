#pragma once

#include "core/scene/scene.hpp"
#include "core/shapes/shapes.hpp"
#include "core/solids/solid.hpp"
#include "scenes/formats/structure/cut.hpp"
#include "scenes/formats/structure/drawing.hpp"

#include <map>
#include <span>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// The shapes of a drawing on their way into a scene. Transparent shapes of one style and opacity
/// become one solid, as a molecule has no walls inside. So do opaque shapes that planes cut, as
/// faces that coincide are slow. The faces have the colours of the atoms.
class DrawnShapes {
  public:
    /// `cuts`: the planes. `atoms_of_shape`, unless null, receives the atoms of each shape.
    DrawnShapes(core::SceneBuilder& builder, std::span<const CutPlane> cuts,
                std::vector<AtomPair>* atoms_of_shape)
        : builder_(builder), cuts_(cuts), atoms_of_shape_(atoms_of_shape) {}

    core::SceneBuilder& builder() { return builder_; }

    /// Adds a shape that planes do not cut.
    template <class Shape>
    void add_whole(const Shape& shape, core::MaterialIndex material, const AtomPair& atoms) {
        builder_.add(shape, material);
        if (atoms_of_shape_ != nullptr) atoms_of_shape_->push_back(atoms);
    }
    void add_whole(const core::Solid& solid, core::MaterialIndex material, const AtomPair& atoms) {
        builder_.add_solid(solid, material);
        if (atoms_of_shape_ != nullptr)
            atoms_of_shape_->insert(atoms_of_shape_->end(), core::count_parts(solid), atoms);
    }

    /// Adds the part of a shape that encloses a volume that the planes keep.
    template <class Shape>
    void add(const Shape& shape, core::MaterialIndex material, Style style, float opacity,
             const AtomPair& atoms) {
        const auto through = planes_through(core::bounds_of(shape), cuts_);
        if (!through) return;
        if (opacity == 1.0F && through->empty()) return add_whole(shape, material, atoms);
        parts_[opacity < 1.0F ? std::pair(style, opacity) : opaque].push_back(
            {{.shape = core::to_doubles(shape), .material = material}, !through->empty(), atoms});
    }
    /// Adds the part that the planes keep of the surface of a body that is about convex. The
    /// surface may lack the walls between the body and its neighbours.
    void add(std::span<const core::SmoothTriangle> surface, core::MaterialIndex material,
             const AtomPair& atoms);

    std::span<const CutPlane> cuts() const { return cuts_; }

    /// Moves the solids into the scene.
    void finish();

  private:
    struct Part {
        core::Solid solid;
        bool is_cut;
        AtomPair atoms;
    };
    static constexpr std::pair opaque{Style{}, 1.0F};

    core::MaterialIndex material_of_faces(const std::vector<Part>& parts);
    void add_union(std::vector<Part>& parts);

    core::SceneBuilder& builder_;
    std::span<const CutPlane> cuts_;
    std::vector<AtomPair>* atoms_of_shape_;
    std::map<std::pair<Style, float>, std::vector<Part>> parts_;
};

} // namespace raylane::scenes
