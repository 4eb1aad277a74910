#include "bench/peers/contender.hpp"
#include "simd/wavefront/hit_finder.hpp"

#include <algorithm>

namespace raylane::bench {

namespace {

/// As the wavefront has it: rays in double, wave by wave, every decision certified.
class Own : public Contender {
  public:
    Own(const simd::SceneData& scene, simd::Isa isa)
        : Contender("raylane"), scene_(scene), tracing_{&simd::kernels_of(isa)},
          reference_(scene.scene(), scene.scene().settings()),
          finder_(scene, tracing_, &reference_), doubtful_(scene, tracing_, &reference_),
          arena_(simd::arena_for([this](simd::Arena& arena) { take_from(arena); })) {}

    void prepare(const RaySet& rays) override { rays_ = &rays; }

    void run() override {
        for (std::size_t begin = 0; begin < rays_->count; begin += RaySet::wave)
            find(begin);
    }

    std::vector<std::uint32_t> answers() override {
        std::vector<std::uint32_t> all;
        for (std::size_t begin = 0; begin < rays_->count; begin += RaySet::wave) {
            find(begin);
            const std::size_t count = std::min(RaySet::wave, rays_->count - begin);
            for (std::size_t lane = 0; lane < count; ++lane)
                all.push_back(rays_->occlusion
                                  ? (occlusions_.state[lane] == simd::blocked ? 1U : 0U)
                              : finder_.hits().slot[lane] == simd::no_slot
                                  ? core::no_shape
                                  : scene_.id_of(finder_.hits().slot[lane]));
        }
        return all;
    }

  private:
    void take_from(simd::Arena& arena) {
        finder_.take_from(arena, RaySet::wave);
        doubtful_.take_from(arena, RaySet::wave);
        gathered_.take_from(arena, RaySet::wave, false);
        simd::take_rounded(arena, rounded_, RaySet::wave);
        occlusions_.state = arena.take<std::uint8_t>(RaySet::wave);
        workspace_ = simd::workspace_for(scene_, arena, RaySet::wave);
    }

    void find(std::size_t begin) {
        const simd::Bundle* const bundle = rays_->bundle ? &*rays_->bundle : nullptr;
        const simd::Paths paths = rays_->paths(begin);
        if (rays_->occlusion)
            find_blocked(paths, rays_->t_most(begin), bundle);
        else
            finder_.find(paths, bundle, counters_);
    }

    /// What is in doubt is decided by its nearest hit.
    void find_blocked(const simd::Paths& paths, const float* t_most, const simd::Bundle* bundle) {
        paths.pass_to(rounded_);
        tracing_.kernels->rays.round_rays(paths.count, rounded_);
        std::fill_n(occlusions_.state, paths.count, std::uint8_t{simd::open});
        occlusions_.t_most = t_most;
        simd::TraceCounters traced{};
        tracing_.method().trace.occluded(scene_.view(), scene_.listed_kinds(), bundle, paths.count,
                                         rounded_, occlusions_, workspace_, traced);
        gathered_.count = 0;
        for (std::size_t lane = 0; lane < paths.count; ++lane)
            if (occlusions_.state[lane] == simd::doubtful) {
                gathered_.copy_ray(paths, lane, gathered_.count);
                gathered_.sample[gathered_.count++] = static_cast<std::uint32_t>(lane);
            }
        if (gathered_.count == 0) return;
        doubtful_.find(gathered_, nullptr, counters_);
        for (std::size_t i = 0; i < gathered_.count; ++i) {
            const std::uint32_t lane = gathered_.sample[i];
            const simd::Hits& hits = doubtful_.hits();
            const bool any =
                hits.slot[i] != simd::no_slot && hits.t[i] < static_cast<double>(t_most[lane]);
            occlusions_.state[lane] = any ? simd::blocked : simd::open;
        }
    }

    const simd::SceneData& scene_;
    simd::Tracing tracing_;
    core::ReferenceTracer<double> reference_;
    simd::HitFinder finder_, doubtful_;
    core::Counters counters_;
    const RaySet* rays_ = nullptr;
    simd::Paths gathered_{};
    simd::RoundedRays rounded_{};
    simd::Occlusions occlusions_{};
    simd::Workspace workspace_{};
    simd::Arena arena_;
};

} // namespace

std::unique_ptr<Contender> make_own(const simd::SceneData& scene, simd::Isa isa) {
    return std::make_unique<Own>(scene, isa);
}

} // namespace raylane::bench
