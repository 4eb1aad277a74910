#pragma once

#include "core/numbers/dyadic.hpp"
#include "core/solids/solid.hpp"

#include <array>
#include <optional>

namespace raylane::core {

/// An affine map x -> M x + t in exact numbers. What is made of several is multiplied out exactly;
/// only the numbers of a shape that is moved are rounded, each once.
class Transform {
  public:
    Transform(); ///< nothing moves
    static Transform translation(const Vec3d& by);
    /// About the axes x, y and z, one after the other, in degrees. The matrix has the sines and
    /// cosines as doubles: of multiples of 90 degrees exactly.
    static Transform rotation(const Vec3d& degrees);
    /// From the axes x, y and z to others of length 1 at right angles to each other.
    static Transform turn(const Vec3d& x, const Vec3d& y, const Vec3d& z);
    /// No factor is 0.
    static Transform scaling(const Vec3d& by);
    /// Rows of M with t behind; M must not be singular.
    static Transform matrix(const double (&rows)[3][4]);

    /// First `first`, then this one.
    Transform after(const Transform& first) const;

    /// A solid, or any shape, moved. What round shapes become by a map that stretches them is an
    /// ellipsoid, or a quadric between planes; an open one of these is clipped by them, but as a
    /// part of another solid endless like any. Throws InvalidValue for a disc that is stretched,
    /// which is no disc.
    Solid operator()(const Solid& solid) const;

    struct Form; ///< of a quadric

  private:
    using Row = Vec3<Dyadic>;

    Dyadic determinant() const;
    Row times(const Row& v) const;           ///< M v
    Row point(const Vec3d& p) const;         ///< M p + t
    Row normal(const Row& n) const;          ///< its direction stays outward
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
    std::optional<Dyadic> even_; ///< the factor of all lengths, if there is one
};

/// The infinite half-space on the inside of an open cylinder or cone: its form's coefficients,
/// rounded once. Of a cone both nappes.
QuadricOf<double> half_space_of(const CylinderOf<double, Ends::open>& cylinder);
QuadricOf<double> half_space_of(const ConeOf<double, Ends::open>& cone);

} // namespace raylane::core
