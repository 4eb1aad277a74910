#pragma once

#include "core/numbers/dyadic.hpp"
#include "core/solids/solid.hpp"

#include <array>
#include <optional>

namespace raylane::core {

/// The sine and cosine of an angle, rounded to doubles; exact for multiples of 90 degrees.
struct Turn {
    double sine, cosine;
};
Turn turn_by_degrees(double degrees);

/// An affine map x -> M x + t in exact numbers. Products of maps are exact. Only the numbers of a
/// transformed shape are rounded, each once.
class Transform {
  public:
    Transform(); ///< identity
    static Transform translation(const Vec3d& by);
    /// Rotates about the axes x, y and z, one after the other, in degrees. The matrix has the sines
    /// and cosines as doubles, which are exact for multiples of 90 degrees.
    static Transform rotation(const Vec3d& degrees);
    /// Rotates the axes x, y and z to other perpendicular axes of length 1.
    static Transform turn(const Vec3d& x, const Vec3d& y, const Vec3d& z);
    /// Scales along the axes. No factor may be 0.
    static Transform scaling(const Vec3d& by);
    /// Takes the rows of M, each followed by its element of t; M must not be singular.
    static Transform matrix(const double (&rows)[3][4]);

    /// Returns the product of two maps: `first`, then this one.
    Transform after(const Transform& first) const;

    /// Transforms a solid, or any shape. A map that stretches a round shape turns it into an
    /// ellipsoid, or into a quadric between planes. If the shape is open, the planes clip the
    /// quadric; as a part of another solid, the quadric is endless like any other. Throws
    /// InvalidValue for a stretched disc.
    Solid operator()(const Solid& solid) const;

    /// Return the columns of M and t, rounded to doubles.
    std::array<Vec3d, 3> columns() const;
    Vec3d origin() const;

    struct Form; ///< form of a quadric

  private:
    using Row = Vec3<Dyadic>;

    Dyadic determinant() const;
    Row times(const Row& v) const;           ///< M v
    Row point(const Vec3d& p) const;         ///< M p + t
    Row normal(const Row& n) const;          ///< keeps it pointing outward
    Row cofactors_times(const Row& v) const; ///< det(M) M^-T v
    Row adjugate_times(const Row& v) const;  ///< det(M) M^-1 v

    Solid moved(const SphereOf<double>& s) const;
    Solid moved(const PlaneOf<double>& s) const;
    Solid moved(const DiscOf<double>& s) const;
    Solid moved(const TriangleOf<double>& s) const;
    Solid moved(const SmoothTriangleOf<double>& s) const;
    Solid moved(const BoxOf<double>& s) const;
    Solid moved(const EllipsoidOf<double>& s) const;
    Solid moved(const QuadricOf<double>& s) const;
    template <Ends ends>
    Solid moved(const CylinderOf<double, ends>& s) const;
    template <Ends ends>
    Solid moved(const ConeOf<double, ends>& s) const;

    QuadricOf<double> moved(const Form& form, const Vec3d& center) const;
    Solid between_ends(const Form& form, const Vec3d& base, const Vec3d& axis, double radius,
                       Ends ends) const;

    std::array<Row, 3> rows_;
    Row translation_{};
    std::optional<Dyadic> even_; ///< the common factor of all lengths, if any
};

/// Returns the infinite half-space on the inside of an open cylinder or cone: the coefficients of
/// its form, rounded once. A cone's has both nappes.
QuadricOf<double> half_space_of(const CylinderOf<double, Ends::open>& cylinder);
QuadricOf<double> half_space_of(const ConeOf<double, Ends::open>& cone);

} // namespace raylane::core
