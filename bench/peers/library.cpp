#include "bench/peers/contender.hpp"
#include "simd/stream_tracer.hpp"

#include <algorithm>

namespace raylane::bench {

namespace {

/// What a user of the library gets: rays in float, in arrays of their own, answered by t, normal
/// and id, or by 1 and 0. It is told nothing of what rays have in common, nor what they leave.
class Library : public Contender {
  public:
    Library(const core::Scene& scene, simd::Isa isa)
        : Contender("library"), tracer_(scene, /*threads=*/1, isa) {}

    void prepare(const RaySet& rays) override {
        rays_ = &rays;
        for (int axis = 0; axis < 3; ++axis) {
            origin_[axis].resize(rays.count);
            direction_[axis].resize(rays.count);
            normal_[axis].resize(rays.count);
        }
        t_min_.resize(rays.count);
        t_.resize(rays.count);
        shape_.resize(rays.count);
        occluded_.resize(rays.count);
        has_t_min_ = false;
        for (std::size_t i = 0; i < rays.count; ++i) {
            const core::Ray<float> ray = rays.ray_in_float(i);
            for (int axis = 0; axis < 3; ++axis) {
                origin_[axis][i] = ray.origin[axis];
                direction_[axis][i] = ray.direction[axis];
            }
            t_min_[i] = rays.t_least(i);
            has_t_min_ = has_t_min_ || t_min_[i] > 0.0F;
        }
    }

    void run(std::size_t begin, std::size_t end, int /*thread*/) override {
        const auto from = [begin](auto& column) { return column.data() + begin; };
        const simd::RayStream<float> rays = {
            end - begin,
            {from(origin_[0]), from(origin_[1]), from(origin_[2])},
            {from(direction_[0]), from(direction_[1]), from(direction_[2])},
            has_t_min_ ? from(t_min_) : nullptr,
            rays_->occlusion ? rays_->t_most(begin) : nullptr};
        if (rays_->occlusion)
            tracer_.occluded(rays, from(occluded_));
        else
            tracer_.nearest(rays, {from(t_),
                                   {from(normal_[0]), from(normal_[1]), from(normal_[2])},
                                   from(shape_),
                                   nullptr});
    }

    std::vector<std::uint32_t> answers() override {
        if (!rays_->occlusion) return shape_;
        return {occluded_.begin(), occluded_.end()};
    }

  private:
    simd::StreamTracer tracer_;
    const RaySet* rays_ = nullptr;
    std::vector<float> origin_[3], direction_[3], t_min_, t_, normal_[3];
    std::vector<core::ShapeId> shape_;
    std::vector<std::uint8_t> occluded_;
    bool has_t_min_ = false;
};

} // namespace

std::unique_ptr<Contender> make_library(const core::Scene& scene, simd::Isa isa) {
    return std::make_unique<Library>(scene, isa);
}

} // namespace raylane::bench
