#include "bench/peers/contender.hpp"
#include "simd/stream/stream_tracer.hpp"

#include <algorithm>

namespace raylane::bench {

namespace {

/// The library as users call it: rays in float, in separate arrays, answered by t, normal and id,
/// or by 1 and 0. Calls do not mention coherence. Rays name the shapes that they leave, or start a
/// little ahead of them.
class Library : public Contender {
  public:
    Library(const simd::SceneData& scene, simd::Isa isa, bool names, int call)
        : Contender(names ? "library, named" : "library"), scene_(scene), names_(names),
          call_(static_cast<std::size_t>(call)), tracer_(scene.scene(), /*threads=*/1, isa) {}

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
        leaves_any_ = rays.leaves_any();
        shape_left_.assign(rays.count, core::no_shape);
        face_left_.assign(rays.count, 0);
        inward_.assign(rays.count, 0);
        for (std::size_t i = 0; i < rays.count; ++i) {
            const core::Ray<float> ray = rays.ray_in_float(i);
            for (int axis = 0; axis < 3; ++axis) {
                origin_[axis][i] = ray.origin[axis];
                direction_[axis][i] = ray.direction[axis];
            }
            t_min_[i] = rays.t_lowest(i);
            const simd::Paths path = rays.paths(i, 1);
            if (path.origin_slot[0] == simd::no_slot) continue;
            shape_left_[i] = scene_.id_of(path.origin_slot[0]);
            face_left_[i] = static_cast<std::uint8_t>(path.origin_bits[0] & simd::origin_face);
            inward_[i] = (path.origin_bits[0] & simd::origin_inward) != 0 ? 1 : 0;
        }
    }

    void run(std::size_t begin, std::size_t end, int /*thread*/) override {
        for (; begin < end; begin += call_)
            call(begin, std::min(begin + call_, end));
    }

    std::vector<std::uint32_t> answers() override {
        if (!rays_->occlusion) return shape_;
        return {occluded_.begin(), occluded_.end()};
    }

  private:
    void call(std::size_t begin, std::size_t end) {
        const auto from = [begin](auto& column) { return column.data() + begin; };
        simd::RayStream<float> rays = {
            end - begin,
            {from(origin_[0]), from(origin_[1]), from(origin_[2])},
            {from(direction_[0]), from(direction_[1]), from(direction_[2])},
            leaves_any_ && !names_ ? from(t_min_) : nullptr,
            rays_->occlusion ? rays_->t_limit(begin) : nullptr};
        if (leaves_any_ && names_) {
            rays.origin_shape = from(shape_left_);
            rays.origin_face = from(face_left_);
            rays.origin_inward = from(inward_);
        }
        if (rays_->occlusion)
            tracer_.occluded(rays, from(occluded_));
        else
            tracer_.nearest(rays, {from(t_),
                                   {from(normal_[0]), from(normal_[1]), from(normal_[2])},
                                   from(shape_),
                                   nullptr});
    }

    const simd::SceneData& scene_;
    bool names_;
    std::size_t call_;
    simd::StreamTracer tracer_;
    const RaySet* rays_ = nullptr;
    std::vector<float> origin_[3], direction_[3], t_min_, t_, normal_[3];
    std::vector<core::ShapeId> shape_, shape_left_;
    std::vector<std::uint8_t> occluded_, face_left_, inward_;
    bool leaves_any_ = false;
};

} // namespace

std::unique_ptr<Contender> make_library(const simd::SceneData& scene, simd::Isa isa, bool names,
                                        int call) {
    return std::make_unique<Library>(scene, isa, names, call);
}

} // namespace raylane::bench
