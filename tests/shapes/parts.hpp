#pragma once

#include "core/shapes/ray.hpp"
#include "tests/meetings/touching.hpp"
#include "tests/oracle/ball.hpp"
#include "tests/oracle/normal.hpp"
#include "tests/placing.hpp"
#include "tests/simd/nest.hpp"
#include "tests/simd/variation.hpp"
#include "tests/target.hpp"

#include <array>

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
    /// Rays that leave the surface outward may meet it again.
    static constexpr bool may_come_back = false;
    /// The displacement by rounding to float has a bound.
    static constexpr bool has_displacement = false;
    /// Many such shapes may form one polygon.
    static constexpr bool tiles_polygons = false;
    /// The filter also has a cheap test for shapes that a ray misses.
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
