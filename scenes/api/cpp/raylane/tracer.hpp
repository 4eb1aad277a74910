#pragma once

#include "raylane/api.hpp"
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

/// n rays, structure of arrays. Ray i is the set of points origin + t direction for
/// t_min < t <= t_max. The six spans of origins and directions have length n. Each other span has
/// length n or is empty. The caller owns the arrays; they are only read. Real is float or double.
///
/// All finite values are used exactly, but for directions of 0. A ray is refused if a component is
/// infinite or NaN, its direction is 0, or a limit is NaN. It then hits nothing, and
/// QueryStatistics::refused counts it.
///
/// Rays in double with numbers of unusual size take some microseconds each. 0 is usual, and so are
/// the following ranges. Rays from 10^14 times the scene's size away search all of its shapes.
/// - Coordinates: magnitudes from 2^-149 to below 2^128.
/// - The largest component of a direction: from 2^-400 to below 2^400. The others: at least 2^-276
///   of it.
/// - Limits: 0, infinity, and from 2^-500 to below 2^500.
template <class Real>
struct BasicRaySpan {
    std::span<const Real> origin_x{}, origin_y{}, origin_z{};
    /// Directions of any length except zero; t is in units of that length.
    std::span<const Real> direction_x{}, direction_y{}, direction_z{};
    /// Limits compare with t as it is answered: the float nearest to the true t for RaySpan, the
    /// double for DoubleRaySpan. For a DoubleRaySpan and a HitSpan with t and without t_double, it
    /// is the float.
    std::span<const Real> t_min{}; ///< negative values count as 0; empty: 0
    std::span<const Real> t_max{}; ///< empty: infinity
    /// The shape on which each ray starts, from the hit that it continues (HitSpan::shape_id), or
    /// no_shape. The ray then starts exactly on that surface, regardless of the rounding of its
    /// origin. It does not hit that surface at its origin, it cannot miss a surface just behind it,
    /// and it needs no t_min. It can hit the same surface again farther on. An id without a shape
    /// counts as no_shape. Empty: no ray starts on a surface.
    ///
    /// Queries throw InvalidRay, field "origin_shape/7" for ray 7, if an origin is farther from the
    /// shape than rounding explains: 2^-6 of the shape's size for floats, 2^-10 for doubles, and
    /// 2^-18 of the coordinates. Unbounded shapes take any origin. Field "origin_face/7": the shape
    /// has no such face. Field "origin_inward/7": the direction goes to the other side, by an angle
    /// of more than 2^-5 (floats) or 2^-9 (doubles), from the origin and from points that far
    /// beside it, or the number is above 2. The output is then incomplete.
    std::span<const ShapeId> origin_shape{};
    std::span<const std::uint8_t> origin_face{}; ///< HitSpan::face of that hit; empty: 0
    /// 1 if the ray goes to the inside (back) of that surface: it is transmitted after a hit with
    /// `entering` 1, or reflected after one with `entering` 0. 0: to the outside. 2, or empty: the
    /// direction decides, by the exact normal at the origin; a tangent goes to the outside. From a
    /// cone's apex, a ray goes inside if the cone is around it.
    std::span<const std::uint8_t> origin_inward{};
};
using RaySpan = BasicRaySpan<float>;
using DoubleRaySpan = BasicRaySpan<double>;

/// Output arrays for the hits of n rays, structure of arrays. Each span has length n, or length 0
/// if its values are not wanted. The spans must not overlap each other or the spans of the rays.
struct HitSpan {
    std::span<float> t{}; ///< > 0 and finite; infinity where nothing is hit
    /// Unit normal on the outside (front) of the surface, also if the ray hits the back; 0 where
    /// nothing is hit. For a smooth triangle it is the normal of the flat triangle. At grazing
    /// incidence use `entering`, not the normal, to find out whether the ray enters.
    std::span<float> normal_x{}, normal_y{}, normal_z{};
    std::span<ShapeId> shape_id{}; ///< no_shape where nothing is hit
    /// 1 if the ray goes from the outside (front) to the inside (back), or only touches the
    /// surface; 0 if it goes from the inside to the outside, or hits nothing.
    std::span<std::uint8_t> entering{};
    /// Part of the shape's surface, for RaySpan::origin_face; 0 where nothing is hit.
    /// - Box, with points corner + u edge_u + v edge_v + w edge_w: 0 where u = 0, 1 where u = 1, 2
    ///   where v = 0, 3 where v = 1, 4 where w = 0, 5 where w = 1.
    /// - Cylinder and cone: 0 on the side, 1 on the cap at the base, 2 on the cap at the top.
    /// - Other shapes: 0.
    std::span<std::uint8_t> face{};
    /// t as a double; finite where a shape is hit, infinity elsewhere. It takes longer to compute
    /// than all other values together.
    std::span<double> t_double{};
    /// The normal in double: each component is the double nearest to the true one. It takes one to
    /// two microseconds a hit to compute.
    std::span<double> normal_double_x{}, normal_double_y{}, normal_double_z{};
};

/// Rays that continue from the hits of others (spawned, secondary rays): see onward(). Owns all
/// arrays but the directions.
template <class Real>
struct OnwardRays {
    std::vector<Real> origin_x, origin_y, origin_z;
    std::vector<ShapeId> shape_id;
    std::vector<std::uint8_t> face, inward;
    std::span<const Real> direction_x, direction_y, direction_z;

    BasicRaySpan<Real> span() const {
        return {.origin_x = origin_x,
                .origin_y = origin_y,
                .origin_z = origin_z,
                .direction_x = direction_x,
                .direction_y = direction_y,
                .direction_z = direction_z,
                .origin_shape = shape_id,
                .origin_face = face,
                .origin_inward = inward};
    }
};

/// Returns rays from the points of hits, in new directions of any length except zero. Each leaves
/// the surface of its hit, to the side of the normal to which its direction goes. If the direction
/// is so close to a tangent that the rounded normal does not decide this, `inward` is 2. `hits`
/// must have t or t_double (for DoubleRaySpan the better choice), normal_x, normal_y, normal_z,
/// shape_id and face. If a ray hit nothing, the new ray is refused. Throws InvalidValue if a span
/// has a wrong length.
RAYLANE_API OnwardRays<float> onward(const RaySpan& rays, const HitSpan& hits,
                                     std::span<const float> direction_x,
                                     std::span<const float> direction_y,
                                     std::span<const float> direction_z);
RAYLANE_API OnwardRays<double> onward(const DoubleRaySpan& rays, const HitSpan& hits,
                                      std::span<const double> direction_x,
                                      std::span<const double> direction_y,
                                      std::span<const double> direction_z);

/// n points, structure of arrays. All three spans have length n. The caller owns the arrays; they
/// are only read. A point with an infinite or NaN coordinate is refused: it is in no solid, and
/// QueryStatistics::refused counts it.
template <class Real>
struct BasicPointSpan {
    std::span<const Real> x{}, y{}, z{};
};
using PointSpan = BasicPointSpan<float>;
using DoublePointSpan = BasicPointSpan<double>;

/// All crossings of n rays, in compressed rows (CSR), structure of arrays. The crossings of ray i
/// are the elements first[i] to first[i + 1] - 1, in their order along the ray.
struct CrossingRows {
    std::vector<std::uint64_t> first; ///< n + 1 row offsets
    std::vector<double> t;            ///< > 0 and finite
    std::vector<ShapeId> shape_id;
    /// 1 if the ray goes from the outside (front) to the inside (back), 0 if it goes out.
    std::vector<std::uint8_t> entering;
    std::vector<std::uint8_t> face; ///< part of the shape's surface, same as HitSpan::face
    /// 1 for a tie: the crossing is at the same t as the crossing before it in the row.
    std::vector<std::uint8_t> tied;
    /// 1 if the ray is tangent to the shape: it enters and leaves it at the same t. The two
    /// crossings together change nothing.
    std::vector<std::uint8_t> touching;
    std::vector<float> normal_x, normal_y, normal_z; ///< same as in HitSpan; empty if not wanted
    std::vector<double> normal_double_x, normal_double_y, normal_double_z; ///< likewise
};

struct CrossingOptions {
    /// Maximum number of crossings of each ray, nearest first; 0: all. With 1, the search stops at
    /// the first crossing, as that of intersect does. With other numbers it finds all crossings.
    std::size_t most = 0;
    bool normals = false;        ///< true: fill normal_x, normal_y and normal_z
    bool normals_double = false; ///< true: fill normal_double_x and so on
};

/// Counts of a query.
struct QueryStatistics {
    /// Rays with an infinite or NaN component, a direction of 0 or a limit that is NaN, and points
    /// with an infinite or NaN coordinate.
    std::uint64_t refused = 0;
};

/// Counts of a query for all crossings. The first three are of comparisons of crossings. With
/// CrossingOptions::most = 1 and Precision::exact, only `refused` is counted.
struct CrossingStatistics {
    std::uint64_t by_bounds = 0; ///< decided by error bounds in double
    std::uint64_t by_digits = 0; ///< decided with twice the digits of double
    std::uint64_t exactly = 0;   ///< decided in integers of any size

    /// Pairs of ray and shape that needed more than double.
    std::uint64_t beyond_double = 0;
    /// Same as QueryStatistics::refused.
    std::uint64_t refused = 0;
};

/// The solids that contain each of n points, in compressed rows. The solids of point i are the
/// elements first[i] to first[i + 1] - 1, in the order of their ids.
struct SolidRows {
    std::vector<std::uint64_t> first; ///< n + 1 row offsets
    std::vector<ShapeId> shape_id;    ///< of a constructed solid: the id of its first part
    /// 1 if the point counts as inside, by the rule for faces of Tracer. 0 if it is only on the
    /// surface.
    std::vector<std::uint8_t> inside;
    std::vector<std::uint8_t> on_surface; ///< 1 if the point is exactly on the solid's surface
};

/// Output arrays for the cells of n points. Each span has length n, or length 0 if its values are
/// not wanted.
struct CellSpan {
    std::span<ShapeId> shape_id{};        ///< of the solid; no_shape without one
    std::span<MaterialIndex> material{};  ///< inside of the solid; no_material without one
    std::span<std::uint8_t> on_surface{}; ///< 1 if the point is exactly on the solid's surface
};

/// Output arrays for the surface points that are closest to n points. Each span has length n, or
/// length 0 if its values are not wanted.
struct ClosestSpan {
    /// In the scene's unit: the double nearest to the true distance, but 0 only for a point on a
    /// surface, and never infinite. Infinity where no shape is within max_distance.
    std::span<double> distance{};
    /// The closest point: each component is the double nearest to the true one. NaN where no shape
    /// is within max_distance.
    std::span<double> point_x{}, point_y{}, point_z{};
    std::span<ShapeId> shape_id{};  ///< no_shape where no shape is within max_distance
    std::span<std::uint8_t> face{}; ///< same as HitSpan::face; on an edge, the lowest of its faces
};

/// Lengths of n rays inside of materials, in compressed rows. The lengths of ray i are the elements
/// first[i] to first[i + 1] - 1, in the order of their materials.
struct LengthRows {
    std::vector<std::uint64_t> first; ///< n + 1 row offsets
    std::vector<MaterialIndex> material;
    std::vector<double> length; ///< > 0, in the scene's unit, within 1 ulp of the true length;
                                ///< infinite if an unbounded solid contains the ray's end
};

/// Lengths of n rays inside of solids, in compressed rows. The lengths of ray i are the elements
/// first[i] to first[i + 1] - 1, in the order of the solids' ids.
struct SolidLengthRows {
    std::vector<std::uint64_t> first; ///< n + 1 elements
    std::vector<ShapeId> shape_id;    ///< of a constructed solid: the id of its first part
    std::vector<double> length;       ///< same as LengthRows::length
};

struct TracerOptions {
    int threads = 0; ///< maximum, 1 to 4096; 0: the value of RAYLANE_THREADS, or all processors
    /// Precision of the results. With a precision other than exact, `occluded` may disagree with
    /// `intersect` in close cases, and ties may be broken either way.
    Precision precision = Precision::exact;
};

/// Answers ray and point queries about a scene. Cheap to copy. Thread-safe: any number of threads
/// may call any function of one Tracer concurrently. Long spans are divided among worker threads.
/// The result for a ray depends only on the scene and on that ray.
///
/// Pass many rays in one call. Neighbours in the arrays should be neighbours in space: rays from
/// one point, to one point, in one direction or close together are several times as fast as others.
/// With 100 spheres (AVX2, scanlines, one thread) a ray takes 380 ns alone, 120 ns in calls of 16
/// rays, 46 ns in calls of 256 and 43 ns in the longest calls. After the first calls `intersect`
/// and `occluded` allocate no memory.
///
/// With Precision::exact, every result is the one that real arithmetic gives for exactly the given
/// floats or doubles. This holds for all shapes, at any distance between them, and on any
/// processor:
/// - Exact are: which surfaces the ray crosses, their order, and whether the ray enters. A tie
///   occurs only if two t are equal in real arithmetic. Then a surface that the ray enters comes
///   before one that it leaves, and after that the lower id comes first.
/// - t is the float nearest to the true t, but never 0 or infinite. t_double is the nearest double.
///   Limits compare with t as it is answered: see BasicRaySpan::t_min. So a t that is passed back
///   as t_min leads to the next crossing, and skips all crossings that round to the same t; as
///   t_max, it includes its own crossing. `occluded` returns 1 exactly if `intersect` with t_double
///   (for DoubleRaySpan) or t (for RaySpan) finds a shape.
/// - Components of normals are the floats nearest to the components of the true normal at the true
///   crossing. If faces of a box meet there, the normal is that of the first face in the order
///   edge_u, edge_v, edge_w. At the rim of a capped cylinder or cone it is the normal of the side.
///   At the apex of a cone it points along the axis, away from the base. If the gradient of a
///   quadric vanishes, it is (0, 0, 1).
///
/// A line that touches a surface enters and leaves it at the same t. A line that lies in a flat or
/// open surface, or in a quadric, does not hit it there. For lines in faces of solids, and for
/// points of faces, all queries have one rule. A solid is a set of points. Spheres, boxes,
/// cylinders, cones and ellipsoids have the points of their surfaces; half-spaces and quadrics do
/// not, and neither do cylinders and cones that a transform has stretched to quadrics. Union,
/// intersection and difference are those of sets. A point is inside if the set has it, and a line
/// in a face is inside where the set has its points:
/// - in a face of a box, and in the common face of two united boxes, inside;
/// - in the face of a half-space that a solid is intersected with, outside; of one that is
///   subtracted, inside;
/// - in a face that a subtracted box has cut or only touches, outside.
///
/// A line hits the solid where it enters such a stretch and where it leaves it. `cells` and
/// SolidRows::inside have the points by the same rule. A point of the surfaces of parts on which
/// the result depends is also marked by `on_surface`, inside or not, even if a cut left nothing of
/// a face.
///
/// - The parts of a constructed Solid are hit only on the surface of the solid. Hits give the id of
///   the part; the normal and `entering` are those of the solid.
/// - Sides that Material::visible hides are not hit. Glass is hit: every surface occludes.
/// - A crossing at the origin (t = 0) does not count. A computed origin is rarely exactly on its
///   surface, so a ray that continues a hit should set RaySpan::origin_shape.
/// - Shapes with equal numbers and the same material index count as one shape, the first. This does
///   not apply to triangles of polygons.
/// - A refused ray (see BasicRaySpan) hits nothing.
class Tracer {
  public:
    /// Throws InvalidValue, field "threads" or "precision", if an option is out of range, or field
    /// "RAYLANE_THREADS" if the environment variable is needed and invalid.
    explicit Tracer(const Scene& scene, const TracerOptions& options = {});

    // No move operations: a tracer is never empty.
    Tracer(const Tracer&) = default;
    Tracer& operator=(const Tracer&) = default;
    ~Tracer() = default;

    const Scene& scene() const { return scene_; }

    /// Finds the nearest crossing of each ray. This and the other queries replace *statistics,
    /// unless it is null. Throws InvalidValue, a std::invalid_argument, if a span has a wrong
    /// length; the field is the span's name. Throws std::bad_alloc.
    void intersect(const RaySpan& rays, const HitSpan& hits,
                   QueryStatistics* statistics = nullptr) const;
    void intersect(const DoubleRaySpan& rays, const HitSpan& hits,
                   QueryStatistics* statistics = nullptr) const;

    /// Writes 1 for each ray for which intersect would find a shape, and 0 for each other ray.
    /// `occluded` has length n. Throws the same exceptions as intersect.
    void occluded(const RaySpan& rays, std::span<std::uint8_t> occluded,
                  QueryStatistics* statistics = nullptr) const;
    void occluded(const DoubleRaySpan& rays, std::span<std::uint8_t> occluded,
                  QueryStatistics* statistics = nullptr) const;

    /// Finds all crossings of each ray within its limits, or the first CrossingOptions::most of
    /// them, in the order of their true t. The first crossing is the one that intersect finds. At
    /// equal t, which `tied` marks, a surface that is entered comes before one that is left, and
    /// then the lower id comes first. A ray that touches a surface enters and leaves it at one t.
    /// On a common edge of triangles of one polygon, only the one with the lower id counts. Results
    /// are exact at any precision. Replaces the contents of `rows`. Throws the same exceptions as
    /// intersect.
    void crossings(const RaySpan& rays, CrossingRows& rows, const CrossingOptions& options = {},
                   CrossingStatistics* statistics = nullptr) const;
    void crossings(const DoubleRaySpan& rays, CrossingRows& rows,
                   const CrossingOptions& options = {},
                   CrossingStatistics* statistics = nullptr) const;

    /// Stores the number of crossings of each ray: the lengths of the rows of `crossings`. `counts`
    /// has one element for each ray. Results are exact at any precision. Throws the same exceptions
    /// as intersect.
    void count_crossings(const RaySpan& rays, std::span<std::uint64_t> counts,
                         QueryStatistics* statistics = nullptr) const;
    void count_crossings(const DoubleRaySpan& rays, std::span<std::uint64_t> counts,
                         QueryStatistics* statistics = nullptr) const;

    /// Finds the solids that contain each point in their inside or on their surface, as real
    /// arithmetic decides. Solids are spheres, ellipsoids, boxes, capped cylinders and cones, and
    /// constructed solids, under the id of their first part. Clipped solids are open and do not
    /// count. A point on surfaces of a constructed solid's parts is on the solid's surface unless
    /// it is inside, or outside, on either side of each of these surfaces. So the points of a face
    /// that two united boxes have in common are on the surface, as are those of a face that a flush
    /// cut has removed. SolidRows::inside tells whether they count as inside. Results are exact at
    /// any precision. Replaces the contents of `rows`. Throws the same exceptions as intersect.
    void contains(const PointSpan& points, SolidRows& rows,
                  QueryStatistics* statistics = nullptr) const;
    void contains(const DoublePointSpan& points, SolidRows& rows,
                  QueryStatistics* statistics = nullptr) const;

    /// Finds the cell of each point: of the solids that it is inside of (SolidRows::inside), the
    /// one with the highest id, which was added last. So a solid takes the place of all solids that
    /// were added before it, as a fuel rod does in the water of a tank. Results are exact at any
    /// precision. Throws InvalidValue if a span has a wrong length.
    void cells(const PointSpan& points, const CellSpan& cells,
               QueryStatistics* statistics = nullptr) const;
    void cells(const DoublePointSpan& points, const CellSpan& cells,
               QueryStatistics* statistics = nullptr) const;

    /// Finds the surface point that is closest to each point, and its distance. A tie occurs only
    /// if two distances are equal in real arithmetic. Then the lower id counts. Distances from
    /// ellipsoids and quadrics that agree in their first 75 digits count as equal. All sides of
    /// surfaces count, also those that Material::visible hides.
    ///
    /// If several points of the shape are closest, the result is one of them:
    /// - for the centre of a sphere, the one with the largest z;
    /// - for a point on the axis of a disc, cylinder or cone, the one in the direction of the
    ///   cross product of this axis with x, y or z: with that coordinate axis along which this axis
    ///   has the component of the smallest magnitude. If several are equally small, the first
    ///   counts;
    /// - for a box, the one on the lowest face;
    /// - for an ellipsoid or a quadric, any of them, but always the same one.
    ///
    /// A point takes 1.3 us with 10,000 spheres and 3 us with 1,000,000 (one thread). It may take
    /// milliseconds if it is equally close to several shapes, or close to a quadric whose closest
    /// point is on its box.
    ///
    /// `max_distance` has length n, or length 0 for infinity. Shapes farther away do not count. It
    /// compares with the distance as it is answered. A point whose max_distance is NaN is refused.
    /// Results are exact at any precision. Throws InvalidValue, field "scene", if the scene has
    /// constructed solids, which are not supported, and otherwise the same exceptions as cells.
    void closest(const PointSpan& points, const ClosestSpan& closest,
                 std::span<const double> max_distance = {},
                 QueryStatistics* statistics = nullptr) const;
    void closest(const DoublePointSpan& points, const ClosestSpan& closest,
                 std::span<const double> max_distance = {},
                 QueryStatistics* statistics = nullptr) const;

    /// Measures the length of each ray, from t_min to t_max, inside of the solids of each material.
    /// A stretch inside of several solids of one material counts once. A stretch inside of solids
    /// of several materials counts for each of them. t_max may be infinite; lengths in unbounded
    /// solids are then infinite. Results are exact up to the final rounding, at any precision.
    /// Sides that Material::visible hides count. Replaces the contents of `rows`. Throws the same
    /// exceptions as intersect.
    void path_lengths(const RaySpan& rays, LengthRows& rows,
                      QueryStatistics* statistics = nullptr) const;
    void path_lengths(const DoubleRaySpan& rays, LengthRows& rows,
                      QueryStatistics* statistics = nullptr) const;

    /// Measures the length of each ray inside of each solid, same as path_lengths. A stretch inside
    /// of several solids counts for each of them. Solids are those of `contains`.
    void solid_lengths(const RaySpan& rays, SolidLengthRows& rows,
                       QueryStatistics* statistics = nullptr) const;
    void solid_lengths(const DoubleRaySpan& rays, SolidLengthRows& rows,
                       QueryStatistics* statistics = nullptr) const;

  private:
    Scene scene_;
    std::shared_ptr<const simd::StreamTracer> tracer_;
};

} // namespace raylane
