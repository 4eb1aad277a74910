#pragma once

#include "core/numbers/double_double.hpp"
#include "core/solids/transform.hpp"

#include <array>

/// Copies of shapes at other places: the numbers of a copy are those of the transformed shape, each
/// rounded once.
namespace raylane::core {

/// The place of a copy: scaled, then rotated about the axes x, y and z, then translated.
struct Placement {
    Vec3d translate{0.0};
    Vec3d rotate{0.0}; ///< degrees
    double scale = 1.0;
};

/// Throws InvalidValue, fields "translate/0", "rotate/0" and "scale": all numbers must be within
/// -1e30 to 1e30, and the scale positive.
void validate(const Placement& placement);

Transform transform_of(const Placement& placement);

/// Returns true if a shape of any placement is of the same kind, and Placer can place it.
bool can_place(const PartShape& shape);

/// Computes the shapes of one copy. They have the bits of transform_of(placement), at less cost:
/// exact numbers are needed only where double-doubles leave a rounding in doubt.
class Placer {
  public:
    explicit Placer(const Placement& placement);

    SphereOf<double> operator()(const SphereOf<double>& shape) const;
    template <Ends ends>
    CylinderOf<double, ends> operator()(const CylinderOf<double, ends>& shape) const;

  private:
    bool place_point(const Vec3d& point, Vec3d& placed) const;
    bool place_vector(const Vec3d& vector, Vec3d& placed) const;
    template <class Shape>
    Shape exactly(const Shape& shape) const;

    Placement placement_;
    bool turns_;
    DoubleDouble rows_[3][3]; // with errors of less than 2^-96 of the scale; zeros are exact
};

/// Returns the rows of the placement's linear map, each number with an error of at most 4 ulps of
/// the scale. Faster than Placer.
std::array<Vec3d, 3> rows_of(const Placement& placement);

} // namespace raylane::core
