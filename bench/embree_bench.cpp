#include "bench/embree_scene.hpp"
#include "bench/method_rays.hpp"
#include "simd/isa/isa.hpp"

#include <algorithm>
#include <limits>

/// Measures Embree, by its public interface, with the rays and shapes of the methods' benchmarks,
/// as far as it has the shape: spheres, cylinders and cones with caps (as linear cone curves),
/// discs and triangles. It takes floats, so the rays are rounded before the clock starts. It does
/// not normalise its normals.

namespace raylane::bench {

namespace {

using core::Kind;

/// True if Embree has this kind of shape exactly: it closes open ones.
template <class Shape>
constexpr bool has_as_such = embree_has<Shape>;
template <>
constexpr bool has_as_such<core::OpenCylinder> = false;
template <>
constexpr bool has_as_such<core::OpenCone> = false;

constexpr std::size_t wide = 16;

/// All rays, in structures of 16, aligned as Embree requires.
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

/// `single`: ray by ray; otherwise 16 at a time.
template <class Shape, bool hard>
void find(benchmark::State& state, simd::Isa isa, bool single) {
    const auto& method_rays = MethodRays<Shape, hard>::get();
    const EmbreeDevice device = make_embree_device(isa);
    EmbreeScene scene(device.get(), method_rays.scene, RTC_SCENE_FLAG_ROBUST,
                      RTC_BUILD_QUALITY_HIGH);
    scene.commit();
    const WideRays rays(method_rays.paths);
    std::vector<RTCRayHit> lone(method_ray_count), lone_start(method_ray_count);
    for (std::size_t i = 0; i < method_ray_count; ++i)
        lone_start[i] = rays.single(i);
    WideRays packets = rays;
    alignas(64) int valid[wide];
    std::fill_n(valid, wide, -1);
    EmbreeQuery query(/*coherent=*/false);
    for (auto _ : state) {
        if (single) {
            lone = lone_start;
            for (RTCRayHit& ray : lone)
                query.nearest(scene.get(), ray);
        } else {
            packets = rays;
            for (std::size_t i = 0; i < packets.size(); ++i)
                query.nearest(scene.get(), valid, packets[i]);
        }
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(method_ray_count) * state.iterations());
    std::vector<Crossed> found;
    for (std::size_t i = 0; i < method_ray_count; ++i)
        found.push_back(
            crossed(single ? lone[i] : packets.single(i), method_rays.data, core::kind_of<Shape>));
    report_errors(state, method_rays.truths, found);
}

template <class Shape, bool hard>
void add() {
    for (const simd::Isa isa : simd::available_isas())
        for (const bool single : {true, false})
            benchmark::RegisterBenchmark(
                ("methods/" + benchmark_name<Shape>() + (hard ? "/hard/" : "/random/") +
                 (single ? "embree_single/" : "embree_16/") + std::string(simd::name_of(isa)))
                    .c_str(),
                [=](benchmark::State& state) { find<Shape, hard>(state, isa, single); });
}

const bool registered = [] {
    for_each_kind([]<class Shape>() {
        if constexpr (has_as_such<Shape>) {
            add<Shape, false>();
            add<Shape, true>();
        }
    });
    return true;
}();

} // namespace

} // namespace raylane::bench
