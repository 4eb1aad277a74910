#pragma once

#include "raylane/api.hpp"
#include "raylane/vector.hpp"

#include <array>
#include <memory>

namespace raylane::core {
class Transform;
}
namespace raylane::library {
struct Internals;
}

namespace RAYLANE_API raylane {

/// An affine map x -> M x + t, in exact numbers: products of maps are exact, and each number of a
/// transformed shape is rounded once, to the nearest double. Solid::transformed and
/// Group::transformed apply it. To transform a transformed object rounds again: combine the maps by
/// then() to round once. The keys of one object in a file are one map, and those of each group or
/// instance around it another one, from the inside out. Cheap to copy.
///
/// Each function returns this map followed by another one:
/// Transform().scaled(2).rotated({0, 90, 0}).translated({1, 0, 0}) scales first, as a file's keys
/// `scale`, `rotate` and `translate` do. All numbers are from -1e30 to 1e30. Throws InvalidValue,
/// fields "scale/0", "rotate/0", "translate/0" and "transform".
class Transform {
  public:
    Transform(); ///< the identity
    /// Takes the three rows of M, each followed by its element of t. M must not be singular.
    explicit Transform(const std::array<std::array<double, 4>, 3>& rows);

    Transform scaled(double factor) const;                 ///< not 0; negative: also mirrored
    Transform scaled(const Vec3Of<double>& factors) const; ///< one for each axis, not 0
    /// Rotates about the axes x, y and z, one after the other, counter-clockwise for a viewer to
    /// whom the axis points. In degrees; multiples of 90 are exact.
    Transform rotated(const Vec3Of<double>& degrees) const;
    Transform translated(const Vec3Of<double>& by) const;
    Transform then(const Transform& next) const;

  private:
    friend struct library::Internals;
    explicit Transform(std::shared_ptr<const core::Transform> transform);

    std::shared_ptr<const core::Transform> transform_;
};

} // namespace raylane
