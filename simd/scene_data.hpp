#pragma once

#include "core/optics/media.hpp"
#include "core/scene/scene.hpp"
#include "simd/cuts.hpp"
#include "simd/kernels.hpp"
#include "simd/shade_kernels.hpp"
#include "simd/trace_kernels.hpp"

#include <limits>
#include <vector>

namespace raylane::simd {

/// Transmissive surfaces in the way of a ray that asks what it is blocked by.
enum class Transmissive : std::uint8_t {
    lets_through, ///< pictures: light may pass them
    blocks,       ///< the library: any surface does
};

/// Data that the kernels need of a scene, in their terms. The scene must outlive it.
class SceneData {
  public:
    explicit SceneData(const core::Scene& scene,
                       Transmissive transmissive = Transmissive::lets_through);

    const core::Scene& scene() const { return scene_; }
    const SceneView& view() const { return view_; }
    /// Those of the scene, and one more of which nothing is seen but what is behind it.
    const std::vector<MaterialView>& materials() const { return materials_; }
    /// Those without a size.
    const std::vector<LightView>& lights() const { return lights_; }
    const std::vector<core::SoftLight>& soft_lights() const { return soft_lights_; }
    const FogView& fog() const { return fog_; }

    /// The kinds that are tested one by one: all in a scene of a few shapes, else the unbounded.
    std::uint32_t listed_kinds() const {
        return unbounded_kinds_ | (has_tree() ? 0 : bounded_kinds_);
    }
    /// True if the others are found by way of the hierarchy.
    bool has_tree() const { return view_.tree_depth != 0; }
    /// Number of rays without coherence that are best asked at a time what is nearest to them,
    /// exactly: where that makes lists, these should be long; else what belongs to the rays should
    /// be in the cache.
    std::size_t best_ray_count() const { return has_tree() && !view_.large ? 2 * long_list : 1024; }
    /// True if a packet's rays that are no neighbours in one of two directions cost more than to
    /// put them in another order.
    bool best_in_tiles() const { return has_tree() && slots_ >= 8192; }
    /// True if some crossings are none of a surface that is seen: of those that are visible from
    /// one side only, and of parts within solids.
    bool looks_through() const { return one_sided_ || scene_.solids().any(); }
    /// See Cuts::cuts.
    bool is_cut(core::Solids::Index of_many) const { return cuts_.cuts(of_many); }
    /// See Cuts::cut_by.
    const CutUnion* cut_by(core::ShapeId id) const {
        return cuts_.cut_by(scene_.solids().part_of(id));
    }
    /// See SceneView::only_cut_lanes.
    bool only_cuts(std::uint32_t slot) const {
        return view_.only_cut_lanes != nullptr &&
               (view_.only_cut_lanes[slot / 16] >> slot % 16 & 1) != 0;
    }
    bool smooth() const { return smooth_; }
    /// Of a sphere around all that is in the tree; without one it is infinite.
    float radius() const { return radius_; }

    /// Medium that a ray is inside of; core::no_medium is empty space.
    struct Medium {
        double inside; ///< 1, in empty space 0
        double index;
        double absorption[3];
    };
    const Medium& medium(core::MaterialIndex material) const {
        static_assert(core::MaterialIndex(core::no_medium + 1) == 0);
        return media_[core::MaterialIndex(material + 1)];
    }

    /// The shape in a slot.
    struct Occupant {
        core::ShapeId id;
        core::IdRange coplanar;
        core::MaterialIndex material;
        core::Kind kind;
        bool reversed;              ///< a part of a solid by what is outside of it
        core::MaterialIndex medium; ///< the material inside
        bool flat;                  ///< a plane, whatever its kind

        bool may_be_met_again(bool inward) const {
            return !flat && core::may_meet_again(kind, inward);
        }
        /// True if a hit with these bits goes to the inside of it or, reversed, of its solid.
        bool is_entered(std::uint32_t hit) const { return ((hit & hit_entering) != 0) != reversed; }
    };
    Occupant occupant_of(std::uint32_t slot) const {
        if (occupants_.empty()) [[unlikely]]
            return find_occupant(slot);
        return occupants_[slot];
    }
    /// What is known of a shape by its id, and the slot where it is: cheap however many there are.
    struct NamedShape {
        core::IdRange coplanar;
        core::Kind kind;
        bool flat;

        bool may_be_met_again(bool inward) const {
            return !flat && core::may_meet_again(kind, inward);
        }
    };
    NamedShape shape_named(core::ShapeId id, std::uint32_t slot) const {
        return {scene_.coplanar_with(id), kind_of(slot), is_flat_part(id)};
    }
    bool is_flat_part(core::ShapeId id) const {
        const core::Solids::Index part = scene_.solids().part_of(id);
        return part != core::Solids::none && scene_.solids().node(part).flat;
    }
    /// The solid that a shape is a part of; core::no_shape if of none.
    core::ShapeId solid_with(core::ShapeId id) const {
        return scene_.solids().has(id) ? scene_.solids().solid_of(id) : core::no_shape;
    }
    core::ShapeId id_of(std::uint32_t slot) const { return occupant_of(slot).id; }
    core::Place place_of(std::uint32_t slot) const;
    std::uint32_t slot_of(core::Kind kind, core::Place place) const;
    /// Slots of all shapes, by id; no_slot of what is there twice, but for the first.
    std::vector<std::uint32_t> slots_by_id() const;

  private:
    void view_surroundings();
    void view_tables();
    void fill_occupants();
    void view_hierarchy();
    bool may_see_inside(core::Solids::Index solid) const;
    bool is_apart(core::Solids::Index solid) const;
    void find_plain_lanes(Transmissive transmissive);
    core::Kind kind_of(std::uint32_t slot) const {
        int kind = core::kind_count - 1;
        while (slot < view_.tables[kind].first_slot)
            --kind;
        return static_cast<core::Kind>(kind);
    }
    Occupant find_occupant(std::uint32_t slot) const;

    const core::Scene& scene_;
    SceneView view_{};
    std::vector<Occupant> occupants_; // by slot, in scenes that are not large
    std::vector<std::uint16_t> plain_lanes_;
    Cuts cuts_;
    std::vector<std::uint64_t> orders_;
    std::vector<MaterialView> materials_;
    std::vector<Medium> media_; // empty space, then what each material is inside
    std::vector<LightView> lights_;
    std::vector<core::SoftLight> soft_lights_;
    FogView fog_{};
    std::uint32_t slots_ = 0;
    std::uint32_t bounded_kinds_ = 0, unbounded_kinds_ = 0; // that there are, as bits
    bool one_sided_ = false;
    bool smooth_ = false;
    float radius_ = std::numeric_limits<float>::infinity();
};

} // namespace raylane::simd
