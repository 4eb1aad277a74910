#pragma once

#include "core/shapes/types.hpp"
#include "tests/oracle/exact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

/// Closest points of shapes in 100 digits, by other formulas than the library's: all points of a
/// surface that may be the closest, from axes and normals of length 1, of which the closest one is
/// taken. Each shape has
///   void add_closest(shape, point, candidates)
namespace raylane::oracle {

using Place = std::array<Number, 3>;

inline Place place(const core::Vec3d& v) {
    return {Number(v.x), Number(v.y), Number(v.z)};
}
inline Place operator+(const Place& a, const Place& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Place operator*(const Number& s, const Place& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
inline Place operator-(const Place& a, const Place& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Number inner(const Place& a, const Place& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Place outer(const Place& a, const Place& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Number size_of(const Place& a) {
    return sqrt(inner(a, a));
}
inline Number distance(const Place& a, const Place& b) {
    return size_of(a - b);
}
inline Place unit(const Place& a) {
    return (1 / size_of(a)) * a;
}

/// A point of a surface.
struct OnSurface {
    Place point;
    Number distance;
    core::Face face;
    bool is_one_of_many = false; ///< others are as close
};
using OnSurfaces = std::vector<OnSurface>;

/// More than the rounding errors of these numbers, relative to them.
inline Number digits_lost() {
    return Number("1e-85");
}

/// Returns more than the rounding error of a distance from a point, which grows with the
/// coordinates, however small the distance is.
inline Number distance_error(const OnSurface& one, const Place& from) {
    return digits_lost() * (one.distance + size_of(one.point) + size_of(from));
}

inline void add(OnSurfaces& to, const Place& point, const Place& from, int face = 0) {
    to.push_back({point, size_of(point - from), static_cast<core::Face>(face)});
}

inline void add_closest(const core::SphereOf<double>& sphere, const Place& p, OnSurfaces& to) {
    const Place center = place(sphere.center), off = p - center;
    const Place towards = size_of(off) == 0 ? Place{0, 0, 1} : unit(off);
    add(to, center + Number(sphere.radius) * towards, p);
}

inline void add_closest(const core::PlaneOf<double>& plane, const Place& p, OnSurfaces& to) {
    const Place n = unit(place(plane.normal));
    add(to, p - inner(n, p - place(plane.point)) * n, p);
}

/// A frame about an axis. `along`: height of the point above the base; `off`: its distance from the
/// axis; `towards`: unit vector to it.
struct Cylindrical {
    Place base, axis, towards;
    Number length, along, off;

    Cylindrical(const core::Vec3d& from, const core::Vec3d& axis_, const Place& p)
        : base(place(from)), axis(unit(place(axis_))), length(size_of(place(axis_))) {
        along = inner(p - base, axis);
        const Place across = (p - base) - along * axis;
        off = size_of(across);
        if (off > digits_lost() * (size_of(p - base) + length)) {
            towards = unit(across);
            return;
        }
        off = 0;
        int least = 0;
        for (int i = 1; i < 3; ++i)
            if (std::abs(axis_[i]) < std::abs(axis_[least])) least = i;
        Place e{0, 0, 0};
        e[static_cast<std::size_t>(least)] = 1;
        towards = unit(outer(axis, e));
    }
    Place at(const Number& height, const Number& radius) const {
        return base + height * axis + radius * towards;
    }
};

/// Adds the closest point of the disc at a height.
inline void add_disc(const Cylindrical& frame, const Number& height, const Number& radius,
                     const Place& p, OnSurfaces& to, int face) {
    if (frame.off <= radius)
        add(to, p - (frame.along - height) * frame.axis, p, face);
    else
        add(to, frame.at(height, radius), p, face);
}

inline void add_closest(const core::DiscOf<double>& disc, const Place& p, OnSurfaces& to) {
    add_disc(Cylindrical(disc.center, disc.normal, p), 0, Number(disc.radius), p, to, 0);
}

/// Adds points of the segment from (r0, 0) to (r1, length) in the half-plane of the point.
inline void add_slant(const Cylindrical& frame, const Number& r0, const Number& r1, const Place& p,
                      OnSurfaces& to) {
    const Number rise = frame.length, run = r1 - r0;
    Number t = ((frame.off - r0) * run + frame.along * rise) / (run * run + rise * rise);
    t = std::min(std::max(t, Number(0)), Number(1));
    add(to, frame.at(t * rise, r0 + t * run), p, core::body);
}

inline void add_frustum(core::Ends ends, const Cylindrical& frame, double base_radius,
                        double top_radius, const Place& p, OnSurfaces& to) {
    add_slant(frame, Number(base_radius), Number(top_radius), p, to);
    if (ends == core::Ends::open) return;
    add_disc(frame, 0, Number(base_radius), p, to, core::base_cap);
    add_disc(frame, frame.length, Number(top_radius), p, to, core::top_cap);
}

template <core::Ends ends>
void add_closest(const core::CylinderOf<double, ends>& c, const Place& p, OnSurfaces& to) {
    add_frustum(ends, Cylindrical(c.base, c.axis, p), c.radius, c.radius, p, to);
}
template <core::Ends ends>
void add_closest(const core::ConeOf<double, ends>& c, const Place& p, OnSurfaces& to) {
    add_frustum(ends, Cylindrical(c.base, c.axis, p), c.base_radius, c.top_radius, p, to);
}

inline void add_segment(const Place& a, const Place& b, const Place& p, OnSurfaces& to, int face) {
    const Place edge = b - a;
    Number t = inner(p - a, edge) / inner(edge, edge);
    t = std::min(std::max(t, Number(0)), Number(1));
    add(to, a + t * edge, p, face);
}

inline void add_triangle(const Place& a, const Place& b, const Place& c, const Place& p,
                         OnSurfaces& to, int face = 0) {
    const Place n = unit(outer(b - a, c - a));
    const Place foot = p - inner(n, p - a) * n;
    const auto is_left = [&](const Place& from, const Place& end) {
        return inner(n, outer(end - from, foot - from)) >= 0;
    };
    if (is_left(a, b) && is_left(b, c) && is_left(c, a)) add(to, foot, p, face);
    add_segment(a, b, p, to, face);
    add_segment(b, c, p, to, face);
    add_segment(c, a, p, to, face);
}

void add_closest(const core::AnyTriangle auto& t, const Place& p, OnSurfaces& to) {
    add_triangle(place(t.a), place(t.b), place(t.c), p, to);
}

inline void add_closest(const core::BoxOf<double>& box, const Place& p, OnSurfaces& to) {
    const Place edges[] = {place(box.edge_u), place(box.edge_v), place(box.edge_w)};
    for (int face = 0; face < 6; ++face) {
        const int i = face / 2;
        Place a = place(box.corner);
        if (face % 2 == 1) a = a + edges[i];
        const Place b = a + edges[(i + 1) % 3], d = a + edges[(i + 2) % 3];
        const Place c = b + edges[(i + 2) % 3];
        add_triangle(a, b, c, p, to, face);
        add_triangle(a, c, d, p, to, face);
    }
}

/// An ellipsoid's semi-axes and their directions: eigenvectors of the sum of the products of its
/// axes, by Jacobi's rotations.
struct PrincipalAxes {
    Place directions[3];
    Number sizes[3];

    explicit PrincipalAxes(const core::EllipsoidOf<double>& e) {
        const Place axes[] = {place(e.axis_u), place(e.axis_v), place(e.axis_w)};
        Number a[3][3];
        Number v[3][3] = {};
        for (std::size_t i = 0; i < 3; ++i) {
            v[i][i] = 1;
            for (std::size_t j = 0; j < 3; ++j) {
                a[i][j] = 0;
                for (const Place& axis : axes)
                    a[i][j] += axis[i] * axis[j];
            }
        }
        for (int sweep = 0; sweep < 40; ++sweep)
            for (const auto& [i, j] : {std::pair(0, 1), {0, 2}, {1, 2}})
                rotate(a, v, i, j);
        for (std::size_t i = 0; i < 3; ++i) {
            directions[i] = {v[0][i], v[1][i], v[2][i]};
            sizes[i] = sqrt(a[i][i]);
        }
    }

  private:
    static void rotate(Number (&a)[3][3], Number (&v)[3][3], int i, int j) {
        if (abs(a[i][j]) <= Number("1e-99") * sqrt(a[i][i] * a[j][j])) return;
        const Number half = (a[j][j] - a[i][i]) / (2 * a[i][j]);
        const Number t = (half < 0 ? -1 : 1) / (abs(half) + sqrt(half * half + 1));
        const Number c = 1 / sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
            const Number x = a[k][i], y = a[k][j];
            a[k][i] = c * x - s * y;
            a[k][j] = s * x + c * y;
        }
        for (int k = 0; k < 3; ++k) {
            const Number x = a[i][k], y = a[j][k], p = v[k][i], q = v[k][j];
            a[i][k] = c * x - s * y;
            a[j][k] = s * x + c * y;
            v[k][i] = c * p - s * q;
            v[k][j] = s * p + c * q;
        }
    }
};

/// Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid": the root of a
/// falling function, by bisection.
inline void add_closest(const core::EllipsoidOf<double>& e, const Place& p, OnSurfaces& to) {
    const PrincipalAxes axes(e);
    const Place off = p - place(e.center);
    Number z[3], least = axes.sizes[0], most = 0;
    for (int i = 0; i < 3; ++i) {
        z[i] = inner(off, axes.directions[i]);
        least = std::min(least, axes.sizes[i]);
        most = std::max(most, axes.sizes[i]);
    }
    const auto is_least = [&](int i) { return axes.sizes[i] <= least * (1 + digits_lost()); };
    const auto sum_at = [&](const Number& t) {
        Number sum = -1;
        for (int i = 0; i < 3; ++i) {
            const Number part = axes.sizes[i] * z[i] / (t + axes.sizes[i] * axes.sizes[i]);
            sum += part * part;
        }
        return sum;
    };
    const Number scale = size_of(off) + most;
    bool is_off_center = false;
    for (int i = 0; i < 3; ++i)
        is_off_center = is_off_center || (is_least(i) && abs(z[i]) > digits_lost() * scale);
    Number rest = 1, x[3] = {};
    if (!is_off_center)
        for (int i = 0; i < 3; ++i) {
            if (is_least(i)) continue;
            x[i] = axes.sizes[i] * axes.sizes[i] * z[i] /
                   (axes.sizes[i] * axes.sizes[i] - least * least);
            rest -= (x[i] / axes.sizes[i]) * (x[i] / axes.sizes[i]);
        }
    const bool many = !is_off_center && rest >= 0;
    if (many) {
        for (int i = 0; i < 3; ++i)
            if (is_least(i)) {
                x[i] = least * sqrt(rest);
                break;
            }
    } else {
        Number low = -least * least, high = most * scale;
        for (int step = 0; step < 420; ++step) {
            const Number middle = (low + high) / 2;
            (sum_at(middle) > 0 ? low : high) = middle;
        }
        for (int i = 0; i < 3; ++i)
            x[i] = axes.sizes[i] * axes.sizes[i] * z[i] / (high + axes.sizes[i] * axes.sizes[i]);
    }
    Place at = place(e.center);
    for (int i = 0; i < 3; ++i)
        at = at + x[i] * axes.directions[i];
    add(to, at, p);
    to.back().is_one_of_many = many;
}

/// Returns the closest points of a surface: those whose distance is the least, the lowest face
/// first. `scale`: of the rounding errors.
template <class Shape>
OnSurfaces closest_of(const Shape& shape, const core::Vec3d& from) {
    OnSurfaces surfaces;
    const Place p = place(from);
    add_closest(shape, p, surfaces);
    Number least = surfaces[0].distance;
    for (const OnSurface& one : surfaces)
        least = std::min(least, one.distance);
    const Number most = least + distance_error(surfaces[0], p);
    std::erase_if(surfaces, [&](const OnSurface& one) { return one.distance > most; });
    std::stable_sort(surfaces.begin(), surfaces.end(),
                     [](const OnSurface& a, const OnSurface& b) { return a.face < b.face; });
    if (least < digits_lost() * (size_of(surfaces[0].point) + size_of(p))) least = 0;
    for (OnSurface& one : surfaces)
        one.distance = least;
    return surfaces;
}

} // namespace raylane::oracle
