#pragma once

#include "core/shapes/ray.hpp"
#include "core/shapes/types.hpp"
#include "tests/oracle/root.hpp"

#include <optional>
#include <vector>

/// Crossings of a line and a shape, in exact numbers, and by other formulas than the solvers use
/// (quadratics in cross products with cleared fractions, Cramer's rule, faces one by one), so that
/// the two do not share a mistake: what these have in common. Each shape's file has its own
///   std::vector<Hit> crossings(shape, ray)
namespace raylane::oracle {

using core::Face;

/// A crossing of the line, t of either sign.
struct Hit {
    Root root;
    Number t; ///< its value
    bool entering;
    Face face = core::body;

    Hit(const Root& at, bool enters, Face which = core::body)
        : root(at), t(at), entering(enters), face(which) {}
};

int compare(const Hit& a, const Hit& b);

/// A ray from a point of its shape.
struct Line {
    Vector f, d;

    template <class Real>
    Line(const core::Ray<Real>& ray, const core::Vec3d& anchor)
        : f(vector(ray.origin) - vector(anchor)), d(vector(ray.direction)) {}
};

/// True if |f + t d - offset| is at most this.
bool is_within(const Line& line, const Root& t, const Vector& offset, const Exact& radius);

/// normal . (f + t d) = height
std::optional<Hit> plane_crossing(const Line& line, const Vector& normal, const Exact& height = {},
                                  Face face = core::body);

/// Of a convex solid given by where the line crosses its faces: the first of those by which it
/// enters and the last of those by which it leaves, by the lowest face where these are several. A
/// line that lies in faces enters and leaves by the others.
std::vector<Hit> first_and_last(const std::vector<Hit>& on_faces);

} // namespace raylane::oracle
