#pragma once

#include "raylane/api.hpp"
#include "raylane/generators.hpp"
#include "raylane/group.hpp"
#include "raylane/material.hpp"
#include "raylane/shapes.hpp"
#include "raylane/solid.hpp"
#include "raylane/surroundings.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace raylane::core {
class Scene;
class SceneBuilder;
} // namespace raylane::core
namespace raylane::library {
struct Internals;
class SceneAnnotations;
} // namespace raylane::library

namespace RAYLANE_API raylane {

/// A closed axis-aligned box. It is empty if lower > upper.
struct Bounds {
    Vec3 lower, upper;
};

/// All shapes of one type in a scene, except parts of constructed solids, in the order of their
/// ids.
template <class Shape>
struct ShapesOf {
    std::vector<ShapeId> id;
    std::vector<MaterialIndex> material; ///< of each shape
    std::vector<Shape> shape;
};

/// A validated, immutable scene. Cheap to copy: all copies share one scene, which lives as long as
/// any copy or any Tracer of it. Any number of threads may read it concurrently.
class Scene {
  public:
    std::size_t shape_count() const;
    std::size_t material_count() const;
    /// Returns the bounds of all shapes except planes, which are unbounded. The box contains each
    /// shape entirely and is larger only by rounding. The bounds of a quadric are its box. Returns
    /// an empty box, from infinity to -infinity, if the scene has no such shapes.
    Bounds bounds() const;
    /// Throws InvalidValue if no shape has this id.
    MaterialIndex material_of(ShapeId shape) const;
    /// Returns the id of the constructed solid that the shape is a part of, which is the id of the
    /// solid's first part. Returns the id of any other shape unchanged. Throws InvalidValue if no
    /// shape has this id.
    ShapeId solid_of(ShapeId shape) const;
    /// Returns a shape with exactly the numbers that it was given, or that with_positions() gave
    /// it. For a part of a constructed solid, returns the part as it was given, except that `lower`
    /// and `upper` of a quadric are bounds of its visible surface, and that an open cylinder or
    /// cone is a quadric. Takes time in proportion to the number of shapes, 4 ms for a million.
    /// Throws InvalidValue if no shape has this id.
    ShapeVariant shape(ShapeId id) const;
    /// Returns all shapes of a type with exactly the numbers that they were given:
    /// shapes<SphereOf>() returns the spheres. Equal shapes that count as one are all returned. The
    /// rows of spheres are those of with_positions(). Does not tell which triangles form a polygon.
    /// Throws std::bad_alloc.
    template <template <class> class ShapeOf>
    ShapesOf<ShapeOf<double>> shapes() const;
    /// Throws InvalidValue if no material has this index.
    Material material(MaterialIndex index) const;
    /// Returns the name that a material has in its file, or that its builder was given. Empty if it
    /// has none. Throws InvalidValue if no material has this index.
    std::string material_name(MaterialIndex index) const;
    std::vector<Light> lights() const;
    Fog fog() const;
    Camera camera() const;
    Color background() const;
    Settings settings() const;
    /// Returns a scene with the same shapes and another camera. Lights and depth-cue fog that
    /// follow the camera are computed again, which takes one pass over all shapes; otherwise the
    /// call takes little time. The copy shares the memory of the shapes. Throws InvalidValue,
    /// fields "camera/...".
    Scene seen_by(const Camera& camera) const;
    /// Returns a perspective camera that shows all bounded shapes as large as possible.
    /// `direction`: line of sight, of any length except zero. `aspect`: the image's width divided
    /// by its height, 1e-5 to 1e5. Throws InvalidValue if an argument is out of range, if the scene
    /// has no bounded shapes, or if the camera would have to be beyond 1e30.
    Camera camera_on_all(const Vec3& direction = {0.0F, 0.0F, -1.0F}, float aspect = 1.0F) const;

    /// Returns a scene whose spheres have moved. positions[i] becomes the centre of the i-th sphere
    /// in the order of their ids, without spheres that are parts of constructed solids. Their
    /// radii, materials and ids stay. Other shapes, parts of solids, lights, fog and the camera
    /// stay, too, except that lights and depth-cue fog that follow an automatic camera are computed
    /// again as by seen_by(). Annotations are left out, as they are those of the atoms before. With
    /// Precision::exact, all answers and images have the bits of a
    /// scene that is built of these shapes.
    ///
    /// `positions`: one for each sphere, within -1e30 to 1e30, used exactly as in SceneBuilder.
    /// Throws InvalidValue, fields "positions" for another number of them, "positions/17/2" for an
    /// invalid coordinate, "lights/0/position" for a point light on a surface, and
    /// "RAYLANE_THREADS".
    ///
    /// Takes a fraction of the time of build() while the spheres stay near their places. Rebuilds
    /// the parts of the hierarchy that no longer fit. Takes somewhat more than build() if the whole
    /// hierarchy does not fit, or if equal spheres of one material meet or part.
    Scene with_positions(std::span<const Vec3> positions) const;
    Scene with_positions(std::span<const Vec3Of<double>> positions) const;

    // No move operations: a scene is never empty.
    Scene(const Scene&) = default;
    Scene& operator=(const Scene&) = default;
    ~Scene() = default;

  private:
    friend struct library::Internals;
    Scene(std::shared_ptr<const core::Scene> scene,
          std::shared_ptr<const library::SceneAnnotations> annotations);

    std::shared_ptr<const core::Scene> scene_;
    std::shared_ptr<const library::SceneAnnotations> annotations_; // of images; may be null
};

/// Builds a scene from values that are added in any order, and checks each value as it is added.
/// All functions throw InvalidValue, with a field relative to the argument, and then leave the
/// builder unchanged. They also throw std::bad_alloc. Not thread-safe. A moved-from builder is
/// empty and can be reused.
class SceneBuilder {
  public:
    Camera camera; ///< checked by build(), field "camera/..."
    /// If set, build() places the camera by the shapes and ignores `camera`. Checked by build(),
    /// field "auto_camera/...". build() throws InvalidValue, field "camera", if the scene has no
    /// bounded shapes, or if the camera would have to be beyond 1e30.
    std::optional<AutoCamera> auto_camera;
    /// If true, build() adds two lights after the others, which Scene::seen_by moves with the
    /// camera: a sky whose zenith is upward in the image, and a lamp over the camera's left
    /// shoulder. A file with an automatic camera and without a list of lights has them.
    bool camera_lights = false;
    Color
        background; ///< colour of rays that hit nothing; checked by build(), field "background/..."
    Fog fog;        ///< checked by build(), field "fog/..."
    Settings settings; ///< checked by build(), field "settings/..."
    /// At most 64 wavelengths in nanometres, 380 to 780. An image is rendered for each, with the
    /// index of glass at that wavelength. Empty: one image, with Material::index. Checked by
    /// build(), field "spectrum/wavelengths/0".
    std::vector<double> wavelengths;
    /// If true, shapes with equal numbers and the same material index count as one shape, the
    /// first: queries never return the ids of the others. This does not apply to triangles of
    /// polygons and to parts of solids. If false, each of them counts, for example in tallies of
    /// crossings. Thousands of equal shapes then slow down rays that meet them. save() to .json
    /// does not store the choice.
    bool merge_duplicates = true;

    SceneBuilder();
    ~SceneBuilder();
    SceneBuilder(SceneBuilder&& other) noexcept;
    SceneBuilder& operator=(SceneBuilder&& other) noexcept;

    /// Returns the index by which shapes refer to the material. save() writes its name; several
    /// materials may have one name.
    MaterialIndex add_material(const Material& material, std::string_view name = {});
    void add_light(const Light& light);

    /// Returns the id of the new shape: 0, 1, 2, ... `material` is an index from add_material.
    /// Without one, objects have the default material, Material{}, which gets an index when it is
    /// first used.
    template <AnyShape Shape>
    ShapeId add(const Shape& shape, MaterialIndex material = no_material);

    /// Adds a constructed solid. Returns the id of its first part; the ids of the other parts
    /// follow in the order in which they were given. Solids that only clip have no surface and no
    /// id. `material` applies to parts without a material, and to the inside of the solid if that
    /// has none. If it is not given and all parts have materials, the inside has that of the first
    /// part. Fields in errors are those of the shapes, with the prefix "objects/0/objects/2/", ...
    /// Throws InvalidValue if quadrics leave the solid unbounded.
    ShapeId add(const Solid& solid, MaterialIndex material = no_material);

    /// Adds all members of a group as objects of the scene. Members without a material take
    /// `material`. Returns the id of the first shape; the ids of the others follow in the order of
    /// the members. Fields in errors have the prefix "objects/0/", the number of the member.
    ShapeId add(const Group& group, MaterialIndex material = no_material);

    /// Adds copies of a group, with the shapes and ids of add(group.transformed(...), material) for
    /// each placement in turn. Returns the id of the first shape. Fields in errors also have the
    /// prefix "placements/2/".
    ///
    /// Copies of `keep_from` shapes or more are kept as copies, of less than 100 bytes each, under
    /// these conditions:
    /// - all members are spheres and cylinders whose material has no transmission;
    /// - no coordinate exceeds 2^40, and the scale is from 2^-20 to 2^20;
    /// - the scene has no solids.
    ///
    /// Results and images have the bits of a scene with shapes in their place, except that equal
    /// shapes of different copies count separately. Shapes that rays have hit take memory from then
    /// on, up to 1 kB for 16 spheres. Rays always have Precision::exact. Tracer's contains(),
    /// cells() and closest(), with_positions(), and save() to .rl throw.
    ShapeId add(const Group& group, std::span<const Placement> placements,
                MaterialIndex material = no_material);
    /// Number of shapes in one call from which copies are kept. Fewer are traced faster as shapes.
    std::size_t keep_from = std::size_t{1} << 22;

    /// Adds the shapes of a generator. Returns the first id. The struts of a lattice have the
    /// material of its spheres unless they are given their own.
    ShapeId add(const Sphereflake& flake, MaterialIndex material = no_material);
    ShapeId add(const Lattice& lattice, MaterialIndex material = no_material,
                MaterialIndex strut_material = no_material);

    /// Adds one or more triangles that tile one flat polygon. No reflection or shadow of one of
    /// them falls on another. Returns the first id; the ids of the other triangles follow. Fields
    /// in errors have the triangle's number as a prefix: "1/normals/0". Also throws InvalidValue if
    /// a corner is off the common plane by more than 2^-14 of the distance between corners and
    /// 2^-20 of the coordinates.
    ShapeId add_polygon(std::span<const Triangle> triangles, MaterialIndex material);
    ShapeId add_polygon(std::span<const SmoothTriangle> triangles, MaterialIndex material);
    ShapeId add_polygon(std::span<const TriangleOf<double>> triangles, MaterialIndex material);
    ShapeId add_polygon(std::span<const SmoothTriangleOf<double>> triangles,
                        MaterialIndex material);

    std::size_t shape_count() const;

    /// Checks the scene as a whole, builds the hierarchy and returns the scene. Uses as many
    /// threads as the environment variable RAYLANE_THREADS says, or all processors. Throws
    /// InvalidValue with the fields above, "lights/0/position", ... or "RAYLANE_THREADS". Leaves
    /// the builder empty, even if it throws, except with the field "RAYLANE_THREADS". A scene
    /// without lights shows only ambient terms, reflections and refractions.
    Scene build();

  private:
    template <class CoreShape, class Shape>
    ShapeId add_polygon_as(std::span<const Shape> triangles, MaterialIndex material);

    template <class Add>
    ShapeId add_members(const Group& group, MaterialIndex material, const Add& add);

    core::SceneBuilder& builder();
    /// Calls add(material), with the default material if none is given.
    template <class Add>
    ShapeId add_with(MaterialIndex material, const Add& add);

    std::unique_ptr<core::SceneBuilder> builder_; // null until the first value is added
    MaterialIndex default_material_ = no_material;
};

/// Callback for warnings, one line each: contents of a file that raylane ignores, or a scene
/// without objects. Called on the caller's thread.
using OnRemark = std::function<void(const std::string& remark)>;

/// Reads a scene from a file. Formats: JSON (see scenes/raylane-scene.schema.json), NFF, POV-Ray,
/// Tachyon, and files written by save(). From atoms in PDB, PQR, mmCIF, CIF, XYZ, GRO, MOL, SDF,
/// MOL2 or LAMMPS dump or data files it makes a scene. The file's ending decides the format, or its
/// content if the ending is unknown. "-" is a file of that name. Also reads the files that the file
/// includes. Throws BadInput for a malformed or missing file (in JSON with up to ten mistakes),
/// SystemRefused, std::bad_alloc, and InvalidValue, field "RAYLANE_THREADS", if the value of that
/// environment variable is invalid.
RAYLANE_API Scene load(const std::filesystem::path& path, const OnRemark& on_remark = {});

/// Options of scenes from atoms, as pairs of name and value, with the names and values of `raylane
/// render`, but without leading dashes: {"style", "balls"}, {"polyhedra", "Ti opacity 0.5"}. The
/// value of a flag is "on" or "off". An option that has several values stands once for each of
/// them. {"representations", VALUE} is the same as {"show", VALUE}, but messages number the values
/// from 0: "representations/0: column 9: ...". {"cell", "on"} adds the edges of the unit cell.
/// {"frame", "5"} is the number of a trajectory's frame, from 0, or from -1 backwards.
///
/// Annotations are options, too: render() puts them over images of the scene, or into an SVG file.
/// {"legend", "on"}, {"legend_title", TEXT}, {"scale_bar", "auto" or a length in angstrom},
/// {"triad", "xyz", "abc" or "auto"}, {"label", "SELECTION: TEXT"}, {"distance", "SELECTION:
/// SELECTION"}, {"font", NAME}, {"font_size", POINTS}, at 300 pixels per inch. {"labels", VALUE}
/// and {"distances", VALUE} are the same, but messages number them: "labels/0: ...". save() does
/// not write annotations.
using AtomOptions = std::vector<std::pair<std::string, std::string>>;

/// Reads a scene from a file of atoms, same as load(), with options. Throws BadInput in more
/// cases, with the option's name in place of the file's:
/// - an unknown option or a malformed value;
/// - options with a file that has no atoms, except for scale bar and triad;
/// - annotations at atoms that the file does not have;
/// - a legend without colours.
RAYLANE_API Scene load_atoms(const std::filesystem::path& path, const AtomOptions& options,
                             const OnRemark& on_remark = {});

/// Reads a scene from memory, as load() does. `name` stands for the file's name in messages, in the
/// search for included files and in the choice of the format by its ending.
RAYLANE_API Scene parse(std::string_view text, const std::string& name = "scene",
                        const OnRemark& on_remark = {});

/// Reads atoms from memory, with options, as load_atoms() does.
RAYLANE_API Scene parse_atoms(std::string_view text, const std::string& name,
                              const AtomOptions& options, const OnRemark& on_remark = {});

/// Writes a scene to a file. The file appears complete or not at all. The ending, in upper or lower
/// case, decides the format:
/// - .json: everything that is visible of the scene, to the bit. It does not store which triangles
///   form a polygon. If seen_by() has replaced an automatic camera, it does not store that the
///   depth-cue fog follows the camera.
/// - .rl: the scene with both of these, and its hierarchy, as in memory. load() maps the file
///   instead of parsing it. It cannot hold constructed solids, and only versions of raylane with
///   the same version of this format read it.
/// - .nff and .pov (POV-Ray 3.7): for other programs, with less of the scene.
///
/// Calls `on_remark` for each feature that the format cannot express. Throws BadInput for another
/// ending, for shapes that the format does not support, and for solids nested deeper than raylane
/// reads them from that format (some 127 levels in JSON, 125 in .pov). Throws SystemRefused.
RAYLANE_API void save(const Scene& scene, const std::filesystem::path& path,
                      const OnRemark& on_remark = {});

} // namespace raylane
