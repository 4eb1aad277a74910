#pragma once

#include "bench/embree.hpp"
#include "core/scene/scene.hpp"
#include "core/shapes/big_array.hpp"
#include "simd/isa/isa.hpp"

#include <cstddef>
#include <memory>
#include <pmmintrin.h>
#include <vector>
#include <xmmintrin.h>

namespace raylane::bench {

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter>;

/// Makes a device for one thread, limited to an instruction set.
EmbreeDevice make_embree_device(simd::Isa isa);

/// Treats subnormal numbers as 0 in the calling thread, as Embree requires.
class NoDenormals {
  public:
    NoDenormals() { _mm_setcsr(before_ | _MM_FLUSH_ZERO_MASK | _MM_DENORMALS_ZERO_MASK); }
    ~NoDenormals() { _mm_setcsr(before_); }
    NoDenormals(const NoDenormals&) = delete;
    NoDenormals& operator=(const NoDenormals&) = delete;

  private:
    unsigned before_ = _mm_getcsr();
};

/// Embree's geometry for a kind of shape; user geometry if it has none. Cylinders and cones, open
/// ones too, become curves with closed ends.
template <class Shape>
inline constexpr RTCGeometryType geometry_type = RTC_GEOMETRY_TYPE_USER;
template <>
inline constexpr RTCGeometryType geometry_type<core::Sphere> = RTC_GEOMETRY_TYPE_SPHERE_POINT;
template <>
inline constexpr RTCGeometryType geometry_type<core::Disc> = RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT;
template <>
inline constexpr RTCGeometryType geometry_type<core::Triangle> = RTC_GEOMETRY_TYPE_TRIANGLE;
template <core::Ends ends>
inline constexpr RTCGeometryType geometry_type<core::Cylinder<ends>> =
    RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE;
template <core::Ends ends>
inline constexpr RTCGeometryType geometry_type<core::Cone<ends>> =
    RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE;

template <class Shape>
inline constexpr bool embree_has = geometry_type<Shape> != RTC_GEOMETRY_TYPE_USER;

/// A scene in Embree's format: spheres, discs and triangles as they are; cylinders and cones, open
/// ones too, as linear cone curves with closed ends. One geometry for each kind of shape, in the
/// order of the shapes' ids.
class EmbreeScene {
  public:
    /// Returns true if Embree has all of the scene's shapes. It has no surfaces that are visible
    /// from one side only.
    static bool can_hold(const core::Scene& scene);

    EmbreeScene(RTCDevice device, const core::Scene& scene, RTCSceneFlags flags,
                RTCBuildQuality quality);

    RTCScene get() const { return scene_.get(); }

    /// Builds the hierarchy; the constructor only hands over the shapes.
    void commit() { rtcCommitScene(scene_.get()); }

    /// Returns the shapes of a geometry, by primitive.
    const core::BigArray<core::ShapeId>& shapes(unsigned geometry) const { return ids_[geometry]; }
    std::size_t geometry_count() const { return ids_.size(); }
    /// Returns the shape that has been hit, or no_shape.
    core::ShapeId shape(unsigned geometry, unsigned primitive) const {
        return geometry == RTC_INVALID_GEOMETRY_ID ? core::no_shape : ids_[geometry][primitive];
    }

  private:
    struct Deleter {
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    std::vector<core::BigArray<std::byte>> buffers_; // of the geometries
    std::unique_ptr<std::remove_pointer_t<RTCScene>, Deleter> scene_;
    std::vector<core::BigArray<core::ShapeId>> ids_; // by geometry and primitive
};

} // namespace raylane::bench
