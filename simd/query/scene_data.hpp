#pragma once

#include "core/optics/media.hpp"
#include "core/scene/scene.hpp"
#include "simd/query/clip_planes.hpp"
#include "simd/units/kernels.hpp"
#include "simd/units/shade_kernels.hpp"
#include "simd/units/trace_kernels.hpp"

#include <limits>
#include <memory>
#include <vector>

namespace raylane::simd {

/// Effect of transmissive surfaces on occlusion queries.
enum class Transmissive : std::uint8_t {
    lets_through, ///< images: light may pass them
    is_skipped,   ///< images without shadows of transparent and transmissive shapes
    blocks,       ///< the library: they block like any surface
};

/// Data of a scene in the kernels' format. The scene must outlive it.
class SceneData {
  public:
    explicit SceneData(const core::Scene& scene,
                       Transmissive transmissive = Transmissive::lets_through);

    const core::Scene& scene() const { return scene_; }
    const SceneView& view() const { return view_; }
    /// Returns the view with the shapes of copies in its tables, for all that reads shapes by their
    /// slots. A search finds copies through copies().
    const SceneView& view_with_copies() const {
        return prototypes_.empty() ? view_ : view_with_copies_;
    }
    /// Returns the data of the prototypes of the scene's copies, one for each of Copies::sets().
    const std::vector<std::unique_ptr<const SceneData>>& prototypes() const { return prototypes_; }
    /// The scene's materials, followed by an invisible one of opacity 0.
    const std::vector<MaterialView>& materials() const { return materials_; }
    /// Lights without a size.
    const std::vector<LightView>& lights() const { return lights_; }
    const std::vector<core::SoftLight>& soft_lights() const { return soft_lights_; }
    const FogView& fog() const { return fog_; }

    /// Returns the kinds whose shapes are tested one by one: all kinds in a scene of few shapes,
    /// otherwise the unbounded ones.
    std::uint32_t listed_kinds() const {
        return unbounded_kinds_ | (has_tree() ? 0 : bounded_kinds_);
    }
    /// Returns true if the other kinds are found through the hierarchy.
    bool has_tree() const { return view_.tree_depth != 0; }
    /// Returns the best number of rays for one exact search for nearest hits, if the rays are
    /// incoherent. Where the search makes lists, these should be long; otherwise the rays' data
    /// should stay in the cache.
    std::size_t best_ray_count() const { return has_tree() && !is_large() ? 2 * long_list : 1024; }
    /// Returns true if nodes and shapes do not fit in the cache of a core.
    bool is_large() const { return view_.large; }
    /// Returns true if it costs less to reorder rays than to trace packets of rays that are not
    /// neighbours in both directions.
    bool best_in_tiles() const { return (has_tree() && slots_ >= 8192) || !prototypes_.empty(); }
    /// Returns true if some crossings are not on a visible surface: those with surfaces that are
    /// visible from one side only, and with parts within solids.
    bool looks_through() const { return one_sided_ || scene_.solids().any(); }
    /// See ClipPlanes::cuts.
    bool is_cut(core::Solids::Index of_many) const { return clip_planes_.cuts(of_many); }
    /// See ClipPlanes::cut_by.
    const CutUnion* cut_by(core::ShapeId id) const {
        return clip_planes_.cut_by(scene_.solids().part_of(id));
    }
    /// Returns true for shapes that occlusion queries skip: those that only cut
    /// (SceneView::only_cut_lanes), and with Transmissive::is_skipped those that light passes.
    bool only_cuts(std::uint32_t slot) const {
        return view_.only_cut_lanes != nullptr &&
               (view_.only_cut_lanes[slot / 16] >> slot % 16 & 1) != 0;
    }
    bool smooth() const { return smooth_; }
    /// Returns the radius of the sphere around the bounding box of all shapes in the tree; infinite
    /// without a tree.
    float radius() const { return radius_; }

    /// The medium that a ray is inside of; core::no_medium is empty space.
    struct Medium {
        double inside; ///< 1; 0 in empty space
        double index;
        double absorption[3];
    };
    const Medium& medium(core::MaterialIndex material) const {
        static_assert(core::MaterialIndex(core::no_medium + 1) == 0);
        return media_[core::MaterialIndex(material + 1)];
    }

    /// The shape in a slot.
    struct ShapeRecord {
        core::ShapeId id;
        core::IdRange coplanar;
        core::MaterialIndex material;
        core::Kind kind;
        bool reversed;              ///< a part of a solid, of which the outside counts
        core::MaterialIndex medium; ///< the material inside
        bool flat;                  ///< a plane, whatever its kind

        bool may_be_met_again(bool inward) const {
            return !flat && core::may_meet_again(kind, inward);
        }
        /// Returns true if a hit with these bits enters the shape or, if it is reversed, its solid.
        bool is_entered(std::uint32_t hit) const { return ((hit & hit_entering) != 0) != reversed; }
    };
    ShapeRecord record_of(std::uint32_t slot) const {
        if (records_.empty()) [[unlikely]]
            return find_record(slot);
        return records_[slot];
    }
    /// Properties of a shape by its id and slot. Cheap for any number of shapes.
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
    /// Returns the solid that a shape is a part of, or core::no_shape if it is not a part.
    core::ShapeId solid_with(core::ShapeId id) const {
        return scene_.solids().has(id) ? scene_.solids().solid_of(id) : core::no_shape;
    }
    core::ShapeId id_of(std::uint32_t slot) const { return record_of(slot).id; }
    core::Place place_of(std::uint32_t slot) const;
    std::uint32_t slot_of(core::Kind kind, core::Place place) const;
    /// Returns the slots of all shapes but those of copies, in the order of ids. Duplicates other
    /// than the first have no_slot.
    core::BigArray<std::uint32_t> slots_by_id() const;
    /// Returns the slot of a shape of a copy, from that in the prototype, and makes its block.
    std::uint32_t slot_in_copy(const core::Copies::Copy& copy, std::uint32_t slot) const;

  private:
    void view_surroundings();
    void view_tables();
    void fill_records();
    void view_hierarchy();
    void view_copies(Transmissive transmissive);
    bool may_see_inside(core::Solids::Index solid) const;
    bool is_apart(core::Solids::Index solid) const;
    void find_plain_lanes(Transmissive transmissive);
    void skip_passed_lanes();
    template <class IsSought>
    std::vector<std::uint16_t> lanes_with(const IsSought& is_sought) const;
    core::Kind kind_of(std::uint32_t slot) const {
        int kind = core::kind_count - 1;
        while (slot < view_.tables[kind].first_slot)
            --kind;
        return static_cast<core::Kind>(kind);
    }
    ShapeRecord find_record(std::uint32_t slot) const;

    const core::Scene& scene_;
    SceneView view_{}, view_with_copies_{};
    std::vector<std::unique_ptr<const SceneData>> prototypes_;
    std::vector<ShapeRecord> records_; // by slot; empty in large scenes
    std::vector<std::uint16_t> plain_lanes_, skipped_lanes_;
    ClipPlanes clip_planes_;
    std::vector<std::uint64_t> orders_;
    std::vector<MaterialView> materials_;
    std::vector<Medium> media_; // empty space, then the inside of each material
    std::vector<LightView> lights_;
    std::vector<core::SoftLight> soft_lights_;
    FogView fog_{};
    std::uint32_t slots_ = 0;
    std::uint32_t bounded_kinds_ = 0, unbounded_kinds_ = 0; // in the scene, as bits
    bool one_sided_ = false;
    bool smooth_ = false;
    float radius_ = std::numeric_limits<float>::infinity();
};

} // namespace raylane::simd
