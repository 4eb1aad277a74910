#pragma once

#include "core/shapes/types.hpp"

#include <cstdint>
#include <limits>
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

/// What solids are made of others by. What `clip` leaves has no faces where it was cut.
enum class Made : std::uint8_t { of_shape, by_union, by_intersection, by_difference, by_clip };

inline constexpr MaterialIndex no_material = std::numeric_limits<MaterialIndex>::max();

/// A solid that is made of others, as it is described. Its parts are solids, or half-spaces: what
/// is behind a plane, and where a quadric's form is less than 0, wherever that is.
struct Solid {
    Made made = Made::of_shape;
    PartShape shape{};          ///< of_shape
    std::vector<Solid> parts{}; ///< else; by_difference: the first, less all others; by_clip: what
                                ///< of the first is inside of all others
    MaterialIndex material = no_material; ///< none: that of the whole
    bool endless_as_part = false; ///< an open cylinder or cone that was stretched: as a part of
                                  ///< another it is what its own first part is
    bool cuts_nothing = false;    ///< of what clips: it only says where the others are
};

inline Solid of_shape(const PartShape& shape) {
    Solid solid;
    solid.shape = shape;
    return solid;
}

} // namespace raylane::core
