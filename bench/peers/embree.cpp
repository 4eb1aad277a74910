#include "bench/embree_scene.hpp"
#include "bench/peers/contender.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace raylane::bench {

namespace {

enum class Call { single, wide, coherent };
constexpr const char* call_names[] = {"embree single", "embree 16", "embree 16 coherent"};

constexpr std::size_t width = 16;

/// What the calls share: a hierarchy.
struct Built {
    EmbreeDevice device;
    EmbreeScene scene;

    Built(const core::Scene& from, simd::Isa isa)
        : device(make_embree_device(isa)),
          scene(device.get(), from, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_MEDIUM) {
        scene.commit();
    }
};

/// Rays stay in Embree's own arrays, where they have been put before the clock starts; of these,
/// only what it writes is set anew. Its normals are not brought to unit length.
class Embree : public Contender {
  public:
    Embree(std::shared_ptr<const Built> built, Call call)
        : Contender(call_names[static_cast<int>(call)]), built_(std::move(built)), call_(call) {
        rtcInitIntersectContext(&context_);
        if (call == Call::coherent) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    }

    void prepare(const RaySet& rays) override {
        rays_ = &rays;
        single_.clear();
        wide_.clear();
        if (call_ == Call::single)
            single_.resize(rays.count);
        else
            wide_.resize((rays.count + width - 1) / width);
        for (std::size_t i = 0; i < rays.count; ++i) {
            RTCRay ray{};
            const core::Ray<double> from = rays.ray(i);
            ray.org_x = static_cast<float>(from.origin.x);
            ray.org_y = static_cast<float>(from.origin.y);
            ray.org_z = static_cast<float>(from.origin.z);
            ray.dir_x = static_cast<float>(from.direction.x);
            ray.dir_y = static_cast<float>(from.direction.y);
            ray.dir_z = static_cast<float>(from.direction.z);
            // It knows nothing of what a ray leaves.
            ray.tnear = rays.starts_on_surface(i) ? 1e-4F : 0.0F;
            ray.mask = ~0U;
            if (call_ == Call::single)
                single_[i].ray = ray;
            else
                set_ray(wide_ray(i / width), i % width, ray);
        }
    }

    void run() override {
        if (call_ == Call::single)
            run_single();
        else
            run_wide();
    }

    std::vector<std::uint32_t> answers() override {
        std::vector<std::uint32_t> all;
        for (std::size_t i = 0; i < rays_->count; ++i) {
            float tfar = 0.0F;
            unsigned geometry = 0, primitive = 0;
            if (call_ == Call::single) {
                tfar = single_[i].ray.tfar;
                geometry = single_[i].hit.geomID;
                primitive = single_[i].hit.primID;
            } else {
                const RTCRayHit16& packet = wide_[i / width];
                tfar = packet.ray.tfar[i % width];
                geometry = packet.hit.geomID[i % width];
                primitive = packet.hit.primID[i % width];
            }
            all.push_back(rays_->occlusion ? (tfar < 0.0F ? 1U : 0U)
                                           : built_->scene.shape(geometry, primitive));
        }
        return all;
    }

  private:
    RTCRayN* wide_ray(std::size_t packet) { return reinterpret_cast<RTCRayN*>(&wide_[packet].ray); }
    static void set_ray(RTCRayN* rays, std::size_t lane, const RTCRay& ray) {
        const auto i = static_cast<unsigned>(lane);
        constexpr auto n = static_cast<unsigned>(width);
        RTCRayN_org_x(rays, n, i) = ray.org_x;
        RTCRayN_org_y(rays, n, i) = ray.org_y;
        RTCRayN_org_z(rays, n, i) = ray.org_z;
        RTCRayN_dir_x(rays, n, i) = ray.dir_x;
        RTCRayN_dir_y(rays, n, i) = ray.dir_y;
        RTCRayN_dir_z(rays, n, i) = ray.dir_z;
        RTCRayN_tnear(rays, n, i) = ray.tnear;
        RTCRayN_mask(rays, n, i) = ray.mask;
    }

    void run_single() {
        const float* const t_most = rays_->t_most(0);
        for (std::size_t i = 0; i < rays_->count; ++i) {
            single_[i].ray.tfar = t_most[i];
            single_[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
            if (rays_->occlusion)
                rtcOccluded1(built_->scene.get(), &context_, &single_[i].ray);
            else
                rtcIntersect1(built_->scene.get(), &context_, &single_[i]);
        }
    }

    void run_wide() {
        alignas(64) int valid[width];
        for (std::size_t packet = 0; packet < wide_.size(); ++packet) {
            RTCRayHit16& rays = wide_[packet];
            const std::size_t count = std::min(width, rays_->count - packet * width);
            for (std::size_t lane = 0; lane < width; ++lane)
                valid[lane] = lane < count ? -1 : 0;
            std::copy_n(rays_->t_most(packet * width), width, rays.ray.tfar);
            std::fill_n(rays.hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
            if (rays_->occlusion)
                rtcOccluded16(valid, built_->scene.get(), &context_, &rays.ray);
            else
                rtcIntersect16(valid, built_->scene.get(), &context_, &rays);
        }
    }

    std::shared_ptr<const Built> built_;
    Call call_;
    RTCIntersectContext context_;
    const RaySet* rays_ = nullptr;
    std::vector<RTCRayHit> single_;
    std::vector<RTCRayHit16> wide_;
};

} // namespace

std::vector<std::unique_ptr<Contender>> make_embree(const core::Scene& scene, simd::Isa isa) {
    std::vector<std::unique_ptr<Contender>> all;
    if (!EmbreeScene::can_hold(scene)) return all;
    const auto built = std::make_shared<const Built>(scene, isa);
    for (const Call call : {Call::single, Call::wide, Call::coherent})
        all.push_back(std::make_unique<Embree>(built, call));
    return all;
}

double embree_build_seconds(const core::Scene& scene, simd::Isa isa) {
    if (!EmbreeScene::can_hold(scene)) return -1.0;
    const EmbreeDevice device = make_embree_device(isa);
    EmbreeScene built(device.get(), scene, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_MEDIUM);
    const auto start = std::chrono::steady_clock::now();
    built.commit();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace raylane::bench
