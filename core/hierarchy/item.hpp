#pragma once

#include "core/numbers/float4.hpp"
#include "core/shapes/bounds.hpp"
#include "core/shapes/types.hpp"

#include <bit>
#include <cstdint>
#include <limits>

namespace raylane::core {

/// Bounds used while building; initially empty. The fourth number is meaningless.
struct Box4 {
    Float4 lower = all4(std::numeric_limits<float>::infinity());
    Float4 upper = -all4(std::numeric_limits<float>::infinity());

    void include(const Box4& other) {
        lower = least(lower, other.lower);
        upper = greatest(upper, other.upper);
    }
    void include(const Float4& point) {
        lower = least(lower, point);
        upper = greatest(upper, point);
    }
    Bounds bounds() const {
        return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
    }
    /// Returns half of the surface area, in a unit in which it cannot overflow.
    float half_area(float per_unit) const {
        const Float4 size = (upper - lower) * per_unit;
        return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    }
};

/// One bounded shape, as the builder of the hierarchy sees it. The fourth components of its bounds
/// hold its kind and its position in the list of that kind.
struct alignas(32) Item : Box4 {
    Item(const Bounds& bounds, Kind kind, std::uint32_t position) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = bounds.lower[axis];
            upper[axis] = bounds.upper[axis];
        }
        set_position(position);
        upper[3] = std::bit_cast<float>(about_one | static_cast<std::uint32_t>(kind));
    }
    Item() = default;

    std::uint32_t position() const { return std::bit_cast<std::uint32_t>(float(lower[3])); }
    void set_position(std::uint32_t position) { lower[3] = std::bit_cast<float>(position); }
    Kind kind() const { return static_cast<Kind>(std::bit_cast<std::uint32_t>(float(upper[3]))); }
    /// Returns the sum of both bounds. Its fourth component is about 1 where the position, read as
    /// a float, is a small number.
    Float4 doubled_center() const { return lower + upper; }

  private:
    static constexpr std::uint32_t about_one = std::bit_cast<std::uint32_t>(1.0F);
};

} // namespace raylane::core
