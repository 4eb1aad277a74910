#include "bench/embree_scene.hpp"
#include "bench/peers/contender.hpp"
#include "bench/peers/measure.hpp"

#include <algorithm>

namespace raylane::bench {

namespace {

/// Embree's calls for streams are left out: they were never the fastest, and Embree 4 has none.
enum class Call { single, wide, coherent };
constexpr Call calls[] = {Call::single, Call::wide, Call::coherent};
constexpr const char* call_names[] = {"embree 1", "embree 16", "embree 16 coherent"};

constexpr std::size_t width = 16;

/// The hierarchy, which all calls share.
struct Built {
    EmbreeDevice device;
    EmbreeScene scene;

    Built(const core::Scene& from, simd::Isa isa)
        : device(make_embree_device(isa)),
          scene(device.get(), from, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_MEDIUM) {
        scene.commit();
    }
};

/// Rays stay in Embree's arrays, which are filled before the clock starts; only the members that
/// Embree writes are set again. Its normals are not normalised.
class Embree : public Contender {
  public:
    Embree(std::shared_ptr<const Built> built, Call call)
        : Contender(call_names[static_cast<int>(call)]), built_(std::move(built)), call_(call) {}

    void prepare(const RaySet& rays) override {
        rays_ = &rays;
        single_.clear();
        wide_.clear();
        if (is_wide())
            wide_.resize((rays.count + width - 1) / width);
        else
            single_.resize(rays.count);
        for (std::size_t i = 0; i < rays.count; ++i) {
            RTCRay ray{};
            const core::Ray<float> from = rays.ray_in_float(i);
            ray.org_x = from.origin.x;
            ray.org_y = from.origin.y;
            ray.org_z = from.origin.z;
            ray.dir_x = from.direction.x;
            ray.dir_y = from.direction.y;
            ray.dir_z = from.direction.z;
            ray.tnear = rays.t_lowest(i);
            ray.mask = ~0U;
            if (is_wide())
                set_ray(wide_[i / width].ray, i % width, ray);
            else
                single_[i].ray = ray;
        }
    }

    void run(std::size_t begin, std::size_t end, int /*thread*/) override {
        const NoDenormals no_denormals;
        EmbreeQuery query(call_ == Call::coherent);
        for (; begin < end; begin += RaySet::wave) {
            const std::size_t count = std::min(RaySet::wave, end - begin);
            if (is_wide())
                run_wide(begin, count, query);
            else
                run_single(begin, count, query);
        }
    }

    std::vector<std::uint32_t> answers() override {
        std::vector<std::uint32_t> ids;
        for (std::size_t i = 0; i < rays_->count; ++i) {
            const std::size_t packet = i / width, lane = i % width;
            const bool wide = is_wide();
            const float tfar = wide ? wide_[packet].ray.tfar[lane] : single_[i].ray.tfar;
            const unsigned geometry = wide ? wide_[packet].hit.geomID[lane] : single_[i].hit.geomID;
            const unsigned primitive =
                wide ? wide_[packet].hit.primID[lane] : single_[i].hit.primID;
            ids.push_back(rays_->occlusion ? (tfar < 0.0F ? 1U : 0U)
                                           : built_->scene.shape(geometry, primitive));
        }
        return ids;
    }

  private:
    bool is_wide() const { return call_ != Call::single; }

    static void set_ray(RTCRay16& packet, std::size_t lane, const RTCRay& ray) {
        packet.org_x[lane] = ray.org_x;
        packet.org_y[lane] = ray.org_y;
        packet.org_z[lane] = ray.org_z;
        packet.dir_x[lane] = ray.dir_x;
        packet.dir_y[lane] = ray.dir_y;
        packet.dir_z[lane] = ray.dir_z;
        packet.tnear[lane] = ray.tnear;
        packet.mask[lane] = ray.mask;
    }

    void run_single(std::size_t begin, std::size_t count, EmbreeQuery& query) {
        const float* const t_limit = rays_->t_limit(begin);
        RTCRayHit* const rays = &single_[begin];
        for (std::size_t i = 0; i < count; ++i) {
            rays[i].ray.tfar = t_limit[i];
            rays[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
        }
        const RTCScene scene = built_->scene.get();
        for (std::size_t i = 0; i < count; ++i)
            if (rays_->occlusion)
                query.occluded(scene, rays[i].ray);
            else
                query.nearest(scene, rays[i]);
    }

    void run_wide(std::size_t begin, std::size_t count, EmbreeQuery& query) {
        alignas(64) int valid[width];
        for (std::size_t first = 0; first < count; first += width) {
            RTCRayHit16& rays = wide_[(begin + first) / width];
            for (std::size_t lane = 0; lane < width; ++lane)
                valid[lane] = first + lane < count ? -1 : 0;
            std::copy_n(rays_->t_limit(begin + first), width, rays.ray.tfar);
            std::fill_n(rays.hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
            if (rays_->occlusion)
                query.occluded(built_->scene.get(), valid, rays.ray);
            else
                query.nearest(built_->scene.get(), valid, rays);
        }
    }

    std::shared_ptr<const Built> built_;
    Call call_;
    const RaySet* rays_ = nullptr;
    std::vector<RTCRayHit> single_;
    std::vector<RTCRayHit16> wide_;
};

} // namespace

const char* embree_version() {
    return RTC_VERSION_STRING;
}

Contenders make_embree(const core::Scene& scene, simd::Isa isa, int most) {
    Contenders contenders;
    if (!EmbreeScene::can_hold(scene)) return contenders;
    const auto built = std::make_shared<const Built>(scene, isa);
    for (const Call call : calls)
        if (call == Call::single || most >= static_cast<int>(width))
            contenders.push_back(std::make_unique<Embree>(built, call));
    return contenders;
}

std::optional<TimedRun> embree_building(const core::Scene& scene, simd::Isa isa) {
    if (!EmbreeScene::can_hold(scene)) return std::nullopt;
    return TimedRun{"embree", [&scene, isa](int /*threads*/) {
                        const EmbreeDevice device = make_embree_device(isa);
                        EmbreeScene built(device.get(), scene, RTC_SCENE_FLAG_NONE,
                                          RTC_BUILD_QUALITY_MEDIUM);
                        const NoDenormals no_denormals;
                        return seconds_of([&] { built.commit(); });
                    }};
}

} // namespace raylane::bench
