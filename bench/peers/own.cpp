#include "bench/peers/contender.hpp"
#include "simd/wavefront/hit_finder.hpp"

#include <algorithm>

namespace raylane::bench {

namespace {

/// One thread's. As the wavefront has it: rays in double, wave by wave, every decision certified;
/// those that have nothing in common as StreamTracer has it.
class Worker {
  public:
    Worker(const simd::SceneData& scene, simd::Isa isa)
        : scene_(scene), tracing_{&simd::kernels_of(isa)},
          reference_(scene.scene(), scene.scene().settings()), most_(scene.best_stream()),
          finder_(scene, tracing_, reference_), doubtful_(scene, tracing_, reference_),
          arena_(simd::arena_for([this](simd::Arena& arena) { take_from(arena); })) {}
    Worker(const Worker&) = delete; // parts of it refer to others
    Worker& operator=(const Worker&) = delete;

    /// Of some rays: slots, or, of occlusion, simd::Occlusion. Returns how many these are.
    std::size_t answer(const RaySet& rays, std::size_t begin, std::size_t end,
                       std::uint32_t* answers) {
        const simd::Bundle* const bundle = rays.bundle ? &*rays.bundle : nullptr;
        const bool in_waves = bundle != nullptr || rays.occlusion;
        const simd::Paths paths =
            rays.paths(begin, std::min(in_waves ? RaySet::wave : most_, end - begin));
        if (rays.occlusion) {
            find_blocked(paths, rays.t_most(begin), bundle);
            std::copy_n(occlusions_.state, paths.count, answers);
        } else {
            finder_.find(paths, bundle, counters_);
            std::copy_n(finder_.hits().slot, paths.count, answers);
        }
        return paths.count;
    }

  private:
    void take_from(simd::Arena& arena) {
        finder_.take_from(arena, most_);
        doubtful_.take_from(arena, most_);
        gathered_.take_from(arena, most_, false);
        simd::take_rounded(arena, rounded_, most_);
        occlusions_.state = arena.take<std::uint8_t>(most_);
        workspace_ = simd::workspace_for(scene_, arena, most_);
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
    std::size_t most_; ///< rays at a time
    simd::HitFinder finder_, doubtful_;
    core::Counters counters_;
    simd::Paths gathered_{};
    simd::RoundedRays rounded_{};
    simd::Occlusions occlusions_{};
    simd::Workspace workspace_{};
    simd::Arena arena_;
};

class Own : public Contender {
  public:
    Own(const simd::SceneData& scene, simd::Isa isa, int threads)
        : Contender("raylane"), scene_(scene) {
        for (int i = 0; i < threads; ++i)
            workers_.push_back(std::make_unique<Worker>(scene, isa));
    }

    void prepare(const RaySet& rays) override {
        rays_ = &rays;
        answers_.assign(rays.count, 0);
    }

    void run(std::size_t begin, std::size_t end, int thread) override {
        Worker& worker = *workers_[static_cast<std::size_t>(thread)];
        while (begin < end)
            begin += worker.answer(*rays_, begin, end, &answers_[begin]);
    }

    std::vector<std::uint32_t> answers() override {
        std::vector<std::uint32_t> all = answers_;
        for (std::uint32_t& answer : all)
            if (rays_->occlusion)
                answer = answer == simd::blocked ? 1 : 0;
            else
                answer = answer == simd::no_slot ? core::no_shape : scene_.id_of(answer);
        return all;
    }

  private:
    const simd::SceneData& scene_;
    std::vector<std::unique_ptr<Worker>> workers_;
    const RaySet* rays_ = nullptr;
    std::vector<std::uint32_t> answers_; // by ray, as Worker has them
};

} // namespace

std::unique_ptr<Contender> make_own(const simd::SceneData& scene, simd::Isa isa, int threads) {
    return std::make_unique<Own>(scene, isa, threads);
}

} // namespace raylane::bench
