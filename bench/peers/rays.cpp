#include "bench/peers/contender.hpp"
#include "bench/peers/measure.hpp"
#include "core/reference/tracer.hpp"
#include "simd/query/as_core.hpp"

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <thread>

namespace raylane::bench {

namespace {

/// Traces all rays once, on several threads, in portions of several waves. Returns the seconds from
/// when all threads are there.
double run(Contender& contender, const RaySet& rays, int threads) {
    using Clock = std::chrono::steady_clock;
    constexpr std::size_t share = 8 * RaySet::wave;
    Clock::time_point start;
    std::atomic<std::size_t> next = 0;
    std::barrier are_there(threads, [&]() noexcept { start = Clock::now(); });
    const auto work = [&](int thread) {
        are_there.arrive_and_wait();
        for (std::size_t begin; (begin = next.fetch_add(share)) < rays.count;)
            contender.run(begin, std::min(begin + share, rays.count), thread);
    };
    std::vector<std::jthread> others;
    for (int thread = 1; thread < threads; ++thread)
        others.emplace_back(work, thread);
    work(0);
    others.clear(); // joins
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Decides which answers are right, for the rays in double and for the same rays in float.
class Judge {
  public:
    Judge(const simd::SceneData& scene, const RaySet& rays)
        : scene_(scene), rays_(rays), reference_(scene.scene(), scene.scene().settings()) {}

    void ask(std::size_t ray) {
        const core::Ray<float> in_float = rays_.ray_in_float(ray);
        const core::Ray<double> asked[] = {
            rays_.ray(ray),
            {core::convert<double>(in_float.origin), core::convert<double>(in_float.direction)}};
        for (const bool floats : {false, true})
            encounters_[floats] = reference_.nearest(
                asked[floats], simd::origin_surfaces_of(scene_, rays_.paths(ray, 1), /*lane=*/0));
        t_limit_ = static_cast<double>(*rays_.t_limit(ray));
    }

    /// Returns true if an answer is right. If surfaces meet in one point, each of them is.
    bool is_right(std::uint32_t answer, bool in_float) const {
        const core::Encounter<double>& encounter = encounters_[in_float];
        const core::Hit<double>& hit = encounter.hit;
        if (rays_.occlusion) return (answer != 0) == (hit.any() && hit.t < t_limit_);
        if (!hit.any()) return answer == core::no_shape;
        return answer == hit.shape || encounter.contacts.find(answer) != nullptr;
    }

  private:
    const simd::SceneData& scene_;
    const RaySet& rays_;
    core::ReferenceTracer<double> reference_;
    core::Encounter<double> encounters_[2]; ///< of the rays in double, in float
    double t_limit_ = 0.0;
};

/// Counts wrong answers. The reference tracer decides where contenders disagree, and for a sample
/// of the other rays. All contenders but the first, raylane's engine, get the rays in float.
void count_wrong(const simd::SceneData& scene, const RaySet& rays, const Contenders& contenders,
                 std::vector<Result>& results) {
    constexpr std::size_t sample = 64;
    Judge judge(scene, rays);
    std::vector<std::vector<std::uint32_t>> answers;
    for (const auto& contender : contenders)
        answers.push_back(contender->answers());
    for (Result& result : results)
        result.wrong = 0;
    for (std::size_t ray = 0; ray < rays.count; ++ray) {
        const bool agreed = std::all_of(answers.begin(), answers.end(), [&](const auto& theirs) {
            return theirs[ray] == answers[0][ray];
        });
        if (agreed && ray % sample != 0) continue;
        judge.ask(ray);
        for (std::size_t who = 0; who < results.size(); ++who)
            if (!judge.is_right(answers[who][ray], /*in_float=*/who > 0)) ++*results[who].wrong;
    }
}

Row measure_set(const simd::SceneData& scene, const RaySet& rays, const Contenders& contenders,
                const Measuring& how) {
    Row row{rays.name, rays.count, /*is_speed=*/true, {}};
    std::vector<TimedRun> runs;
    for (const auto& contender : contenders) {
        contender->prepare(rays);
        runs.push_back(
            {contender->name(), [&](int threads) { return run(*contender, rays, threads); }});
    }
    row.by = alternate(runs, how);
    count_wrong(scene, rays, contenders, row.by);
    for (Result& result : row.by)
        result.in_millions_per_second(rays.count);
    return row;
}

} // namespace

void measure_rays(const simd::SceneData& scene, const std::vector<std::string>& wanted,
                  const Measuring& how, const std::function<void(const Row&)>& report) {
    const auto is_wanted = [&](const std::string& name) {
        return std::find(wanted.begin(), wanted.end(), name) != wanted.end();
    };
    if (std::none_of(std::begin(ray_set_names), std::end(ray_set_names), is_wanted)) return;
    Contenders contenders = make_embree(scene.scene(), how.isa, how.call);
    for (const bool names : {false, true})
        contenders.insert(contenders.begin(), make_library(scene, how.isa, names, how.call));
    contenders.insert(contenders.begin(), make_own(scene, how.isa, how.threads));
    for (const RaySet& rays : make_ray_sets(scene.scene(), scene, how.side))
        if (is_wanted(rays.name) && rays.count != 0)
            report(measure_set(scene, rays, contenders, how));
}

} // namespace raylane::bench
