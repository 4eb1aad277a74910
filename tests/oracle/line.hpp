#pragma once

#include "core/shapes/ray.hpp"
#include "core/shapes/types.hpp"
#include "tests/oracle/root.hpp"

#include <optional>
#include <vector>

/// Exact crossings of a line with a shape. They come from other formulas than the solvers use
/// (quadratics in cross products with cleared fractions, Cramer's rule, faces one by one), so that
/// the two do not share a mistake. This header has the common parts. Each shape's file defines
///   std::vector<Hit> crossings(shape, ray)
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

} // namespace raylane::oracle
