#pragma once

#include "core/hierarchy/hierarchy.hpp"
#include "core/hierarchy/packing.hpp"
#include "core/scene/auto_camera.hpp"
#include "core/scene/built_shapes.hpp"
#include "core/scene/copies.hpp"
#include "core/scene/material.hpp"
#include "core/scene/surroundings.hpp"
#include "core/shapes/invalid_value.hpp"
#include "core/shapes/material_indices.hpp"
#include "core/shapes/shape_table.hpp"
#include "core/solids/object_space.hpp"
#include "core/solids/solid_collector.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace raylane::core {

/// Returns the rank of shape `id` if each of `groups`, ascending, counted as one shape.
std::size_t rank_in_groups(std::span<const IdRange> groups, ShapeId id);

/// Returns the name of a shape for messages; empty if it is unknown.
using NameOfShape = std::function<std::string(ShapeId)>;

/// Shapes with a transmissive material: a point may be inside of them.
struct TransmissiveShapes {
    bool any = false;
    Bounds bounds; ///< of the bounded ones
    Bounds open;   ///< of those that are not solids; several together may enclose points
};

/// A validated, immutable scene. A copy shares the memory of shapes, hierarchy and material
/// indices, and has its own copy of the rest.
class Scene {
  public:
    /// Returns the shapes. If equal shapes have one material, only the first of them is stored.
    /// The tables also return shapes of copies, by place, once their blocks are made.
    const Tables& shapes() const { return shapes_; }
    /// Returns the number of shapes, including those of copies.
    std::size_t shape_count() const { return material_of_.size(); }
    /// Returns the kept copies of groups, or null.
    const Copies* copies() const { return copies_.get(); }
    /// Makes a block of a table that belongs to a copy; see Copies.
    void make_block(Kind kind, std::uint32_t block) const {
        if (copies_ != nullptr) copies_->make(kind, block);
    }
    const Hierarchy& hierarchy() const { return hierarchy_; }
    const std::vector<Material>& materials() const { return materials_; }
    const Material& material_of(ShapeId id) const { return materials_[material_of_[id]]; }
    MaterialIndex material_index_of(ShapeId id) const { return material_of_[id]; }
    /// Returns the name that a material has in its file; empty if it has none. Several materials
    /// may have one name. Images do not depend on names.
    std::string_view material_name(MaterialIndex material) const {
        return material < material_names_.size() ? std::string_view(material_names_[material]) : "";
    }
    /// Returns the material index of each shape.
    const MaterialIndices& material_indices() const { return material_of_; }
    /// Returns the compound solids, whose parts are among the shapes.
    const Solids& solids() const { return solids_; }
    /// Returns the material inside of a shape's surface. For a part of a solid, it is the material
    /// inside of the whole solid.
    MaterialIndex medium_index_of(ShapeId id) const {
        return solids_.has(id) ? solids_.medium_of(id) : material_of_[id];
    }
    /// Returns true if light that passes a surface enters or leaves a medium there. `material` is
    /// the material of the surface, `medium` that of the inside behind it. One of the two must be
    /// transmissive.
    bool bounds_medium(MaterialIndex material, MaterialIndex medium) const {
        return materials_[material].transmits() || materials_[medium].transmits();
    }
    /// The spaces of shapes that transforms moved, and whose pattern follows them, ascending by id.
    /// Excludes those of copies.
    using ObjectSpaces = std::vector<std::pair<ShapeId, std::shared_ptr<const ObjectSpace>>>;
    const ObjectSpaces& object_spaces() const { return object_spaces_; }
    /// Returns the space of a shape whose pattern follows it; none if that is the scene's.
    std::optional<ObjectSpace> object_space(ShapeId id) const;
    const TransmissiveShapes& transmissive() const { return transmissive_; }
    const std::vector<Light>& lights() const { return lights_; }
    const Fog& fog() const { return fog_; }
    const Camera& camera() const { return camera_; }
    const Color& background() const { return background_; }
    const Settings& settings() const { return settings_; }
    /// Returns the wavelengths, in nanometres. Each gets an image, with the index of glass at that
    /// wavelength. Empty: one image, with each material's index.
    const std::vector<double>& wavelengths() const { return wavelengths_; }
    /// Returns the scene as it is in light of one wavelength.
    Scene in_light_of(double wavelength) const;

    /// Returns how the camera found its position, and which lights and fog came with it.
    const AutoCamera& auto_camera() const { return auto_camera_; }
    /// Returns the number of lights that did not come with the camera; they are the first ones.
    std::size_t own_light_count() const { return own_light_count_; }
    /// Returns the same shapes with another view. Throws InvalidValue if the camera or the fog is
    /// invalid.
    Scene seen(const AutoCamera& auto_camera, const View& view) &&;
    /// Returns the same shapes with another camera. Lights and depth-cue fog that follow the camera
    /// are computed again. Throws InvalidValue if the camera is invalid.
    Scene seen_by(const Camera& camera) &&;

    /// Returns a scene whose spheres have other centres, except parts of solids: see
    /// move_spheres(), which throws InvalidValue. Lights and depth-cue fog that follow the camera
    /// are computed again; the camera keeps its position. Also throws for point lights on surfaces.
    template <class Number>
    Scene with_positions(std::span<const Number> coordinates, Workers& workers) const;

    /// Returns the shapes in one flat polygon with `id`: only `id` itself unless added by
    /// add_polygon.
    IdRange coplanar_with(ShapeId id) const;
    /// Returns the polygons of more than one triangle, ascending.
    std::span<const IdRange> polygons() const { return polygons_; }

    /// Returns the shapes that are not stored.
    const MergedShapes& merged() const { return merged_; }

    /// Returns the bytes of shapes, materials and hierarchy.
    std::size_t bytes() const;
    /// Returns the bytes of the doubles of shapes that are not floats.
    std::size_t double_bytes() const;

  private:
    friend class SceneBuilder;
    Scene() = default;
    void find_transmissive();
    /// Returns the error for a point light on the surface of a shape.
    static InvalidValue light_on(std::size_t light, const std::string& shape);

    Tables shapes_;
    MaterialIndices material_of_;   // by shape id
    std::vector<IdRange> polygons_; // of more than one triangle, ascending
    Hierarchy hierarchy_;
    MergedShapes merged_;
    bool merges_duplicates_ = true;
    Solids solids_;
    ObjectSpaces object_spaces_;
    std::vector<Material> materials_;
    std::vector<std::string> material_names_; // a prefix: the rest have none
    TransmissiveShapes transmissive_;
    std::vector<Light> lights_;
    Fog fog_;
    Camera camera_;
    Color background_{0.0F};
    Settings settings_;
    std::vector<double> wavelengths_;
    AutoCamera auto_camera_;
    std::size_t own_light_count_ = 0;
    std::shared_ptr<const Copies> copies_;
};

/// Calls visit(shape, id) for each bounded shape, with those of copies.
template <class Visit>
void for_each_bounded_shape(const Scene& scene, const Visit& visit) {
    for_each_bounded_table(scene.shapes(),
                           [&](const auto& table) { for_each_shape(table, visit); });
    if (scene.copies() == nullptr) return;
    for (const Copies::Set& set : scene.copies()->sets())
        for (std::uint32_t i = 0; i < set.copy_count; ++i) {
            const Placer placer(scene.copies()->placement(set.first_copy + i));
            const ShapeId first = Copies::first_id_of({set, i});
            for_each_bounded_table(set.prototype->shapes(), [&](const auto& table) {
                for_each_shape(table, [&](const auto& shape, ShapeId id) {
                    if constexpr (requires { placer(shape); }) visit(placer(shape), first + id);
                });
            });
        }
}

/// Collects a scene, in any order, and checks each value when it is added. All functions throw
/// InvalidValue, whose field is relative to their arguments, and then leave the builder unchanged.
class SceneBuilder {
  public:
    Camera camera;                   ///< checked by build(), field "camera/..."
    Color background{0.0F};          ///< checked by build(), field "background"
    Fog fog;                         ///< checked by build(), field "fog/..."
    Settings settings;               ///< checked by build(), field "settings/..."
    std::vector<double> wavelengths; ///< checked by build(), field "spectrum/wavelengths/..."
    /// Which of camera, fog and lights build() computes. build() throws InvalidValue, field
    /// "camera", if the scene has nothing from which a camera could find its position.
    AutoCamera auto_camera;
    bool merge_duplicates = true; ///< see Duplicates
    bool wants_light = true;      ///< true if build() refuses shapes without a light
    /// If set, build() moves each point light that is on a surface off it, to the side that the
    /// camera sees, and calls this with the light's index. By default build() refuses such lights.
    std::function<void(std::size_t)> on_light_moved;
    std::size_t pack_from = packed_from; ///< spheres from which they are packed
    std::size_t keep_from = kept_from;   ///< shapes of copies from which these are kept as copies
    Workers* workers = nullptr; ///< threads for the hierarchy; default: the caller's thread

    /// Adds a material and returns the index by which shapes refer to it.
    MaterialIndex add_material(const Material& material);
    const Material& material(MaterialIndex index) const { return scene_.materials_[index]; }
    /// Throws InvalidValue, field "material", unless add_material returned this index.
    void require_material(MaterialIndex material) const;
    /// Adds a material that stands for one that renumber_materials() puts in its place.
    MaterialIndex add_placeholder();
    /// Removes the last material, which no shape has.
    void remove_last_material() { scene_.materials_.pop_back(); }
    /// Names a material, unless it has a name.
    void name_material(MaterialIndex material, std::string_view name);
    void add_light(const Light& light);
    /// Gives each material i the index new_index[i]. The new indices must be 0, 1, 2, ... without a
    /// gap. If several materials get one index, the last of them is kept. Readers need this if a
    /// file may use a material's name before it defines the material.
    void renumber_materials(std::span<const MaterialIndex> new_index);

    /// Adds a shape, in float or in double, and returns its id: 0, 1, 2, ... `material` must be an
    /// index that add_material returned.
    template <class Shape>
    ShapeId add(const Shape& shape, MaterialIndex material);

    /// Adds triangles that tile one flat polygon; see first_off_plane() for what is flat. A ray
    /// that leaves one of them cannot hit the others, however close to a common edge it starts.
    /// Returns the first id; the others follow. The field of an error starts with the triangle's
    /// index: "1/normals/0".
    template <class AnyTriangle>
    ShapeId add_polygon(std::span<const AnyTriangle> triangles, MaterialIndex material);

    /// Adds a compound solid. Returns the id of its first part, which is also the solid's id. The
    /// ids of the other parts follow, in the order of the description. `material` applies to parts
    /// without a material and to the inside of the whole solid. By default, the inside has the
    /// material of the first part. The field of an error is that of the part, preceded by
    /// "objects/0/objects/2/", ...
    ShapeId add_solid(const Solid& solid, MaterialIndex material);

    /// Adds a member of a group: a shape, or a compound solid. All materials must be given.
    ShapeId add_member(const Solid& member);
    /// Adds all members of a group, or none. Returns the first id. The field of an error begins
    /// with "objects/2".
    ShapeId add_group(std::span<const Solid> members);

    /// Adds copies of a group, with the shapes and ids that add_group() would give to each in turn.
    /// Returns the first id. Copies are kept as such (see Copies) if they have many shapes, if all
    /// members are spheres and cylinders that let no light pass, and if the scene has no solids.
    /// Other copies become shapes. Fields of errors are those of add_group(), and
    /// "placements/2/translate/0", ...
    ShapeId add_copies(std::span<const Solid> members, std::vector<Placement> placements);
    /// Returns true if add_copies() would keep valid copies as such.
    bool keeps_copies(std::span<const Solid> members, std::span<const Placement> placements) const;

    /// Returns true if a pattern of a solid may follow it. `material`: of parts without one.
    bool may_follow(const Solid& solid, MaterialIndex material = no_material) const;

    /// Reserves memory for `count` more shapes, so that adding them copies nothing.
    void reserve(std::size_t count);

    std::size_t shape_count() const { return scene_.material_of_.size(); }

    /// Checks the scene as a whole, builds the hierarchy, and returns the scene. Fields are those
    /// above, and "lights", "lights/0/position", ... Messages name shapes by number unless
    /// `name_of_shape` returns a name.
    Scene build(const NameOfShape& name_of_shape = nullptr) &&;
    /// Returns a scene with these shapes alone, and with the camera, fog and lights that their
    /// automatic camera produced. No shape may have been added. Also throws InvalidValue for
    /// anything that check() refuses.
    Scene build(BuiltShapes shapes) &&;

  private:
    void check_as_a_whole() const;
    void build_shapes();
    /// Completes the scene once it has shapes.
    void finish(const NameOfShape& name_of_shape);
    void require_room(std::size_t count) const;
    /// Adds a valid shape.
    template <class Shape>
    ShapeId append(const Shape& shape, MaterialIndex material);
    /// Notes the space of a shape, if there is one and the shape's pattern follows it.
    void note_space(ShapeId id, MaterialIndex material,
                    const std::shared_ptr<const ObjectSpace>& space);
    bool may_follow(MaterialIndex material) const {
        return placeholders_.contains(material) ||
               scene_.materials_[material].pattern.follows_objects();
    }

    void check_wavelengths() const;
    void check_solid(const Solid& solid, bool has_material, const std::string& place) const;
    void check_member(const Solid& member) const;

    /// Copies that may be kept.
    struct KeptCopies {
        std::vector<Solid> members; // shapes
        std::vector<Placement> placements;
        ShapeId first_id;
    };
    /// Turns all copies so far into shapes.
    void give_up_copies();
    void build_copies();

    Scene scene_;
    std::set<MaterialIndex> placeholders_;
    ShapeLists lists_;
    SolidCollector solids_;
    std::vector<KeptCopies> kept_;
};

} // namespace raylane::core
