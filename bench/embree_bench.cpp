#include "bench/method_rays.hpp"
#include "simd/isa.hpp"

#include <cmath>
#include <cstring>
#include <embree3/rtcore.h>
#include <limits>
#include <memory>
#include <new>

/// Embree, by its public interface, on the rays and shapes of the methods' benchmarks, where it
/// has the shape: spheres, cylinders and cones with caps as linear cone curves, discs and
/// triangles. It takes floats, so the rays are rounded before the clock starts. Its normals are not
/// brought to unit length.

namespace raylane::bench {

namespace {

using core::Kind;

/// What Embree makes of a kind of shape: the type of geometry, and how many vertices a shape has.
template <class Shape>
constexpr bool embree_has =
    core::kind_of<Shape> == Kind::sphere || core::kind_of<Shape> == Kind::disc ||
    core::kind_of<Shape> == Kind::triangle || core::kind_of<Shape> == Kind::capped_cylinder ||
    core::kind_of<Shape> == Kind::capped_cone;

template <class Shape>
constexpr RTCGeometryType geometry_type() {
    switch (core::kind_of<Shape>) {
    case Kind::sphere:
        return RTC_GEOMETRY_TYPE_SPHERE_POINT;
    case Kind::disc:
        return RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT;
    case Kind::triangle:
        return RTC_GEOMETRY_TYPE_TRIANGLE;
    default:
        return RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE;
    }
}

void put(float* to, const core::Vec3f& v) {
    for (int axis = 0; axis < 3; ++axis)
        to[axis] = v[axis];
}

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDeleter>;

float* new_vertices(RTCGeometry geometry, RTCFormat format, std::size_t stride, std::size_t count) {
    return static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, format, stride, count));
}

unsigned* new_indices(RTCGeometry geometry, RTCFormat format, std::size_t stride) {
    return static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                          format, stride, method_shape_count));
}

template <class Shape, bool hard>
void fill(RTCGeometry geometry, const MethodRays<Shape, hard>& of) {
    constexpr Kind kind = core::kind_of<Shape>;
    constexpr auto count = static_cast<std::size_t>(method_shape_count);
    if constexpr (kind == Kind::triangle) {
        float* v = new_vertices(geometry, RTC_FORMAT_FLOAT3, 12, 3 * count);
        unsigned* index = new_indices(geometry, RTC_FORMAT_UINT3, 12);
        for (unsigned i = 0; i < count; ++i) {
            const Shape shape = of.shape(static_cast<int>(i));
            put(v + 9 * i, shape.a);
            put(v + 9 * i + 3, shape.b);
            put(v + 9 * i + 6, shape.c);
            for (unsigned corner = 0; corner < 3; ++corner)
                index[3 * i + corner] = 3 * i + corner;
        }
    } else if constexpr (kind == Kind::sphere || kind == Kind::disc) {
        float* v = new_vertices(geometry, RTC_FORMAT_FLOAT4, 16, count);
        for (unsigned i = 0; i < count; ++i) {
            const Shape shape = of.shape(static_cast<int>(i));
            put(v + 4 * i, shape.center);
            v[4 * i + 3] = shape.radius;
        }
        if constexpr (kind == Kind::disc) {
            auto* n = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL,
                                                                  0, RTC_FORMAT_FLOAT3, 12, count));
            for (unsigned i = 0; i < count; ++i)
                put(n + 3 * i, of.shape(static_cast<int>(i)).normal);
        }
    } else {
        float* v = new_vertices(geometry, RTC_FORMAT_FLOAT4, 16, 2 * count);
        unsigned* index = new_indices(geometry, RTC_FORMAT_UINT, 4);
        for (unsigned i = 0; i < count; ++i) {
            const Shape shape = of.shape(static_cast<int>(i));
            put(v + 8 * i, shape.base);
            put(v + 8 * i + 4, shape.base + shape.axis);
            if constexpr (kind == Kind::capped_cylinder) {
                v[8 * i + 3] = v[8 * i + 7] = shape.radius;
            } else {
                v[8 * i + 3] = shape.base_radius;
                v[8 * i + 7] = shape.top_radius;
            }
            index[i] = 2 * i;
        }
    }
}

template <class Shape, bool hard>
EmbreeScene make_scene(RTCDevice device, const MethodRays<Shape, hard>& of) {
    EmbreeScene scene(rtcNewScene(device));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device, geometry_type<Shape>());
    fill(geometry, of);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
}

constexpr std::size_t wide = 16;

/// All rays, in structures of 16, aligned as Embree wants them.
class WideRays {
  public:
    explicit WideRays(const simd::Paths& paths) : rays_(method_ray_count / wide) {
        for (std::size_t i = 0; i < method_ray_count; ++i) {
            RTCRay16& ray = rays_[i / wide].ray;
            const std::size_t lane = i % wide;
            float* const origin[] = {ray.org_x, ray.org_y, ray.org_z};
            float* const direction[] = {ray.dir_x, ray.dir_y, ray.dir_z};
            for (int axis = 0; axis < 3; ++axis) {
                origin[axis][lane] = static_cast<float>(paths.origin[axis][i]);
                direction[axis][lane] = static_cast<float>(paths.direction[axis][i]);
            }
            ray.tnear[lane] = 0.0F;
            ray.tfar[lane] = std::numeric_limits<float>::infinity();
            ray.mask[lane] = ~0U;
            rays_[i / wide].hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
        }
    }

    const RTCRayHit16& operator[](std::size_t i) const { return rays_[i]; }
    RTCRayHit16& operator[](std::size_t i) { return rays_[i]; }
    std::size_t size() const { return rays_.size(); }

    RTCRayHit single(std::size_t i) const {
        const RTCRayHit16& from = rays_[i / wide];
        return rtcGetRayHitFromRayHitN(
            reinterpret_cast<RTCRayHitN*>(const_cast<RTCRayHit16*>(&from)), wide,
            static_cast<unsigned>(i % wide));
    }

  private:
    std::vector<RTCRayHit16> rays_;
};

Crossed crossed(const RTCRayHit& found, const simd::SceneData& data, Kind kind) {
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const float along = found.hit.Ng_x * found.ray.dir_x + found.hit.Ng_y * found.ray.dir_y +
                        found.hit.Ng_z * found.ray.dir_z;
    return {data.slot_of(kind, {0, static_cast<std::uint8_t>(found.hit.primID)}), along < 0.0F,
            static_cast<double>(found.ray.tfar)};
}

/// `single`: ray by ray; else 16 at a time.
template <class Shape, bool hard>
void find(benchmark::State& state, simd::Isa isa, bool single) {
    const auto& of = MethodRays<Shape, hard>::get();
    const std::string config = "threads=1,isa=" + std::string(simd::name_of(isa));
    const Device device(rtcNewDevice(config.c_str()));
    const EmbreeScene scene = make_scene(device.get(), of);
    const WideRays rays(of.paths);
    std::vector<RTCRayHit> lone(method_ray_count), lone_start(method_ray_count);
    for (std::size_t i = 0; i < method_ray_count; ++i)
        lone_start[i] = rays.single(i);
    WideRays packets = rays;
    alignas(64) int valid[wide];
    std::fill_n(valid, wide, -1);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (auto _ : state) {
        if (single) {
            lone = lone_start;
            for (RTCRayHit& ray : lone)
                rtcIntersect1(scene.get(), &context, &ray);
        } else {
            packets = rays;
            for (std::size_t i = 0; i < packets.size(); ++i)
                rtcIntersect16(valid, scene.get(), &context, &packets[i]);
        }
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(method_ray_count) * state.iterations());
    std::vector<Crossed> found;
    for (std::size_t i = 0; i < method_ray_count; ++i)
        found.push_back(
            crossed(single ? lone[i] : packets.single(i), of.data, core::kind_of<Shape>));
    report_errors(state, of.truths, found);
}

template <class Shape, bool hard>
void add() {
    for (const simd::Isa isa : simd::all_isas)
        if (simd::is_available(isa))
            for (const bool single : {true, false})
                benchmark::RegisterBenchmark(
                    ("methods/" + benchmark_name<Shape>() + (hard ? "/hard/" : "/random/") +
                     (single ? "embree_single/" : "embree_16/") + std::string(simd::name_of(isa)))
                        .c_str(),
                    [=](benchmark::State& state) { find<Shape, hard>(state, isa, single); });
}

const bool registered = [] {
    for_each_kind([]<class Shape>() {
        if constexpr (embree_has<Shape>) {
            add<Shape, false>();
            add<Shape, true>();
        }
    });
    return true;
}();

} // namespace

} // namespace raylane::bench
