#pragma once

#include "core/numbers/vector.hpp"
#include "core/shapes/ray.hpp"
#include "core/shapes/types.hpp"
#include "tests/meetings/frame.hpp"
#include "tests/oracle/line.hpp"
#include "tests/shapes/close_shells.hpp"
#include "tests/support/placing.hpp"
#include "tests/support/random.hpp"

#include <array>
#include <utility>

/// Random shapes, and points to aim at.
namespace raylane::ray_sets {

/// Makes a shape and ways to aim at it: points on it, tangents there, and the shape's special
/// directions.
template <class Shape>
struct Target;

struct SurfacePoint {
    Vec3d point;
    Vec3d normal;
};

} // namespace raylane::ray_sets

namespace raylane::oracle {

/// A ball that contains a shape. Each shape's file defines
///   Ball ball_around(shape)
struct Ball {
    core::Vec3d center;
    double radius;
};

inline double length_of(const core::Vec3d& v) {
    return core::length(v);
}

inline Ball ball(const core::Vec3d& center, double radius) {
    constexpr double slack = 1.0 + 0x1p-20; // far more than the rounding errors here
    return {center, radius * slack};
}

} // namespace raylane::oracle

/// Shapes that touch the origin from below: with a face, an edge, a corner, a rim, an apex, or a
/// point where their surface is level. Their numbers are small integers, so that they touch
/// exactly.
namespace raylane::meetings {

inline float radius_of(const Frame& frame, double radius) {
    return static_cast<float>(radius * frame.length());
}

/// Makes shapes of one kind. Shapes that are to coincide share the length `r`. Some kinds also have
///   Shape shell(frame, r)
/// which has its highest point at the origin, and its centre r below.
template <class Shape>
struct Touching;

} // namespace raylane::meetings

/// Changes any shape by its floats. Files of shapes overload these functions where this does not
/// suffice.
namespace raylane::hard_cases {

using ray_sets::Random;

inline core::Vec3d in_double(const core::Vec3f& v) {
    return core::convert<double>(v);
}

/// Returns the shape, `scale` times as large.
template <class Shape>
Shape scaled(const Shape& shape, double scale) {
    core::Numbers<Shape> floats = core::numbers_of(shape);
    for (float& value : floats)
        value = static_cast<float>(static_cast<double>(value) * scale);
    return core::shape_of<Shape>(floats);
}

/// Returns a long, flat, slender or blunt shape: of proportions that the usual targets do not have.
/// By default, returns the shape itself.
template <class Shape>
Shape extreme(const Shape& shape, Random&) {
    return shape;
}

/// Makes a shape of edges or axes long or short, and half of them slanted.
inline void stretch(core::Vec3f& u, core::Vec3f& v, Random& r) {
    u = core::convert<float>(core::Vec3d(in_double(u) * r.log_uniform(1e-4, 1e3)));
    if (r.integer(0, 1) == 0)
        v = core::convert<float>(core::Vec3d(in_double(u) * r.log_uniform(0.1, 10.0) +
                                             in_double(v) * r.log_uniform(1e-3, 1.0)));
}

/// Changes the frame: swaps two coordinates.
template <class Shape>
void swap_axes(Shape& shape, int a, int b) {
    core::Numbers<Shape> floats = core::numbers_of(shape);
    for (int vector = 0; vector < core::number_count<Shape> / 3; ++vector)
        std::swap(floats[3 * vector + a], floats[3 * vector + b]);
    shape = core::shape_of<Shape>(floats);
}

} // namespace raylane::hard_cases

/// Parts that tests need of a shape. All of them are in the shape's file in this folder:
///   tests::Nature                  the traits by which tests choose shapes
///   ray_sets::Target               makes random shapes, and points to aim at
///   oracle::crossings, normal      exact crossings with a line
///   oracle::ball_around            a ball around the shape
///   tests::placed                  the shape moved and scaled
///   meetings::Touching             a shape that touches others
///   tests::NestOf                  a shape close between two others
///   tests::Restated                the same surface in other numbers
///   tests::Written                 a shape as text of a file and as code
///   tests::Seamed                  solids: points where faces meet
///   tests::distance_to_face        solids, and shapes with has_displacement
///   hard_cases::scaled, extreme, swap_axes   for shapes that differ from the default
/// A part that is missing and used does not compile.
namespace raylane::tests {

/// Traits of a surface. Each shape's Nature is Solid, Flat or Curved, and may override the other
/// traits.
struct AnySurface {
    static constexpr bool is_bounded = true;
    /// True if rays that leave the surface outward may meet it again.
    static constexpr bool may_come_back = false;
    /// True if the displacement by rounding to float has a bound.
    static constexpr bool has_displacement = false;
    /// True if many such shapes may form one polygon.
    static constexpr bool tiles_polygons = false;
    /// True if the filter also has a cheap test that rejects rays that miss the shape.
    static constexpr bool is_sifted = false;
};
/// A closed surface: a ray that enters also leaves.
struct Solid : AnySurface {};
/// A ray that leaves the surface does not meet it again.
struct Flat : AnySurface {};
/// A surface that ends at a rim. A ray that goes inward from it may meet it again.
struct Curved : AnySurface {};

template <class Shape>
struct Nature;

/// One surface in several descriptions, for i = 0, 1, 2, ... They are equal in real numbers but
/// differ in their numbers, if the shape has more than one.
template <class Shape>
struct Restated;

/// Solids of small integers, and four points for each, where two faces meet or the wall ends in a
/// point. The points have small integers, too, as far as possible.
template <class Shape>
struct Seamed;

/// The text of a shape's object in a scene file, `text`, and by_name<Shape>(), the same shape by
/// names of fields. The names are the same in the library and in core.
template <class Shape>
struct Written;

using Seams = std::array<Vec3f, 4>;

/// Returns a number whose fifths make Pythagorean triples.
inline float five_times(int least, Random& random) {
    return static_cast<float>(5 * random.integer(least, 2));
}

} // namespace raylane::tests
