#pragma once

#include "raylane/api.h"
#include "raylane/precision.hpp"
#include "raylane/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace raylane::simd {
class StreamTracer;
}

namespace RAYLANE_API raylane {

/// n rays, structure of arrays: ray i is the points origin + t direction with
/// t_min < t <= t_max. n is the length of origin_x; the other five have it too, all others have it
/// or are empty. The arrays are the caller's and are only read. Real is float or double.
///
/// Doubles are taken for exactly what they are, in the range that floats have: components are 0 or
/// of magnitude from 2^-149 to below 2^128, those of a direction beside its largest 0 or down to
/// 2^-276 of that. A ray with others hits nothing.
template <class Real>
struct BasicRaySpan {
    std::span<const Real> origin_x{}, origin_y{}, origin_z{};
    /// Directions of any length but zero; t counts in units of that length.
    std::span<const Real> direction_x{}, direction_y{}, direction_z{};
    std::span<const Real> t_min{}; ///< empty: 0. Less than 0 is 0.
    std::span<const Real> t_max{}; ///< empty: infinity
    /// Shapes that rays leave, or no_shape (as is an id that no shape has): where a hit has said
    /// that it is on one (HitSpan), the ray that goes on from there starts exactly on that surface,
    /// however its numbers were rounded. So it cannot hit what it leaves, unless it comes back to
    /// it, nor miss what is just behind, and needs no t_min. Empty: rays are what their numbers
    /// say.
    std::span<const ShapeId> origin_shape{};
    std::span<const std::uint8_t> origin_face{}; ///< the hit's face; empty: 0
    /// 1 where a ray goes to the inside (back) of what it leaves: where it goes through and the hit
    /// was `entering`, or is thrown back and it was not. 0: to the outside. Empty: 0.
    std::span<const std::uint8_t> origin_inward{};
};
using RaySpan = BasicRaySpan<float>;
using DoubleRaySpan = BasicRaySpan<double>;

/// Hits of n rays, structure of arrays, for the tracer to fill. A span of length 0 is not wanted;
/// the others have length n. None may overlap another or a ray's.
struct HitSpan {
    std::span<float> t{}; ///< > 0 and finite; infinity where nothing is hit
    /// Unit length, perpendicular to the surface on its outside (front), whichever side is hit; 0
    /// where nothing is. A smooth triangle's is the flat one's. Where a ray grazes, it does not
    /// tell whether that enters: `entering` does.
    std::span<float> normal_x{}, normal_y{}, normal_z{};
    std::span<ShapeId> shape{}; ///< no_shape where nothing is hit
    /// 1 where the ray goes from the outside (front) to the inside (back), or touches; 0 where it
    /// comes out, or nothing is hit.
    std::span<std::uint8_t> entering{};
    /// Part of the shape's surface, for RaySpan::origin_face; 0 where nothing is hit.
    std::span<std::uint8_t> face{};
    /// t as a double: finite where anything is hit. It takes longer than all others together.
    std::span<double> t_double{};
};

/// n points, structure of arrays; n is the length of x, and the others have it too. The arrays are
/// the caller's and are only read. A point of which a coordinate is infinite or NaN is in no solid.
template <class Real>
struct BasicPointSpan {
    std::span<const Real> x{}, y{}, z{};
};
using PointSpan = BasicPointSpan<float>;
using DoublePointSpan = BasicPointSpan<double>;

/// All crossings of n rays, by ray and then in their order: compressed rows, structure of arrays.
/// Those of ray i have the numbers from first[i] up to first[i + 1].
struct CrossingRows {
    std::vector<std::uint64_t> first; ///< n + 1
    std::vector<double> t;            ///< > 0 and finite
    std::vector<ShapeId> shape;
    /// 1 where the ray goes from the outside (front) to the inside (back), 0 where it comes out.
    std::vector<std::uint8_t> entering;
    std::vector<std::uint8_t> face; ///< part of the shape's surface, as HitSpan::face has it
    /// 1 where it is at the same t as the crossing before it in the row.
    std::vector<std::uint8_t> tied;
    /// 1 where the shape is entered and left at the same t, as where a ray is tangent: both
    /// crossings together change nothing.
    std::vector<std::uint8_t> touching;
    std::vector<float> normal_x, normal_y, normal_z; ///< as HitSpan has them; empty if not wanted
};

struct CrossingOptions {
    std::size_t most = 0; ///< of each ray, its first crossings; 0: all
    bool normals = false;
};

/// By what the order of crossings was decided, each two that were compared; and for how many pairs
/// of ray and shape double was not enough to tell whether they meet, and where.
struct CrossingStatistics {
    std::uint64_t by_bounds = 0; ///< in double
    std::uint64_t by_digits = 0; ///< twice the digits of double
    std::uint64_t exactly = 0;   ///< integers of any size
    std::uint64_t beyond_double = 0;
};

/// Solids that n points are in, by point and then by id: those of point i have the numbers from
/// first[i] up to first[i + 1].
struct SolidRows {
    std::vector<std::uint64_t> first; ///< n + 1
    std::vector<ShapeId> shape;
    std::vector<std::uint8_t> on_surface; ///< 1 where the point is exactly on the solid's surface
};

/// Lengths of n rays inside of materials, by ray and then by material: those of ray i have the
/// numbers from first[i] up to first[i + 1].
struct LengthRows {
    std::vector<std::uint64_t> first; ///< n + 1
    std::vector<MaterialIndex> material;
    std::vector<double> length; ///< > 0, in the scene's unit, within an ulp of the true one;
                                ///< infinite for what has no end
};

struct TracerOptions {
    int threads = 0; ///< at most, 1 to 4096; 0: as RAYLANE_THREADS says, or all of the machine
    /// Precision of the answers. With others than exact, `occluded` may say otherwise than
    /// `intersect` where that is close, and ties may go either way.
    Precision precision = Precision::exact;
};

/// Asks rays about a scene. Cheap to copy. All functions may be called by any number of threads at
/// a time on one Tracer; long spans are shared out among threads of its own. What a ray hits
/// depends on the scene and that ray alone.
///
/// Ask for many rays at once: a call costs half a microsecond by itself, which from 256 rays on is
/// little. Among 100 spheres (AVX-512, scanlines, one thread) a ray takes 600 ns alone, 44 in calls
/// for 16, 19 in those for 256 and 18 in the longest. After the first calls nothing is allocated.
///
/// With Precision::exact, all that is answered is what real arithmetic gives for exactly the floats
/// or doubles given, whatever the shapes, however near they are to each other and on any processor:
/// - Which surface is crossed, which is first, and whether the ray enters. A tie is where t is the
///   same in real arithmetic, and nowhere else. Then what the ray enters comes before what it
///   leaves, and then the lower id.
/// - t is the float nearest to the true one, but never 0 or infinite, and t_double the double. The
///   limits of rays in float compare with that float: so each t, given back as t_min, leads on to
///   the next crossing; of crossings that round to one float, it passes all. The limits of rays in
///   double compare with the true t, which nextafter(t_double, infinity) is surely behind.
///   `occluded` says 1 where `intersect` finds a shape.
/// - Components of normals are the floats nearest to those of the true normal where the crossing
///   truly is. Where faces of a box meet, it is that of edge_u before edge_v before edge_w; at the
///   rim of a capped cylinder or cone, the side's; at the apex of a cone, along the axis away from
///   the base; where the gradient of a quadric vanishes, (0, 0, 1).
///
/// A line that touches a surface enters it, and leaves it at the same t. One that lies in a flat or
/// open surface, or in a quadric, does not hit it there; one in a face or along the side of a solid
/// does, where it comes upon it.
///
/// - Parts of a Solid that is made of others are crossed where the solid has its surface; hits say
///   which part that is, and normals, and whether the ray enters, are the solid's.
/// - Sides that Material::visible hides are not hit. Glass is: any surface occludes.
/// - A crossing at the origin itself (t = 0) is none. But an origin that was computed is seldom
///   exactly on its surface: let such rays name what they leave (RaySpan::origin_shape).
/// - Shapes that are the same, float by float and by the index of their material, count as the
///   first of them; but for triangles of polygons.
/// - A ray of which a component is infinite or NaN, or its direction 0, or a limit NaN, hits
///   nothing.
class Tracer {
  public:
    /// Throws InvalidValue for options that are none.
    explicit Tracer(const Scene& scene, const TracerOptions& options = {});

    const Scene& scene() const { return scene_; }

    /// The nearest crossing of each ray. Throws InvalidValue, which is a std::invalid_argument,
    /// where a span has another length; its field is the span's name. Throws std::bad_alloc.
    void intersect(const RaySpan& rays, const HitSpan& hits) const;
    void intersect(const DoubleRaySpan& rays, const HitSpan& hits) const;

    /// 1 where a ray has a crossing, 0 where it has none: for the same rays, where intersect would
    /// find a shape. `occluded` has length n. Throws as intersect does.
    void occluded(const RaySpan& rays, std::span<std::uint8_t> occluded) const;
    void occluded(const DoubleRaySpan& rays, std::span<std::uint8_t> occluded) const;

    /// All crossings of each ray within its limits, in the order of their true t, or the first
    /// `most` of them: what intersect finds is the first. At the same t what is entered comes
    /// before what is left, and then the lower id: `tied` says so. A ray that touches a surface
    /// enters and leaves it there. Of triangles of one polygon, the one with the lower id counts
    /// where they meet. Answers are exact, whatever the precision. Rows are replaced. Throws as
    /// intersect does.
    void crossings(const RaySpan& rays, CrossingRows& rows, const CrossingOptions& options = {},
                   CrossingStatistics* statistics = nullptr) const;
    void crossings(const DoubleRaySpan& rays, CrossingRows& rows,
                   const CrossingOptions& options = {},
                   CrossingStatistics* statistics = nullptr) const;

    /// The solids (spheres, ellipsoids, boxes, capped cylinders and cones, and those that are made
    /// of others, which go by the id of their first part, but for those that are clipped, which are
    /// open) that each point is in, or on the surface
    /// of: as real arithmetic says. A point on the surface of parts counts as inside, or outside,
    /// of their solid if it were so whichever side of these it is on. Rows are replaced. Throws as
    /// intersect does.
    void contains(const PointSpan& points, SolidRows& rows) const;
    void contains(const DoublePointSpan& points, SolidRows& rows) const;

    /// How much of each ray, from t_min to t_max, is inside of the solids of each material: what is
    /// in several solids of one material counts once, and what is in solids of several materials
    /// for each of them. t_max may be infinite, and then so are lengths in what has no end. Answers
    /// are exact up to the last rounding, whatever the precision. Rows are replaced. Throws as
    /// intersect does.
    void path_lengths(const RaySpan& rays, LengthRows& rows) const;
    void path_lengths(const DoubleRaySpan& rays, LengthRows& rows) const;

  private:
    Scene scene_;
    std::shared_ptr<const simd::StreamTracer> tracer_;
};

} // namespace raylane
