#pragma once

#include "core/scene/surroundings.hpp"
#include "core/solids/transform.hpp"
#include "scenes/formats/pov/scanner.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// The values of names in a scene description.
namespace raylane::scenes::pov {

template <class T>
using Shared = std::shared_ptr<const T>;

/// A number, a vector of up to five, or a colour: red, green, blue, filter, transmit.
struct Tuple {
    std::array<double, 5> at{};
    int size = 1;

    static Tuple of(double number) { return {{number}, 1}; }
    static Tuple of(const core::Vec3d& v) { return {{v.x, v.y, v.z}, 3}; }
    /// Returns the vector. A number stands for all components.
    core::Vec3d vector() const {
        return size == 1 ? core::Vec3d(at[0]) : core::Vec3d(at[0], at[1], at[2]);
    }
};

/// An affine map: exact for shapes, in doubles for everything else.
struct Motion {
    core::Transform exact{};
    double rows[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    /// The displacement, if the map is only a translation.
    std::optional<core::Vec3d> translation = core::Vec3d(0.0);

    core::Vec3d direction(const core::Vec3d& v) const;
    core::Vec3d point(const core::Vec3d& p) const;
};
/// Applies `first`, then `second`; null is the identity.
Shared<Motion> both(const Shared<Motion>& first, const Shared<Motion>& second);

enum class PigmentKind : std::uint8_t { color, checker, gradient };

struct Pigment {
    PigmentKind kind = PigmentKind::color;
    Tuple color{{0, 0, 0, 0, 0}, 5}; ///< of a pattern, the first
    Tuple other{{0, 0, 0, 0, 0}, 5}; ///< of a pattern, the second
    core::Vec3d direction{0.0};      ///< gradient
    bool in_steps = false;           ///< gradient: a half for each colour
    Shared<Motion> motion{};
    std::string_view name{}; ///< of its declaration, or of the pigment that it began as
};

/// The defaults are POV-Ray's: 0.1 of ambient light and 0.6 of diffuse light.
struct Finish {
    double ambient = 0.1, emission = 0.0, diffuse = 0.6, brilliance = 1.0;
    double phong = 0.0, phong_size = 40.0, specular = 0.0, roughness = 0.05;
    double reflection = 0.0;
    bool fresnel = false;

    bool operator==(const Finish&) const = default;
};

struct Texture {
    Pigment pigment{};
    Finish finish{};
    std::string_view name{}; ///< of its declaration, or of the texture that it began as
};

/// A map of colours, of pigments or of textures, as far as its pattern is rendered.
enum class MapOf : std::uint8_t { colors, pigments, textures };
struct PatternMap {
    enum class Form : std::uint8_t { run, steps, other };

    MapOf of{};
    Form form = Form::other;
    Texture first{}, last{};
    Texture mean{};     ///< over places from 0 to 1
    Texture weighted{}; ///< the mean with places as weights
};

struct Interior {
    double index = 1.0;
    bool has_index = false;
};
struct Material {
    Shared<Texture> texture{};
    Shared<Interior> interior{};
};

/// A triangle of a mesh, and the index of its texture there; -1 is the mesh's own texture.
struct MeshTriangle {
    core::PartShape shape;
    int texture = -1;
};
struct Mesh {
    std::vector<MeshTriangle> triangles;
    std::vector<Shared<Texture>> textures;
};

enum class ObjectKind : std::uint8_t {
    shape,
    mesh,
    all_in_one, ///< union: its objects separately
    merge,
    intersection,
    difference,
    light,
};

struct LightSource {
    Place place{};
    core::Vec3d position{0.0}, point_at{0.0}, color{1.0};
    bool parallel = false;
    bool is_dimmed = false; ///< by fog and media, on its way to a surface
    double radius = 0.0;    ///< of a shining sphere: its color is then the radiance

    LightSource moved(const Shared<Motion>& motion) const;
};

/// The result of an object's statement.
struct Object {
    ObjectKind kind = ObjectKind::shape;
    Place place{};
    core::PartShape shape{};
    Shared<Mesh> mesh{};
    Shared<LightSource> light{};
    std::vector<Shared<Object>> parts{};
    std::vector<Shared<Object>> clips{};
    Shared<Texture> texture{};
    Shared<Interior> interior{};
    Shared<Motion> motion{};
    bool inverse = false;
    bool is_hidden = false; ///< omitted from the scene
    bool is_hollow = false; ///< filled by fog
    std::size_t count = 1;  ///< of shapes in it, including its clips
    std::size_t lights = 0; ///< in it
    std::size_t pieces = 1; ///< objects that it becomes in a scene, each with all of its clips
    int depth = 1;          ///< of nested objects
    std::shared_ptr<void> room{}; ///< in the budget, released with the object
};

struct Camera {
    core::Vec3d location{0.0}, direction{0.0, 0.0, 1.0}, right{4.0 / 3.0, 0.0, 0.0},
        up{0.0, 1.0, 0.0}, sky{0.0, 1.0, 0.0};
    std::optional<core::Vec3d> look_at{};
    std::optional<double> angle{}; ///< degrees
    bool orthographic = false;
    bool has_size = false; ///< right or up is given
    Shared<Motion> motion{};
};

/// The visible colour of a sky_sphere.
struct Sky {
    Tuple color{{}, 5};
};
/// The value of a skipped statement: normal, media, a function of a pigment, ...
struct NotDrawn {};

struct Value;
struct Array {
    std::vector<std::size_t> sizes;
    std::vector<Value> values;
    int depth = 1;                ///< of nested arrays
    std::shared_ptr<void> room{}; ///< in the budget, released with the array
};
struct Macro {
    std::string_view name;
    std::vector<std::string_view> parameters;
    Scanner body;
    bool is_function = false; ///< an expression that ends at a brace
};

struct Value {
    std::variant<std::monostate, Tuple, std::string, std::shared_ptr<Array>, Shared<Macro>,
                 Shared<Pigment>, Shared<Finish>, Shared<Texture>, Shared<Interior>,
                 Shared<Material>, Shared<Object>, Shared<Motion>, Shared<Camera>,
                 Shared<PatternMap>, Shared<core::Fog>, Shared<Sky>, NotDrawn>
        of{};

    template <class T>
    const T* get_if() const {
        return std::get_if<T>(&of);
    }
};

} // namespace raylane::scenes::pov
