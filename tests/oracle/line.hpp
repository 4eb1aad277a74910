#pragma once

#include "core/shapes/ray.hpp"
#include "core/shapes/types.hpp"
#include "tests/oracle/root.hpp"

#include <optional>
#include <vector>

/// Exact crossings of a line with a shape, and the normals there. They come from other formulas
/// than the solvers use (quadratics in cross products with cleared fractions, Cramer's rule, faces
/// one by one), so that the two do not share a mistake. This header has the common parts. Each
/// shape's file defines
///   std::vector<Hit> crossings(shape, ray)
///   Normal normal(shape, ray, hit)
/// The normal points towards the outside (the front) at a crossing. At an apex it is the axis
/// towards the outside instead.
namespace raylane::oracle {

using core::Face;

/// A crossing with the line. t may have either sign.
struct Hit {
    Root root;
    Number t; ///< its value
    bool entering;
    Face face = core::body;

    Hit(const Root& at, bool enters, Face which = core::body)
        : root(at), t(at), entering(enters), face(which) {}
};

int compare(const Hit& a, const Hit& b);

/// A ray relative to a point of its shape.
struct Line {
    Vector f, d;

    template <class Real>
    Line(const core::Ray<Real>& ray, const core::Vec3d& anchor)
        : f(vector(ray.origin) - vector(anchor)), d(vector(ray.direction)) {}
};

/// Returns whether |f + t d - offset| is at most `radius`.
bool is_within(const Line& line, const Root& t, const Vector& offset, const Exact& radius);

/// Returns the crossing with the plane normal . (f + t d) = height.
std::optional<Hit> plane_crossing(const Line& line, const Vector& normal, const Exact& height = {},
                                  Face face = core::body);

/// Returns the crossings of a convex solid, from those with its faces: the first by which the line
/// enters and the last by which it leaves. At one t, the lowest face counts. A line that lies in
/// faces enters and leaves by the other faces.
std::vector<Hit> first_and_last(const std::vector<Hit>& on_faces);

/// The vector v0 + t v1 at a root t, of any length.
struct Normal {
    Root t;
    Vector v0, v1;

    static Normal fixed(const Vector& v) { return {{{}, Exact(1), 0, {}}, v, {}}; }
    int sign(int axis) const { return sign_at(t, v0[axis], v1[axis]); }
    bool vanishes() const { return sign(0) == 0 && sign(1) == 0 && sign(2) == 0; }
};
Vector opposite(const Vector& v);

/// Compares the absolute value of a component of the unit vector with `size`: -1 if it is less.
int compare_size(const Normal& n, int axis, const Exact& size);

/// Returns the unit vector, each component rounded to the nearest float, ties to even.
core::Vec3f rounded(const Normal& n);
/// The same for the nearest double.
core::Vec3d rounded_to_double(const Normal& n);

} // namespace raylane::oracle
