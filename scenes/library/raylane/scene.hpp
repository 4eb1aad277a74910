#pragma once

#include "raylane/api.h"
#include "raylane/material.hpp"
#include "raylane/shapes.hpp"
#include "raylane/solid.hpp"
#include "raylane/surroundings.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::core {
class Scene;
class SceneBuilder;
} // namespace raylane::core
namespace raylane::library {
struct Internals;
}

namespace RAYLANE_API raylane {

/// An axis-aligned box, closed. Empty if lower > upper.
struct Bounds {
    Vec3 lower, upper;
};

/// A validated scene that never changes. Cheap to copy: the copies are one scene, which lives as
/// long as any of them, or a Tracer of it. May be read by any number of threads at a time.
class Scene {
  public:
    std::size_t shape_count() const;
    std::size_t material_count() const;
    /// Of all shapes but planes, which have none. Contains all of each, and is larger by no more
    /// than roundings; of a quadric, its box. Without such shapes it is empty: infinity to
    /// -infinity.
    Bounds bounds() const;
    /// Throws InvalidValue for an id that is no shape's.
    MaterialIndex material_of(ShapeId shape) const;
    /// The id by which the solid goes that a shape is a part of: that of its first part. Of others
    /// their own. Throws InvalidValue for an id that is no shape's.
    ShapeId solid_of(ShapeId shape) const;
    /// Throws InvalidValue for an index that is no material's.
    Material material(MaterialIndex index) const;
    std::vector<Light> lights() const;
    Fog fog() const;
    Camera camera() const;
    Color background() const;
    Settings settings() const;
    /// The same shapes, seen by another camera, which brings the lights along that the scene's own
    /// has brought. Takes little memory and time: of a scene whose camera has found its place by
    /// itself, one look at all shapes. Throws InvalidValue, fields "camera/...".
    Scene seen_by(const Camera& camera) const;
    /// A camera in perspective that looks in a direction, of any length but zero, and sees all
    /// shapes that have bounds as large as that may be, in a picture of so many times its height as
    /// width. Throws InvalidValue where there are none, or for values that are none.
    Camera camera_on_all(const Vec3& direction = {0.0F, 0.0F, -1.0F}, float aspect = 1.0F) const;

    // Without a move, no scene is ever empty.
    Scene(const Scene&) = default;
    Scene& operator=(const Scene&) = default;
    ~Scene() = default;

  private:
    friend struct library::Internals;
    explicit Scene(std::shared_ptr<const core::Scene> scene);

    std::shared_ptr<const core::Scene> scene_;
};

/// Collects a scene, in any order, and checks each value as it comes. All functions throw
/// InvalidValue, whose field is relative to what was passed in, and leave the builder as it was;
/// and std::bad_alloc. To be used by one thread at a time. One that was moved from is as new.
class SceneBuilder {
  public:
    Camera camera; ///< checked by build(), field "camera/..."
    Color
        background; ///< colour of rays that hit nothing; checked by build(), field "background/..."
    Fog fog;        ///< checked by build(), field "fog/..."
    Settings settings; ///< checked by build(), field "settings/..."
    /// In nanometres, from 380 to 780, at most 64: a picture is drawn for each, with the index that
    /// glass has for it; none: one with `index`. Checked by build(), "spectrum/wavelengths/0".
    std::vector<double> wavelengths;

    SceneBuilder();
    ~SceneBuilder();
    SceneBuilder(SceneBuilder&& other) noexcept;
    SceneBuilder& operator=(SceneBuilder&& other) noexcept;

    /// The index by which shapes refer to it.
    MaterialIndex add_material(const Material& material);
    void add_light(const Light& light);

    /// The id of the new shape: 0, 1, 2, ... `material` is an index that add_material returned.
    template <AnyShape Shape>
    ShapeId add(const Shape& shape, MaterialIndex material);

    /// A solid that is made of others: the id of its first part; those of the others follow, in the
    /// order in which they were given. What a solid is clipped by has no surface, and no id.
    /// `material`: of parts that have none of their own, and of
    /// what is inside of all. Fields of what is thrown are those of its shapes behind
    /// "objects/0/objects/2/", ... Throws InvalidValue where quadrics leave it without bounds.
    ShapeId add(const Solid& solid, MaterialIndex material);

    /// One or more triangles that tile one flat polygon: no reflection or shadow of one of them
    /// falls on another. Returns the first id; the others follow. Fields of a triangle are behind
    /// its number: "1/normals/0".
    ShapeId add_polygon(std::span<const Triangle> triangles, MaterialIndex material);
    ShapeId add_polygon(std::span<const SmoothTriangle> triangles, MaterialIndex material);
    ShapeId add_polygon(std::span<const TriangleOf<double>> triangles, MaterialIndex material);
    ShapeId add_polygon(std::span<const SmoothTriangleOf<double>> triangles,
                        MaterialIndex material);

    std::size_t shape_count() const;

    /// Checks what concerns the scene as a whole (fields are those above, and
    /// "lights/0/position", ...), builds the hierarchy, and hands the scene over. The builder is
    /// new then, whether this succeeds or throws, unless the field is "RAYLANE_THREADS": it has
    /// threads, as many as that says in the environment. A scene without lights shows ambient
    /// terms, reflections and refractions alone.
    Scene build();

  private:
    template <class CoreShape, class Shape>
    ShapeId add_polygon_as(std::span<const Shape> triangles, MaterialIndex material);

    core::SceneBuilder& builder();

    std::unique_ptr<core::SceneBuilder> builder_; // none as long as it is new
};

/// Told of what a file says and the scene does not have, and of a scene without objects, one line
/// each, on the caller's thread.
using OnRemark = std::function<void(const std::string& remark)>;

/// Reads a scene from a file: JSON (scenes/raylane-scene.schema.json describes it), NFF, POV-Ray's
/// language or Tachyon's, or what save() has made; or atoms, of which it makes one: PDB, mmCIF,
/// CIF, XYZ, GRO, LAMMPS' dump or data. The format follows its ending or else its content; "-" is a
/// file of that name. What the file includes is read as well. Throws BadInput for what is
/// malformed, in JSON for up to ten mistakes at once, or not there, SystemRefused, std::bad_alloc,
/// and InvalidValue, field "RAYLANE_THREADS", where that is no number of threads.
RAYLANE_API Scene load(const std::filesystem::path& path, const OnRemark& on_remark = {});

/// The same for a scene in memory. `name` is what messages call it, and where included files are
/// looked for; the format follows its ending, or else the content.
RAYLANE_API Scene parse(std::string_view text, const std::string& name = "scene",
                        const OnRemark& on_remark = {});

/// The same for atoms, with or without the edges of the cell that they are in. Throws BadInput as
/// well where those are to be drawn and there is no cell.
RAYLANE_API Scene parse_atoms(std::string_view text, const std::string& name, bool show_cell,
                              const OnRemark& on_remark = {});

/// Writes a scene to a file, which appears whole or not at all, in the format of its ending (in any
/// case): .json, which has all of it that counts, to the bit, but which triangles make a polygon
/// and, of what goes with a camera, that fog goes with one that has been given its place; .rl,
/// which has these, too, and the hierarchy, and which load() maps rather than reads, but no solids
/// that are made of others, and is for versions of raylane with the same format of it; .nff and
/// .pov (POV-Ray 3.7), for other programs, which have less. What is not in the file as it is in the
/// scene, for want of a word in the format, is told to `on_remark`. Throws BadInput for another
/// ending, for shapes that the format does not have, or for solids that are nested deeper than is
/// read of it (in JSON some 127 levels, in .pov 125), and SystemRefused.
RAYLANE_API void save(const Scene& scene, const std::filesystem::path& path,
                      const OnRemark& on_remark = {});

} // namespace raylane
