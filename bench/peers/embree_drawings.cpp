#include "bench/by_id.hpp"
#include "bench/embree_scene.hpp"
#include "bench/peers/measure.hpp"
#include "simd/query/tracing.hpp"

#include <algorithm>
#include <cmath>

/// raylane's wavefront with Precision::robust, but with Embree's calls in place of its traversal.
namespace raylane::bench {

namespace {

using simd::no_slot;

constexpr std::size_t width = 16;

/// A way to call Embree.
struct Way {
    const char* name;
    bool by_16;
    bool filters; ///< otherwise rays start a little ahead
};
constexpr Way ways[] = {{"embree 16 ahead", true, false},
                        {"embree 16 filter", true, true},
                        {"embree 1 ahead", false, false},
                        {"embree 1 filter", false, true}};

struct Traversal {
    EmbreeDevice device;
    EmbreeScene scene;
    std::vector<std::vector<std::uint32_t>> slots; // by geometry and primitive

    Traversal(const simd::SceneData& data, simd::Isa isa, bool filters)
        : device(make_embree_device(isa)),
          scene(device.get(), data.scene(),
                filters ? EmbreeQuery::filter_flag : RTC_SCENE_FLAG_NONE,
                RTC_BUILD_QUALITY_MEDIUM) {
        scene.commit();
        std::vector<std::uint32_t> slot_of(data.scene().shape_count());
        core::for_each_table(data.scene().shapes(),
                             [&]<class Shape>(const core::Table<Shape>& table) {
                                 for (const auto& [id, place] : places_by_id(table))
                                     slot_of[id] = data.slot_of(core::kind_of<Shape>, place);
                             });
        for (unsigned geometry = 0; geometry < scene.geometry_count(); ++geometry) {
            slots.emplace_back();
            for (const core::ShapeId id : scene.shapes(geometry))
                slots.back().push_back(slot_of[id]);
        }
    }
};

// Kernels are plain functions, so these are global.
const Traversal* traversal = nullptr;
Way way{};

/// Rejects hits with the shapes that rays leave.
void reject_departed(const RTCFilterFunctionNArguments* hits) {
    const auto& rays = *static_cast<const simd::RoundedRays*>(EmbreeQuery::data_for(*hits));
    for (unsigned i = 0; i < hits->N; ++i) {
        if (hits->valid[i] == 0) continue;
        const unsigned lane = RTCRayN_id(hits->ray, hits->N, i);
        const core::IdRange departed{rays.origin_first[lane], rays.origin_last[lane]};
        const core::ShapeId id = traversal->scene.shape(RTCHitN_geomID(hits->hit, hits->N, i),
                                                        RTCHitN_primID(hits->hit, hits->N, i));
        if (departed.contains(id)) hits->valid[i] = 0;
    }
}

/// Returns a ten-thousandth of the largest coordinate. A thirtieth of that, as in RaySet::t_lowest,
/// makes three times as many pixels of balls.nff wrong, because surfaces shadow themselves.
float t_lowest(const simd::RoundedRays& rays, std::size_t lane) {
    if (way.filters || rays.origin_first[lane] == no_slot) return 0.0F;
    float largest = 0.0F;
    for (const float* origin : rays.origin)
        largest = std::max(largest, std::abs(origin[lane]));
    return 1e-4F * largest;
}

/// Returns true if a ray's numbers are finite. If Embree reports a hit and a float formula finds no
/// crossing, secondary rays have no start, and their numbers are not finite. Embree does not accept
/// these.
bool is_any(const simd::RoundedRays& rays, std::size_t lane) {
    return std::isfinite(rays.origin[0][lane] + rays.direction[0][lane]);
}

RTCRay ray_of(const simd::RoundedRays& rays, std::size_t lane, float t_limit) {
    RTCRay ray{};
    ray.org_x = rays.origin[0][lane];
    ray.org_y = rays.origin[1][lane];
    ray.org_z = rays.origin[2][lane];
    ray.dir_x = rays.direction[0][lane];
    ray.dir_y = rays.direction[1][lane];
    ray.dir_z = rays.direction[2][lane];
    ray.tnear = t_lowest(rays, lane);
    ray.tfar = t_limit;
    ray.mask = ~0U;
    ray.id = static_cast<unsigned>(lane);
    return ray;
}

void fill(RTCRay16& packet, const simd::RoundedRays& rays, std::size_t begin,
          const float* t_limit) {
    float* const origin[] = {packet.org_x, packet.org_y, packet.org_z};
    float* const direction[] = {packet.dir_x, packet.dir_y, packet.dir_z};
    for (int axis = 0; axis < 3; ++axis) {
        std::copy_n(rays.origin[axis] + begin, width, origin[axis]);
        std::copy_n(rays.direction[axis] + begin, width, direction[axis]);
    }
    std::copy_n(t_limit + begin, width, packet.tfar);
    std::fill_n(packet.time, width, 0.0F);
    std::fill_n(packet.mask, width, ~0U);
    std::fill_n(packet.flags, width, 0U);
    for (std::size_t i = 0; i < width; ++i) {
        packet.tnear[i] = t_lowest(rays, begin + i);
        packet.id[i] = static_cast<unsigned>(begin + i);
    }
}

void nearest(const simd::SceneView& /*scene*/, std::uint32_t /*kind_bits*/,
             const simd::Coherence* coherence, std::size_t count, const simd::RoundedRays& rays,
             const simd::Candidates& candidates, const simd::Workspace& /*workspace*/,
             simd::TraceCounters& /*counters*/) {
    const NoDenormals no_denormals;
    EmbreeQuery query(/*coherent=*/coherence != nullptr && !coherence->loose);
    if (way.filters) query.set_filter(reject_departed, &rays);
    const RTCScene scene = traversal->scene.get();
    const auto keep = [&](std::size_t lane, float t, unsigned geometry, unsigned primitive) {
        if (geometry == RTC_INVALID_GEOMETRY_ID) return;
        candidates.first[lane] = t;
        candidates.slot[lane] = traversal->slots[geometry][primitive];
    };
    if (!way.by_16) {
        for (std::size_t lane = 0; lane < count; ++lane) {
            if (!is_any(rays, lane)) continue;
            RTCRayHit ray{ray_of(rays, lane, candidates.first[lane]), {}};
            ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            query.nearest(scene, ray);
            keep(lane, ray.ray.tfar, ray.hit.geomID, ray.hit.primID);
        }
        return;
    }
    RTCRayHit16 packet;
    alignas(64) int valid[width];
    for (std::size_t begin = 0; begin < count; begin += width) {
        fill(packet.ray, rays, begin, candidates.first);
        std::fill_n(packet.hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
        for (std::size_t i = 0; i < width; ++i)
            valid[i] = begin + i < count && is_any(rays, begin + i) ? -1 : 0;
        query.nearest(scene, valid, packet);
        for (std::size_t i = 0; i < width; ++i)
            keep(begin + i, packet.ray.tfar[i], packet.hit.geomID[i], packet.hit.primID[i]);
    }
}

void occluded(const simd::SceneView& /*scene*/, std::uint32_t /*kind_bits*/,
              const simd::Coherence* coherence, std::size_t count, const simd::RoundedRays& rays,
              const simd::Occlusions& occlusions, const simd::Workspace& /*workspace*/,
              simd::TraceCounters& /*counters*/) {
    const NoDenormals no_denormals;
    EmbreeQuery query(/*coherent=*/coherence != nullptr && !coherence->loose);
    if (way.filters) query.set_filter(reject_departed, &rays);
    const RTCScene scene = traversal->scene.get();
    if (!way.by_16) {
        for (std::size_t lane = 0; lane < count; ++lane) {
            if (!is_any(rays, lane)) continue;
            RTCRay ray = ray_of(rays, lane, occlusions.t_limit[lane]);
            query.occluded(scene, ray);
            if (ray.tfar < 0.0F) occlusions.state[lane] = simd::blocked;
        }
        return;
    }
    RTCRay16 packet;
    alignas(64) int valid[width];
    for (std::size_t begin = 0; begin < count; begin += width) {
        fill(packet, rays, begin, occlusions.t_limit);
        for (std::size_t i = 0; i < width; ++i)
            valid[i] = begin + i < count && is_any(rays, begin + i) ? -1 : 0;
        query.occluded(scene, valid, packet);
        for (std::size_t i = 0; i < width && begin + i < count; ++i)
            if (packet.tfar[i] < 0.0F) occlusions.state[begin + i] = simd::blocked;
    }
}

/// Returns true if anything in the way blocks all light.
bool is_opaque(const core::Scene& scene) {
    return std::none_of(scene.materials().begin(), scene.materials().end(),
                        [](const core::Material& material) { return material.transmits(); });
}

} // namespace

std::vector<Drawing> embree_drawings(const simd::SceneData& scene, simd::Isa isa) {
    std::vector<Drawing> drawings;
    if (!EmbreeScene::can_hold(scene.scene()) || !is_opaque(scene.scene())) return drawings;
    const std::shared_ptr<const Traversal> built[] = {
        std::make_shared<const Traversal>(scene, isa, false),
        std::make_shared<const Traversal>(scene, isa, true)};
    constexpr core::Precision precision = core::Precision::robust;
    const auto kernels = std::make_shared<simd::Kernels>(simd::kernels_of(isa));
    kernels->methods[static_cast<std::size_t>(precision)].trace = {nearest, occluded};
    for (const Way& each : ways)
        drawings.push_back(
            {each.name, [each, kernels, &scene, built = built[each.filters ? 1 : 0]](
                            const core::Settings& settings, const simd::RenderOptions& options) {
                 traversal = built.get();
                 way = each;
                 return simd::render_vector(scene, settings, options, {kernels.get(), precision});
             }});
    return drawings;
}

} // namespace raylane::bench
