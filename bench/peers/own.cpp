#include "bench/peers/contender.hpp"
#include "simd/query/query.hpp"

#include <algorithm>

namespace raylane::bench {

namespace {

/// Answers rays for one thread. Like the wavefront: rays in double, wave by wave, every decision
/// certified. Rays without coherence are answered as StreamTracer does.
class Worker {
  public:
    Worker(const simd::SceneData& scene, simd::Isa isa)
        : scene_(scene), tracing_{&simd::kernels_of(isa)}, most_(scene.best_ray_count()),
          query_(scene, tracing_, simd::Asked::points),
          arena_(simd::arena_for([this](simd::Arena& arena) { take_from(arena); })) {}
    Worker(const Worker&) = delete; // parts refer to others
    Worker& operator=(const Worker&) = delete;

    /// Answers the next rays from `begin` on: at most a wave, or best_ray_count() rays if they are
    /// answered as StreamTracer does. Writes the slot of each ray's hit or, for occlusion, a
    /// simd::Occlusion. Returns the number of rays answered.
    std::size_t answer(const RaySet& rays, std::size_t begin, std::size_t end,
                       std::uint32_t* answers) {
        const simd::Coherence* const coherence = rays.coherence ? &*rays.coherence : nullptr;
        const bool in_waves = coherence != nullptr || rays.occlusion;
        const simd::Paths paths =
            rays.paths(begin, std::min(in_waves ? RaySet::wave : most_, end - begin));
        if (rays.occlusion) {
            find_blocked(paths, rays.t_limit(begin), coherence);
            std::copy_n(state_, paths.count, answers);
        } else {
            query_.nearest(paths, coherence, counters_);
            std::copy_n(query_.hits().slot, paths.count, answers);
        }
        return paths.count;
    }

  private:
    void take_from(simd::Arena& arena) {
        query_.take_from(arena, most_);
        gathered_.take_from(arena, most_, false);
        distance_ = arena.take<double>(most_);
        state_ = arena.take<std::uint8_t>(most_);
    }

    /// Decides rays in doubt by their nearest hits.
    void find_blocked(const simd::Paths& paths, const float* t_limit,
                      const simd::Coherence* coherence) {
        std::copy_n(t_limit, paths.count, distance_);
        std::fill_n(state_, paths.count, std::uint8_t{simd::unblocked});
        query_.occluded(paths.columns(), distance_, state_, coherence, counters_);
        gathered_.count = 0;
        for (std::size_t lane = 0; lane < paths.count; ++lane)
            if (state_[lane] == simd::doubtful) {
                gathered_.copy_ray(paths, lane, gathered_.count);
                gathered_.sample[gathered_.count++] = static_cast<std::uint32_t>(lane);
            }
        if (gathered_.count == 0) return;
        query_.nearest(gathered_, nullptr, counters_);
        for (std::size_t i = 0; i < gathered_.count; ++i) {
            const std::uint32_t lane = gathered_.sample[i];
            const simd::Hits& hits = query_.hits();
            const bool any =
                hits.slot[i] != simd::no_slot && hits.t[i] < static_cast<double>(t_limit[lane]);
            state_[lane] = any ? simd::blocked : simd::unblocked;
        }
    }

    const simd::SceneData& scene_;
    simd::Tracing tracing_;
    std::size_t most_; ///< rays at a time
    simd::Query query_;
    simd::EngineCounters counters_;
    simd::Paths gathered_{};
    double* distance_ = nullptr;
    std::uint8_t* state_ = nullptr;
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
        std::vector<std::uint32_t> ids = answers_;
        for (std::uint32_t& answer : ids)
            if (rays_->occlusion)
                answer = answer == simd::blocked ? 1 : 0;
            else
                answer = answer == simd::no_slot ? core::no_shape : scene_.id_of(answer);
        return ids;
    }

  private:
    const simd::SceneData& scene_;
    std::vector<std::unique_ptr<Worker>> workers_;
    const RaySet* rays_ = nullptr;
    std::vector<std::uint32_t> answers_; // by ray, in Worker's form
};

} // namespace

std::unique_ptr<Contender> make_own(const simd::SceneData& scene, simd::Isa isa, int threads) {
    return std::make_unique<Own>(scene, isa, threads);
}

} // namespace raylane::bench
