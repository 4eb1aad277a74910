#pragma once

#include "core/shapes/types.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <tuple>
#include <variant>
#include <vector>

namespace raylane::core {

namespace detail {

template <class>
struct VariantOf;
template <class... Shape>
struct VariantOf<std::tuple<Shape...>> {
    using type = std::variant<InDouble<Shape>...>;
};

} // namespace detail

/// A shape of any kind, in doubles.
using PartShape = detail::VariantOf<Shapes>::type;

/// How a solid is made of others. A solid made by clip has no faces where it was cut.
enum class Made : std::uint8_t { of_shape, by_union, by_intersection, by_difference, by_clip };

struct ObjectSpace;

inline constexpr MaterialIndex no_material = std::numeric_limits<MaterialIndex>::max();

/// The description of a solid that is made of others. Its parts are solids or half-spaces. The
/// half-space of a plane is behind it; that of a quadric is where its form is less than 0,
/// regardless of its box.
struct Solid {
    Made made = Made::of_shape;
    PartShape shape{}; ///< of_shape
    /// Otherwise. by_difference: the first part minus the others; by_clip: the part of the first
    /// that is inside of all others.
    std::vector<Solid> parts{};
    MaterialIndex material = no_material; ///< none: that of the whole
    bool endless_as_part = false;         ///< a stretched open cylinder or cone: as a part of
                                          ///< another solid, it stands for its first part
    bool cuts_nothing = false;            ///< for a clipping solid: it only bounds the others
    /// of_shape: the space of the shape before transforms moved it; null: that of the scene.
    std::shared_ptr<const ObjectSpace> space{};
};

/// Gives all shapes of a solid this space.
inline void set_space(Solid& solid, const std::shared_ptr<const ObjectSpace>& space) {
    solid.space = solid.made == Made::of_shape ? space : nullptr;
    for (Solid& part : solid.parts)
        set_space(part, space);
}

inline Solid of_shape(const PartShape& shape) {
    Solid solid;
    solid.shape = shape;
    return solid;
}

/// Returns the number of shapes of a solid, including those that only clip it.
inline std::size_t count_parts(const Solid& solid) {
    std::size_t count = solid.made == Made::of_shape ? 1 : 0;
    for (const Solid& part : solid.parts)
        count += count_parts(part);
    return count;
}

/// Returns the number of levels of solids; 1 for a shape.
inline int depth_of(const Solid& solid) {
    int depth = 0;
    for (const Solid& part : solid.parts)
        depth = std::max(depth, depth_of(part));
    return depth + 1;
}

} // namespace raylane::core
