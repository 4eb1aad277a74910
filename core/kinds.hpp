#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>

/// The one list of shapes. Tables, switches and names follow from it, here and in the kernels. The
/// files of a kind, in core/shapes/ and simd/kernel/shapes/, describe it.
namespace raylane::core {

enum class Ends : std::uint8_t { open, capped };

/// Shapes with numbers of type float or double.
template <class Number>
struct SphereOf;
template <class Number>
struct PlaneOf;
template <class Number>
struct DiscOf;
template <class Number>
struct TriangleOf;
template <class Number>
struct SmoothTriangleOf;
template <class Number>
struct BoxOf;
template <class Number, Ends ends>
struct CylinderOf;
template <class Number, Ends ends>
struct ConeOf;
template <class Number>
struct QuadricOf;
template <class Number>
struct EllipsoidOf;

using Sphere = SphereOf<float>;
using Plane = PlaneOf<float>;
using Disc = DiscOf<float>;
using Triangle = TriangleOf<float>;
using SmoothTriangle = SmoothTriangleOf<float>;
using Box = BoxOf<float>;
template <Ends ends>
using Cylinder = CylinderOf<float, ends>;
using OpenCylinder = Cylinder<Ends::open>;
using CappedCylinder = Cylinder<Ends::capped>;
template <Ends ends>
using Cone = ConeOf<float, ends>;
using OpenCone = Cone<Ends::open>;
using CappedCone = Cone<Ends::capped>;
using Quadric = QuadricOf<float>;
using Ellipsoid = EllipsoidOf<float>;

namespace detail {

template <class Shape>
struct ShapeParts;
template <template <class> class Of, class Number_>
struct ShapeParts<Of<Number_>> {
    using Number = Number_;
    template <class Other>
    using With = Of<Other>;
};
template <template <class, Ends> class Of, class Number_, Ends ends>
struct ShapeParts<Of<Number_, ends>> {
    using Number = Number_;
    template <class Other>
    using With = Of<Other, ends>;
};

} // namespace detail

/// The type of a shape's numbers.
template <class Shape>
using NumberOf = typename detail::ShapeParts<Shape>::Number;
/// The shape of the same kind with the other number type.
template <class Shape>
using InFloat = typename detail::ShapeParts<Shape>::template With<float>;
template <class Shape>
using InDouble = typename detail::ShapeParts<Shape>::template With<double>;

/// Type, enumerator, and name. The last word of the name is JSON's "type"; the words before it
/// distinguish kinds of the same type.
#define RAYLANE_SHAPES(SHAPE)                                                                      \
    SHAPE(Sphere, sphere, "sphere")                                                                \
    SHAPE(Plane, plane, "plane")                                                                   \
    SHAPE(Disc, disc, "disc")                                                                      \
    SHAPE(Triangle, triangle, "triangle")                                                          \
    SHAPE(SmoothTriangle, smooth_triangle, "smooth triangle")                                      \
    SHAPE(Box, box, "box")                                                                         \
    SHAPE(OpenCylinder, open_cylinder, "open cylinder")                                            \
    SHAPE(CappedCylinder, capped_cylinder, "capped cylinder")                                      \
    SHAPE(OpenCone, open_cone, "open cone")                                                        \
    SHAPE(CappedCone, capped_cone, "capped cone")                                                  \
    SHAPE(Quadric, quadric, "quadric")                                                             \
    SHAPE(Ellipsoid, ellipsoid, "ellipsoid")

#define RAYLANE_ENUMERATOR(Shape, name, text) name,
enum class Kind : std::uint8_t { RAYLANE_SHAPES(RAYLANE_ENUMERATOR) };
#undef RAYLANE_ENUMERATOR

namespace detail {

template <class, class... Shapes>
struct ShapeTypes {
    using All = std::tuple<Shapes...>;
    template <template <class> class Of>
    using Each = std::tuple<Of<Shapes>...>;
};
#define RAYLANE_TYPE(Shape, name, text) , Shape
using EveryShape = ShapeTypes<void RAYLANE_SHAPES(RAYLANE_TYPE)>;
#undef RAYLANE_TYPE

} // namespace detail

/// The types, in the order of Kind.
using Shapes = detail::EveryShape::All;
/// A tuple of Of<Shape> for each of them.
template <template <class> class Of>
using OfEachShape = detail::EveryShape::Each<Of>;

inline constexpr int kind_count = std::tuple_size_v<Shapes>;

namespace detail {

template <class Shape>
struct KindOf;
#define RAYLANE_KIND(Shape, name, text)                                                            \
    template <>                                                                                    \
    struct KindOf<Shape> {                                                                         \
        static constexpr Kind value = Kind::name;                                                  \
    };
RAYLANE_SHAPES(RAYLANE_KIND)
#undef RAYLANE_KIND

} // namespace detail

template <class Shape>
inline constexpr Kind kind_of = detail::KindOf<InFloat<Shape>>::value;

#define RAYLANE_NAME(Shape, name, text) text,
inline constexpr std::array<std::string_view, kind_count> kind_names = {
    RAYLANE_SHAPES(RAYLANE_NAME)};
#undef RAYLANE_NAME

constexpr std::string_view name_of(Kind kind) {
    return kind_names[static_cast<std::size_t>(kind)];
}

/// Returns the type name, which similar kinds share: JSON's "type".
constexpr std::string_view type_name_of(Kind kind) {
    const std::string_view name = name_of(kind);
    return name.substr(name.rfind(' ') + 1);
}

/// Calls visit(std::type_identity<Shape>()) with the shape type of `kind`.
template <class Visit>
constexpr decltype(auto) with_shape_type(Kind kind, Visit&& visit) {
    switch (kind) {
#define RAYLANE_CASE(Shape, name, text)                                                            \
    case Kind::name:                                                                               \
        return visit(std::type_identity<Shape>());
        RAYLANE_SHAPES(RAYLANE_CASE)
#undef RAYLANE_CASE
    }
    __builtin_unreachable();
}

/// Calls visit(std::type_identity<Shape>()) for every kind in order.
template <class Visit>
void for_each_shape_type(Visit&& visit) {
#define RAYLANE_VISIT(Shape, name, text) visit(std::type_identity<Shape>());
    RAYLANE_SHAPES(RAYLANE_VISIT)
#undef RAYLANE_VISIT
}

} // namespace raylane::core
