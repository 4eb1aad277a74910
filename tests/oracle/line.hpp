#pragma once

#include "core/shapes/ray.hpp"
#include "core/shapes/shapes.hpp"
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

inline int compare(const Hit& a, const Hit& b) {
    return compare(a.root, a.t, b.root, b.t);
}

/// A ray from a point of its shape.
struct Line {
    Vector f, d;

    template <class Real>
    Line(const core::Ray<Real>& ray, const core::Vec3f& anchor)
        : f(vector(ray.origin) - vector(anchor)), d(vector(ray.direction)) {}
};

/// True if |f + t d - offset| is at most this.
inline bool is_within(const Line& line, const Root& t, const Vector& offset, const Exact& radius) {
    const Vector f = line.f - offset;
    return sign_at(t, inner(f, f) - radius * radius, Exact(2) * inner(f, line.d),
                   inner(line.d, line.d)) <= 0;
}

/// normal . (f + t d) = height
inline std::optional<Hit> plane_crossing(const Line& line, const Vector& normal,
                                         const Exact& height = {}, Face face = core::body) {
    const Exact approach = inner(normal, line.d);
    if (approach.sign() == 0) return std::nullopt;
    return Hit(Root::quotient(height - inner(normal, line.f), approach), approach.sign() < 0, face);
}

/// Of a convex solid given by where the line crosses its faces: the first of those by which it
/// enters and the last of those by which it leaves, by the lowest face where these are several. A
/// line that lies in faces enters and leaves by the others.
inline std::vector<Hit> first_and_last(const std::vector<Hit>& on_faces) {
    std::optional<Hit> first, last;
    const auto choose = [](std::optional<Hit>& chosen, const Hit& hit, int wanted) {
        const int order = chosen ? compare(hit, *chosen) : wanted;
        if (order == wanted || (order == 0 && hit.face < chosen->face)) chosen = hit;
    };
    for (const Hit& hit : on_faces)
        hit.entering ? choose(first, hit, -1) : choose(last, hit, 1);
    if (!first || !last) return {};
    return {*first, *last};
}

} // namespace raylane::oracle
