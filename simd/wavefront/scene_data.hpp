#pragma once

#include "core/features.hpp"
#include "core/scene.hpp"
#include "simd/shade_kernels.hpp"
#include "simd/trace_kernels.hpp"

#include <vector>

namespace raylane::simd {

/// What the kernels need of a scene, in their terms. The scene must outlive it.
class SceneData {
  public:
    explicit SceneData(const core::Scene& scene);

    const core::Scene& scene() const { return scene_; }
    const SceneView& view() const { return view_; }
    const std::vector<MaterialView>& materials() const { return materials_; }
    const std::vector<LightView>& lights() const { return lights_; }
    const FogView& fog() const { return fog_; }

    /// The kinds that are tested one by one: all in a scene of a few shapes, else the planes.
    std::uint32_t listed_kinds() const { return listed_kinds_; }
    /// Whether the others are found by way of the hierarchy.
    bool has_tree() const { return has_tree_; }
    /// Levels of nodes.
    int tree_depth() const { return tree_depth_; }
    /// Whether some surface is visible from one side only.
    bool one_sided() const { return one_sided_; }
    bool smooth() const { return smooth_; }

    /// Of the shape in a slot.
    core::ShapeId id_of(std::uint32_t slot) const { return get(&Occupant::id, slot); }
    core::IdRange coplanar_with(std::uint32_t slot) const { return get(&Occupant::coplanar, slot); }
    core::MaterialIndex material_of(std::uint32_t slot) const {
        return get(&Occupant::material, slot);
    }
    core::Kind kind_of(std::uint32_t slot) const { return get(&Occupant::kind, slot); }
    core::Slot place_of(std::uint32_t slot) const;
    std::uint32_t slot_of(core::Kind kind, core::Slot place) const;

  private:
    struct Occupant {
        core::ShapeId id;
        core::IdRange coplanar;
        core::MaterialIndex material;
        core::Kind kind;
    };
    Occupant find_occupant(std::uint32_t slot) const;
    template <class Field>
    Field get(Field Occupant::*member, std::uint32_t slot) const {
        if (occupants_.empty()) [[unlikely]]
            return find_occupant(slot).*member;
        return occupants_[slot].*member;
    }

    const core::Scene& scene_;
    SceneView view_{};
    std::vector<Occupant> occupants_; // by slot, in scenes that are not large
    std::vector<std::uint16_t> plain_lanes_;
    std::vector<MaterialView> materials_;
    std::vector<LightView> lights_;
    FogView fog_{};
    std::uint32_t listed_kinds_ = 0;
    bool has_tree_ = false;
    bool one_sided_ = false;
    bool smooth_ = false;
    int tree_depth_ = 0;
};

} // namespace raylane::simd
