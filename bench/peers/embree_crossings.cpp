#include "bench/embree_scene.hpp"
#include "bench/peers/crossings.hpp"

#include <algorithm>

namespace raylane::bench {

namespace {

class EmbreeGatherer : public Gatherer {
  public:
    EmbreeGatherer(const core::Scene& scene, simd::Isa isa, const RaySet& rays)
        : device_(make_embree_device(isa)),
          scene_(device_.get(), scene, EmbreeQuery::filter_flag, RTC_BUILD_QUALITY_MEDIUM) {
        scene_.commit();
        for (std::size_t i = 0; i < rays.count; ++i)
            rays_.push_back(rays.ray_in_float(i));
    }

    void run() override {
        const NoDenormals no_denormals;
        EmbreeQuery query(/*coherent=*/false);
        query.set_filter(note, &found_);
        rows_.first.assign(1, 0);
        rows_.shape.clear();
        t_.clear();
        for (const core::Ray<float>& from : rays_) {
            RTCRayHit ray{};
            ray.ray.org_x = from.origin.x;
            ray.ray.org_y = from.origin.y;
            ray.ray.org_z = from.origin.z;
            ray.ray.dir_x = from.direction.x;
            ray.ray.dir_y = from.direction.y;
            ray.ray.dir_z = from.direction.z;
            ray.ray.tfar = std::numeric_limits<float>::infinity();
            ray.ray.mask = ~0U;
            ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            found_.clear();
            query.nearest(scene_.get(), ray);
            std::sort(found_.begin(), found_.end(),
                      [](const Noted& a, const Noted& b) { return a.t < b.t; });
            for (const Noted& noted : found_) {
                t_.push_back(noted.t);
                rows_.shape.push_back(scene_.shape(noted.geometry, noted.primitive));
            }
            rows_.first.push_back(rows_.shape.size());
        }
    }

    const ShapeRows& rows() const override { return rows_; }

  private:
    struct Noted {
        float t;
        unsigned geometry, primitive;
    };

    static void note(const RTCFilterFunctionNArguments* hits) {
        auto& found =
            *static_cast<std::vector<Noted>*>(const_cast<void*>(EmbreeQuery::data_for(*hits)));
        for (unsigned lane = 0; lane < hits->N; ++lane) {
            if (hits->valid[lane] == 0) continue;
            found.push_back({RTCRayN_tfar(hits->ray, hits->N, lane),
                             RTCHitN_geomID(hits->hit, hits->N, lane),
                             RTCHitN_primID(hits->hit, hits->N, lane)});
            hits->valid[lane] = 0;
        }
    }

    EmbreeDevice device_;
    EmbreeScene scene_;
    std::vector<core::Ray<float>> rays_;
    std::vector<Noted> found_; // of one ray
    ShapeRows rows_;
    std::vector<float> t_;
};

} // namespace

std::unique_ptr<Gatherer> embree_gatherer(const core::Scene& scene, simd::Isa isa,
                                          const RaySet& rays) {
    if (!EmbreeScene::can_hold(scene)) return nullptr;
    return std::make_unique<EmbreeGatherer>(scene, isa, rays);
}

} // namespace raylane::bench
