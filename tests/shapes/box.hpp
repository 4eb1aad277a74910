#pragma once

#include "tests/shapes/parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace raylane::ray_sets {

template <>
struct Target<core::Box> {
    static core::Box make(Random& r, bool lattice) {
        if (r.integer(0, 1) == 0) { // along the axes
            const auto edge = [&] {
                return lattice ? rounded(r.integer(1, 4)) : rounded(r.log_uniform(1e-2, 10.0));
            };
            const Vec3f corner = lattice ? r.small_integers(3) : rounded(r.cube(10.0));
            return {corner, {edge(), 0, 0}, {0, edge(), 0}, {0, 0, edge()}};
        }
        while (true) {
            const core::Box b = lattice ? core::Box{r.small_integers(3), r.small_integers(3),
                                                    r.small_integers(3), r.small_integers(3)}
                                        : core::Box{rounded(r.cube(10.0)), rounded(r.cube(5.0)),
                                                    rounded(r.cube(5.0)), rounded(r.cube(5.0))};
            const Vec3d u = core::convert<double>(b.edge_u), v = core::convert<double>(b.edge_v);
            if (std::abs(core::dot(core::cross(u, v), core::convert<double>(b.edge_w))) > 1e-3)
                return b;
        }
    }
    static SurfacePoint surface(const core::Box& b, Random& r) {
        const Vec3d edges[3] = {core::convert<double>(b.edge_u), core::convert<double>(b.edge_v),
                                core::convert<double>(b.edge_w)};
        double at[3] = {r.uniform(0.0, 1.0), r.uniform(0.0, 1.0), r.uniform(0.0, 1.0)};
        const int face = r.integer(0, 2);
        at[face] = r.integer(0, 1);
        if (r.integer(0, 2) == 0) at[(face + 1) % 3] = r.integer(0, 1); // an edge
        return {core::convert<double>(b.corner) + at[0] * edges[0] + at[1] * edges[1] +
                    at[2] * edges[2],
                core::normalized(core::cross(edges[(face + 1) % 3], edges[(face + 2) % 3]))};
    }
    static Vec3d center(const core::Box& b) {
        return core::convert<double>(b.corner) +
               0.5 * (core::convert<double>(b.edge_u) + core::convert<double>(b.edge_v) +
                      core::convert<double>(b.edge_w));
    }
    static Vec3d special(const core::Box& b, Random& r) {
        return core::convert<double>(r.integer(0, 1) == 0 ? b.edge_u : b.edge_w);
    }
    static double size(const core::Box& b) { return core::length(core::convert<double>(b.edge_u)); }
};

} // namespace raylane::ray_sets

namespace raylane::tests {

template <>
struct Nature<core::Box> : Solid {};

inline core::Box placed(const core::Box& b, const Placing& by) {
    return {by.point(b.corner), b.edge_u * by.factor(), b.edge_v * by.factor(),
            b.edge_w * by.factor()};
}

template <>
struct NestOf<core::Box> {
    static CloseShells make(double size, Random& r) {
        while (true) {
            const double gap = r.log_uniform(min_gap, std::max(0.25 * size, 6.0));
            const Vec3d n = r.direction(), m = ray_sets::across(n, r);
            Vec3f u = whole(n * (gap * r.uniform(1.0, 1.5)));
            Vec3f v = whole((m + r.cube(0.2)) * (gap * r.uniform(1.0, 1.5)));
            const Vec3f w = whole((core::cross(n, m) + r.cube(0.2)) * (gap * r.uniform(1.0, 1.5)));
            if (r.integer(0, 1) == 0) std::swap(u, v); // a left-handed one
            if (!(height(u, v, w) >= min_gap && height(v, w, u) >= min_gap &&
                  height(w, u, v) >= min_gap))
                continue;
            const float count = number_of_gaps(size, gap);
            const auto box = [&](float by) {
                return core::Box{-by * (u + v + w), (count + 2 * by) * u, (count + 2 * by) * v,
                                 (count + 2 * by) * w};
            };
            return {box(0), box(1), box(-1), true};
        }
    }

  private:
    static double height(const Vec3f& u, const Vec3f& v, const Vec3f& w) {
        const Vec3d face = core::cross(core::convert<double>(v), core::convert<double>(w));
        return std::abs(core::dot(core::convert<double>(u), core::normalized(face)));
    }
};

template <>
struct Restated<core::Box> {
    static core::Box make(int i) {
        const Vec3f corner(-1, -0.5F, -1),
            edges[] = {{2, 0.5F, 0}, {-0.5F, 1.5F, 0}, {0, 0.25F, 2}};
        const Vec3f u = edges[i % 3], v = edges[(i + 1) % 3], w = edges[(i + 2) % 3];
        return i % 2 == 0 ? core::Box{corner, u, v, w} : core::Box{corner + u, -u, v, w};
    }
};

template <>
struct Seamed<core::Box> {
    static core::Box make(Random& r) { return ray_sets::Target<core::Box>::make(r, true); }
    static Seams seams(const core::Box& box, Random& random) {
        const auto share = [&] { return static_cast<float>(random.integer(0, 4)) / 4.0F; };
        return {box.corner + share() * box.edge_u, box.corner + box.edge_u + share() * box.edge_w,
                box.corner + box.edge_v + box.edge_w + share() * box.edge_u,
                box.corner + box.edge_u + box.edge_v + box.edge_w};
    }
};

inline double distance_to_face(const core::Box& box, core::Face face, const Vec3d& point) {
    const std::array edges = {box.edge_u, box.edge_v, box.edge_w};
    const Vec3d normal =
        core::normalized(core::cross(core::convert<double>(edges[(face / 2 + 1) % 3]),
                                     core::convert<double>(edges[(face / 2 + 2) % 3])));
    Vec3d on_face = core::convert<double>(box.corner);
    if (face % 2 == 1) on_face += core::convert<double>(edges[face / 2]);
    return std::abs(core::dot(normal, Vec3d(point - on_face)));
}

template <>
struct Written<core::Box> {
    static constexpr const char* text = R"("type": "box", "corner": [1, 2, 3],
                                           "edges": [[1, 0, 0.5], [0, 2, 0], [0, 0.1, 3]])";
    template <class Box>
    static Box by_name() {
        return {
            .corner = {1, 2, 3}, .edge_u = {1, 0, 0.5}, .edge_v = {0, 2, 0}, .edge_w = {0, 0.1, 3}};
    }
};

} // namespace raylane::tests

namespace raylane::oracle {

/// Returns the normals of the three faces opposite the corner: all outward, or all inward.
inline std::array<Vector, 3> face_normals(const core::BoxOf<double>& box) {
    const Vector edges[3] = {vector(box.edge_u), vector(box.edge_v), vector(box.edge_w)};
    return {outer(edges[1], edges[2]), outer(edges[2], edges[0]), outer(edges[0], edges[1])};
}

/// Returns crossings with each face's plane at which the two other coordinates are within the face.
template <class Real>
std::vector<Hit> crossings(const core::BoxOf<double>& box, const core::Ray<Real>& ray) {
    std::array<Vector, 3> normals = face_normals(box);
    Exact volume = inner(normals[0], vector(box.edge_u));
    if (volume.sign() < 0) {
        volume = -volume;
        for (Vector& normal : normals)
            normal = Exact(-1) * normal;
    }
    const Line line(ray, box.corner);
    std::vector<Hit> on_faces;
    for (int i = 0; i < 3; ++i)
        for (int side = 0; side < 2; ++side) {
            auto hit = plane_crossing(line, normals[i], side == 0 ? Exact() : volume,
                                      static_cast<Face>(2 * i + side));
            if (!hit) continue;
            if (side == 0) hit->entering = !hit->entering;
            bool inside = true;
            for (int j = 0; j < 3; ++j) {
                if (j == i) continue;
                const Exact at = inner(normals[j], line.f), along = inner(normals[j], line.d);
                inside = inside && sign_at(hit->root, at, along) >= 0 &&
                         sign_at(hit->root, at - volume, along) <= 0;
            }
            if (inside) on_faces.push_back(*hit);
        }
    return first_and_last(on_faces);
}

template <class Real>
Normal normal(const core::BoxOf<double>& box, const core::Ray<Real>&, const Hit& hit) {
    const std::array<Vector, 3> normals = face_normals(box);
    const bool left_handed = inner(normals[0], vector(box.edge_u)).sign() < 0;
    const Vector& far = normals[hit.face / 2];
    return Normal::fixed(left_handed == (hit.face % 2 == 0) ? far : opposite(far));
}

inline Ball ball_around(const core::BoxOf<double>& b) {
    return ball(b.corner, length_of(b.edge_u) + length_of(b.edge_v) + length_of(b.edge_w));
}

} // namespace raylane::oracle

namespace raylane::meetings {

template <>
struct Touching<core::Box> {
    static core::Box make(const Frame& frame, int r, Random& random) {
        const int a = random.integer(0, 2), b = random.integer(0, 2);
        switch (random.integer(0, 4)) {
        case 0: // a corner
            return {frame.exact(0, 0, 0), frame.exact(r, 0, -r), frame.exact(0, 1, -1),
                    frame.exact(-1, -1, -1)};
        case 1: // an edge
            return {frame.exact(-a, 0, 0), frame.exact(a + r, 0, 0), frame.exact(0, r, -r),
                    frame.exact(0, -1, -1)};
        case 2: // a face of a slanted box
            return {frame.exact(-a, -b, 0), frame.exact(a + r, 0, 0), frame.exact(1, b + r, 0),
                    frame.exact(random.integer(-2, 2), random.integer(-2, 2), -r)};
        default: // a face, or its edge or corner
            return {frame.exact(-a, -b, -r), frame.exact(a + 1, 0, 0), frame.exact(0, b + 1, 0),
                    frame.exact(0, 0, r)};
        }
    }
    static core::Box shell(const Frame& frame, int r) {
        return {frame.exact(-r, -r, -2 * r), frame.exact(2 * r, 0, 0), frame.exact(0, 2 * r, 0),
                frame.exact(0, 0, 2 * r)};
    }
};

} // namespace raylane::meetings

namespace raylane::hard_cases {

inline core::Box extreme(core::Box b, Random& r) {
    stretch(b.edge_u, b.edge_v, r);
    return b;
}

} // namespace raylane::hard_cases
