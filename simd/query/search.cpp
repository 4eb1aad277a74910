#include "simd/query/search.hpp"

#include <algorithm>

namespace raylane::simd {

Workspace workspace_for(const SceneData& scene, Arena& arena, std::size_t capacity) {
    Workspace workspace{};
    if (!scene.has_tree()) return workspace;
    const std::uint32_t levels = scene.view().tree_depth;
    const std::size_t entries = in_flight * pending_entries(levels);
    workspace.key = arena.take<std::uint16_t>(entries);
    workspace.child = arena.take<std::uint32_t>(entries);
    workspace.capacity = capacity;
    workspace.records = arena.take<std::byte>(capacity * list_record_bytes);
    workspace.lists = arena.take<std::uint16_t>(list_entries(capacity, levels));
    return workspace;
}

CandidateSearch::CandidateSearch(const SceneData& scene, const Tracing& tracing)
    : scene_(scene), tracing_(tracing), approach_(scene) {
    if (!scene.prototypes().empty()) copies_ = std::make_unique<CopySearch>(scene, tracing);
}

void CandidateSearch::take_from(Arena& arena, std::size_t capacity) {
    approach_.take_from(arena, capacity);
    arena.take(rounded_.origin, capacity);
    arena.take(rounded_.direction, capacity);
    rounded_.slack = arena.take<float>(capacity);
    workspace_ = workspace_for(scene_, arena, capacity);
    if (copies_ != nullptr) copies_->take_from(arena);
}

void CandidateSearch::take(const RayColumns& rays) {
    count_ = rays.count;
    std::copy_n(rays.origin, 3, rounded_.exact_origin);
    std::copy_n(rays.direction, 3, rounded_.exact_direction);
    rounded_.origin_first = rays.origin_first;
    rounded_.origin_last = rays.origin_last;
    if (tracing_.precision == core::Precision::exact) approach_.find_starts(rays, rounded_);
    tracing_.kernels->rays.round_rays(count_, rounded_, scene_.view().rounding);
}

const Coherence* CandidateSearch::common(const Coherence* coherence) {
    if (!approach_.any() || coherence == nullptr) return coherence;
    if (approach_.is_from_afar()) return &neighbours;
    moved_ = *coherence;
    moved_.beyond = !coherence->converging && !coherence->parallel && !coherence->loose;
    return &moved_;
}

/// Plain double bounds shapes in float. If shapes are not floats, only the bounds of `exact` hold.
const TraceKernels& CandidateSearch::trace() const {
    const bool by_exact =
        tracing_.precision == core::Precision::plain_double && scene_.view().rounding > 0.0F;
    const auto exact = static_cast<std::size_t>(core::Precision::exact);
    return (by_exact ? tracing_.kernels->methods[exact] : tracing_.method()).trace;
}

void CandidateSearch::nearest(const Coherence* coherence, const Candidates& candidates,
                              EngineCounters& counters) {
    TraceCounters traced{};
    trace().nearest(scene_.view(), scene_.listed_kinds(), common(coherence), count_, rounded_,
                    candidates, workspace_, traced);
    counters += traced;
    if (copies_ != nullptr) copies_->nearest(count_, rounded_, candidates, counters);
}

void CandidateSearch::occluded(const Coherence* coherence, const Occlusions& occlusions,
                               const double* distance, EngineCounters& counters) {
    TraceCounters traced{};
    trace().occluded(scene_.view(), scene_.listed_kinds(), common(coherence), count_, rounded_,
                     occlusions, workspace_, traced);
    counters += traced;
    if (copies_ != nullptr)
        copies_->occluded(count_, rounded_, distance, occlusions.state, counters);
}

bool CandidateSearch::list(std::size_t lane, CandidateList& list, TraceCounters& counters) const {
    return tracing_.method().refine.list_candidates(scene_.view(), scene_.listed_kinds(), rounded_,
                                                    lane, workspace_, list, counters) &&
           (copies_ == nullptr || copies_->list(rounded_, lane, list, counters));
}

void CandidateSearch::list_all(const float* t_limit, PairList& list) const {
    tracing_.method().refine.list_all(scene_.view(), scene_.listed_kinds(), count_, rounded_,
                                      t_limit, workspace_, list);
    if (copies_ != nullptr) copies_->list_all(count_, rounded_, t_limit, list);
}

} // namespace raylane::simd
