#pragma once

#include "tests/meetings/frame.hpp"

/// Shapes that touch the origin from below: with a face, an edge, a corner, a rim, an apex, or
/// where their surface is level. In small whole numbers, so that they do.
namespace raylane::meetings {

inline float radius_of(const Frame& frame, double radius) {
    return static_cast<float>(radius * frame.length());
}

/// Makes shapes of one kind. `r`: a length that shapes which are to coincide share.
template <class Shape>
struct Touching;

template <>
struct Touching<core::Sphere> {
    static core::Sphere make(const Frame& frame, int r, Random&) {
        return {frame.exact(0, 0, -r), radius_of(frame, r)};
    }
};

template <>
struct Touching<core::Plane> {
    static core::Plane make(const Frame& frame, int, Random& random) {
        return {frame.exact(random.integer(-2, 2), random.integer(-2, 2), 0),
                frame.exact(0, 0, random.integer(1, 3))};
    }
};

template <>
struct Touching<core::Disc> {
    /// About the origin, or with it on its rim.
    static core::Disc make(const Frame& frame, int r, Random& random) {
        const bool rim = random.integer(0, 1) == 0;
        return {rim ? frame.exact(3, 4, 0) : frame.exact(random.integer(-1, 1), 0, 0),
                frame.exact(0, 0, random.integer(1, 3)), radius_of(frame, rim ? 5 : r + 1)};
    }
};

template <>
struct Touching<core::Triangle> {
    /// The origin inside, on an edge, or at a corner.
    static core::Triangle make(const Frame& frame, int r, Random& random) {
        switch (random.integer(0, 2)) {
        case 0:
            return {frame.exact(-r, -1, 0), frame.exact(r, -r, 0), frame.exact(0, r, 0)};
        case 1:
            return {frame.exact(-r, 0, 0), frame.exact(r, 0, 0), frame.exact(1, r, 0)};
        default:
            return {frame.exact(0, 0, 0), frame.exact(r, 0, 0), frame.exact(1, r, 0)};
        }
    }
};

template <>
struct Touching<core::SmoothTriangle> {
    static core::SmoothTriangle make(const Frame& frame, int r, Random& random) {
        const core::Triangle flat = Touching<core::Triangle>::make(frame, r, random);
        return {flat.a, flat.b, flat.c, Vec3f(0, 0, 1), Vec3f(0, 1, 0), Vec3f(1, 0, 0)};
    }
};

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
        case 2: // a face, of a slanted box
            return {frame.exact(-a, -b, 0), frame.exact(a + r, 0, 0), frame.exact(1, b + r, 0),
                    frame.exact(random.integer(-2, 2), random.integer(-2, 2), -r)};
        default: // a face, or its edge or corner
            return {frame.exact(-a, -b, -r), frame.exact(a + 1, 0, 0), frame.exact(0, b + 1, 0),
                    frame.exact(0, 0, r)};
        }
    }
};

template <core::Ends ends>
struct Touching<core::Cylinder<ends>> {
    static core::Cylinder<ends> make(const Frame& frame, int r, Random& random) {
        const int a = random.integer(0, 2), length = random.integer(1, 4);
        const double reach = random.integer(0, 1) == 0 ? length : -length;
        switch (random.integer(0, 3)) {
        case 0: // an end, about the origin or with it on its rim
            if (random.integer(0, 1) == 0)
                return {frame.exact(3, 4, -length), frame.exact(0, 0, length), radius_of(frame, 5)};
            return {frame.exact(0, 0, 0), frame.exact(0, 0, -length), radius_of(frame, r)};
        case 1: // with its rim where it lies
            return {frame.exact(0, 0, -r), frame.exact(reach, 0, 0), radius_of(frame, r)};
        default: // lying
            return {frame.exact(reach > 0 ? -a : a, 0, -r), frame.exact(reach * (a + 1), 0, 0),
                    radius_of(frame, r)};
        }
    }
};

template <core::Ends ends>
struct Touching<core::Cone<ends>> {
    static core::Cone<ends> make(const Frame& frame, int r, Random& random) {
        const int length = random.integer(1, 4);
        switch (random.integer(0, 3)) {
        case 0: // its apex, either way about
            if (random.integer(0, 1) == 0)
                return {frame.exact(0, 0, -length), frame.exact(0, 0, length), radius_of(frame, r),
                        0};
            return {frame.exact(0, 0, 0), frame.exact(0, 0, -length), 0, radius_of(frame, r)};
        case 1: // an end, with the origin on its rim
            return {frame.exact(3, 4, -length), frame.exact(0, 0, length), radius_of(frame, r),
                    radius_of(frame, 5)};
        default: {
            // Lying: it narrows by 3 in 4 along e = (4, 0, 3) / 5, and across is (-3, 0, 4) / 5.
            const int width = 5 * random.integer(1, 2), back = 5 * random.integer(0, 2);
            const int on = 5 * random.integer(back == 0 ? 1 : 0, width / 5);
            const auto point = [&](double across, double along) {
                return frame.exact((4 * along - 3 * across) / 5, 0, (4 * across + 3 * along) / 5);
            };
            const double base_radius = width + 0.75 * back, top_radius = width - 0.75 * on;
            const Vec3f base = point(-width, -back), top = point(-width, on);
            return {base, top - base, radius_of(frame, base_radius), radius_of(frame, top_radius)};
        }
        }
    }
};

/// Balls, pipes, sheets, cups and cones: coincident with what is made of the same length.
template <>
struct Touching<core::Quadric> {
    static core::Quadric make(const Frame& frame, int r, Random& random) {
        core::Quadric q{};
        const auto add_square = [&](int row) {
            const Vec3d v = frame.row(row);
            add(q.xx, v.x * v.x);
            add(q.yy, v.y * v.y);
            add(q.zz, v.z * v.z);
            add(q.xy, v.x * v.y);
            add(q.xz, v.x * v.z);
            add(q.yz, v.y * v.z);
        };
        double up = 0.0; // times z
        switch (random.integer(0, 4)) {
        case 0: // a ball of radius r
            add_square(0);
            add_square(1);
            add_square(2);
            up = r * frame.length() * frame.length();
            break;
        case 1: // a pipe along x
            add_square(1);
            add_square(2);
            up = r * frame.length() * frame.length();
            break;
        case 2: // a sheet
            up = random.integer(1, 3);
            break;
        case 3: // a cup
            add_square(0);
            add_square(1);
            up = r;
            break;
        default: // a cone, its apex here
            add_square(0);
            add_square(1);
            add_square(2);
            q.xx -= static_cast<float>(2 * frame.row(2).x * frame.row(2).x);
            q.yy -= static_cast<float>(2 * frame.row(2).y * frame.row(2).y);
            q.zz -= static_cast<float>(2 * frame.row(2).z * frame.row(2).z);
            q.xy -= static_cast<float>(2 * frame.row(2).x * frame.row(2).y);
            q.xz -= static_cast<float>(2 * frame.row(2).x * frame.row(2).z);
            q.yz -= static_cast<float>(2 * frame.row(2).y * frame.row(2).z);
        }
        q.x = static_cast<float>(up * frame.row(2).x);
        q.y = static_cast<float>(up * frame.row(2).y);
        q.z = static_cast<float>(up * frame.row(2).z);
        // Bounds, half of them with the meeting at a face.
        const float reach = radius_of(frame, 2 * r + random.integer(1, 3));
        q.lower = Vec3f(-reach);
        q.upper = Vec3f(reach);
        if (random.integer(0, 1) == 0) q.lower[random.integer(0, 2)] = 0.0F;
        return q;
    }

  private:
    static void add(float& to, double value) { to += static_cast<float>(value); }
};

template <class Shape>
AnyShape touching(const Frame& frame, int r, Random& random) {
    return Touching<Shape>::make(frame, r, random);
}

using MakeTouching = AnyShape (*)(const Frame&, int, Random&);
inline constexpr MakeTouching make_touching[] = {
    touching<core::Sphere>,       touching<core::Plane>,          touching<core::Disc>,
    touching<core::Triangle>,     touching<core::SmoothTriangle>, touching<core::Box>,
    touching<core::OpenCylinder>, touching<core::CappedCylinder>, touching<core::OpenCone>,
    touching<core::CappedCone>,   touching<core::Quadric>};

} // namespace raylane::meetings
