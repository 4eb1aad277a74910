#pragma once

#include "core/hierarchy/hierarchy.hpp"
#include "core/hierarchy/packing.hpp"
#include "core/scene/built_shapes.hpp"
#include "core/scene/material.hpp"
#include "core/scene/staging.hpp"
#include "core/scene/surroundings.hpp"
#include "core/shapes/invalid_value.hpp"
#include "core/shapes/material_indices.hpp"
#include "core/shapes/shape_table.hpp"
#include "core/solids/solid_collector.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::core {

/// Rank of shape `id` if `groups`, ascending, were one shape each.
std::size_t rank_in_groups(std::span<const IdRange> groups, ShapeId id);

/// Name of a shape in messages; empty where that is unknown.
using NameOfShape = std::function<std::string(ShapeId)>;

/// Shapes whose material is transmissive: those that a point may be inside of.
struct TransmissiveShapes {
    bool any = false;
    bool any_unbounded = false;
    Bounds bounds; ///< of those that have any
    Bounds open;   ///< of those that are no solids: several together may have an inside
};

/// A validated scene that no longer changes. A copy has the same memory of shapes, of their
/// hierarchy and of their materials' indices, and all else for itself.
class Scene {
  public:
    /// Shapes; of those that are the same, of one material, the first alone.
    const Tables& shapes() const { return shapes_; }
    std::size_t shape_count() const { return material_of_.size(); }
    const Hierarchy& hierarchy() const { return hierarchy_; }
    const std::vector<Material>& materials() const { return materials_; }
    const Material& material_of(ShapeId id) const { return materials_[material_of_[id]]; }
    MaterialIndex material_index_of(ShapeId id) const { return material_of_[id]; }
    /// Returns the name that a material has in its file; empty if it has none. Several materials
    /// may have one name. No picture depends on names.
    std::string_view material_name(MaterialIndex material) const {
        return material < material_names_.size() ? std::string_view(material_names_[material]) : "";
    }
    /// Of all shapes.
    const MaterialIndices& material_indices() const { return material_of_; }
    /// Those that are made of others, whose parts are among the shapes.
    const Solids& solids() const { return solids_; }
    /// The material that is inside of a shape's surface: of a solid's parts, the whole's.
    MaterialIndex medium_index_of(ShapeId id) const {
        return solids_.has(id) ? solids_.medium_of(id) : material_of_[id];
    }
    /// True of surfaces behind which another medium begins, if light passes them at all.
    bool bounds_medium(MaterialIndex material, MaterialIndex medium) const {
        return materials_[material].transmits() || materials_[medium].transmits();
    }
    const TransmissiveShapes& transmissive() const { return transmissive_; }
    const std::vector<Light>& lights() const { return lights_; }
    const Fog& fog() const { return fog_; }
    const Camera& camera() const { return camera_; }
    const Color& background() const { return background_; }
    const Settings& settings() const { return settings_; }
    /// Wavelengths in nanometres for each of which a picture is drawn, with the index that glass
    /// has for it; none: with that of each material.
    const std::vector<double>& wavelengths() const { return wavelengths_; }
    /// The scene in light of one wavelength.
    Scene in_light_of(double wavelength) const;

    /// How its camera found its place, and what came along.
    const Staging& staging() const { return staging_; }
    /// Lights that did not come with the camera: so many of the first.
    std::size_t own_light_count() const { return own_light_count_; }
    /// The same shapes, seen otherwise. Throws InvalidValue for a camera or fog that is none.
    Scene seen(const Staging& staging, const View& view) &&;

    /// The shapes that lie in one flat polygon with `id`: itself alone unless added by add_polygon.
    IdRange coplanar_with(ShapeId id) const;
    /// The polygons of more than one triangle, ascending.
    std::span<const IdRange> polygons() const { return polygons_; }

    /// Bytes of shapes, materials and hierarchy.
    std::size_t bytes() const;
    /// Those of shapes' doubles, where they are no floats.
    std::size_t double_bytes() const;

  private:
    friend class SceneBuilder;
    Scene() = default;
    void find_transmissive();

    Tables shapes_;
    MaterialIndices material_of_;   // by shape id
    std::vector<IdRange> polygons_; // of more than one triangle, ascending
    Hierarchy hierarchy_;
    Solids solids_;
    std::vector<Material> materials_;
    std::vector<std::string> material_names_; // of the first materials
    TransmissiveShapes transmissive_;
    std::vector<Light> lights_;
    Fog fog_;
    Camera camera_;
    Color background_{0.0F};
    Settings settings_;
    std::vector<double> wavelengths_;
    Staging staging_;
    std::size_t own_light_count_ = 0;
};

/// Collects a scene, in any order, and checks each value as it comes. All functions throw
/// InvalidValue, whose field is relative to what was passed in, and leave the builder as it was.
class SceneBuilder {
  public:
    Camera camera;                   ///< checked by build(), field "camera/..."
    Color background{0.0F};          ///< checked by build(), field "background"
    Fog fog;                         ///< checked by build(), field "fog/..."
    Settings settings;               ///< checked by build(), field "settings/..."
    std::vector<double> wavelengths; ///< checked by build(), field "spectrum/wavelengths/..."
    /// What of camera, fog and lights build() finds by itself. Throws InvalidValue, field "camera",
    /// if there is nothing that a camera could find its place by.
    Staging staging;
    bool wants_light = true; ///< true if build() refuses shapes without a light
    /// If set, build() moves each point light that is on a surface off it, to the side that the
    /// camera sees, and calls this with the light's number. By default it refuses such lights.
    std::function<void(std::size_t)> on_light_moved;
    std::size_t pack_from = packed_from; ///< so many spheres: they take less memory then
    Workers* workers = nullptr;          ///< that build the hierarchy; default: the caller's thread

    /// The index by which shapes refer to it.
    MaterialIndex add_material(const Material& material);
    /// Names a material, unless it has a name.
    void name_material(MaterialIndex material, std::string_view name);
    void add_light(const Light& light);
    /// Gives material i the index new_index[i], for all of them: 0, 1, 2, ... without a gap. Of
    /// several that become one, the last counts. For readers that meet a material's name before the
    /// material.
    void renumber_materials(std::span<const MaterialIndex> new_index);

    /// The id of the new shape, in float or in double: 0, 1, 2, ... `material` must be an index
    /// that add_material returned.
    template <class Shape>
    ShapeId add(const Shape& shape, MaterialIndex material);

    /// Triangles that tile one flat polygon. A ray that leaves one of them can hit none of the
    /// others, however close to a common edge it starts. Returns the first id; the others follow.
    /// Fields of a triangle are behind its number: "1/normals/0".
    template <class AnyTriangle>
    ShapeId add_polygon(std::span<const AnyTriangle> triangles, MaterialIndex material);

    /// A solid that is made of others: the id of its first part, which is its own as well; the ids
    /// of the others follow, in the order of its description. `material`: of what has none of its
    /// own, and inside of the whole; without, that is its first part's. Fields are those of shapes
    /// behind "objects/0/objects/2/", ...
    ShapeId add_solid(const Solid& solid, MaterialIndex material);

    /// Makes room for `count` more shapes, so that adding them copies nothing.
    void reserve(std::size_t count);

    std::size_t shape_count() const { return scene_.material_of_.size(); }

    /// Checks what concerns the scene as a whole, builds the hierarchy, and hands the scene over.
    /// Fields are those above, and "lights", "lights/0/position", ... Shapes are named by number
    /// unless `name_of_shape` knows better.
    Scene build(const NameOfShape& name_of_shape = nullptr) &&;
    /// The same with these shapes alone, none having been added, and with the camera, fog and
    /// lights that came of their staging. Throws InvalidValue, too, for what check() refuses.
    Scene build(BuiltShapes shapes) &&;

  private:
    void check_as_a_whole() const;
    void build_shapes();
    /// What is left to do once there are shapes.
    void finish(const NameOfShape& name_of_shape);
    void require_material(MaterialIndex material) const;
    void require_room(std::size_t count) const;
    /// The part of add() that is left for a valid shape.
    template <class Shape>
    ShapeId append(const Shape& shape, MaterialIndex material);

    void check_wavelengths() const;
    void check_solid(const Solid& solid, bool has_material, const std::string& place) const;

    Scene scene_;
    ShapeLists lists_;
    SolidCollector solids_;
};

} // namespace raylane::core
