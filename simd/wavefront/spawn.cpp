#include "simd/wavefront/coherence.hpp"
#include "simd/wavefront/wavefront.hpp"

#include <algorithm>

namespace raylane::simd {

void Wavefront::spawn(int depth) {
    SpawnedRays reflected{};
    for (int axis = 0; axis < 3; ++axis) {
        reflected.origin[axis] = next_.origin[axis];
        reflected.direction[axis] = next_.direction[axis];
        reflected.weight[axis] = next_.throughput[axis];
    }
    reflected.parent = shadows_.rays().parent; // no longer needed
    transmitted_.count = 0;
    // A wave beyond the maximum depth still has rays that are not as deep: transparent surfaces
    // that a ray has passed do not count.
    for (const Run& run : sorted_.runs())
        if (run.material->reflects || run.material->transmits)
            shade_.spawn(run, static_cast<double>(settings_.min_weight),
                         with_media_ ? &media_ : nullptr, surfaces_, reflected, transmitted_);
    const std::size_t mirrored = add_to_next(reflected, /*through=*/false, depth);
    std::size_t refracted = 0;
    if (transmitted_.count != 0) {
        for (int axis = 0; axis < 3; ++axis) {
            std::copy_n(transmitted_.origin[axis], transmitted_.count,
                        next_.origin[axis] + next_.count);
            std::copy_n(transmitted_.direction[axis], transmitted_.count,
                        next_.direction[axis] + next_.count);
            std::copy_n(transmitted_.weight[axis], transmitted_.count,
                        next_.throughput[axis] + next_.count);
        }
        refracted = add_to_next(transmitted_, /*through=*/true, depth);
    }
    const std::size_t passed = transparent_ ? pass_on() : 0;
    counters_.reflected += mirrored;
    counters_.refracted += refracted;
    counters_.passed += passed;

    coherent_ = coherent_ && mirrored + refracted == 0;
    if (camera_rays_.has_lens() || refracted != 0) return;
    if (coherent_) {
        next_coherence_ = camera_coherence_;
        next_coherence_.beyond = !camera_.orthographic;
    } else if (depth == 0 && passed == 0) {
        next_coherence_ = coherence_off_mirror(camera_, scene_, surfaces_, sorted_.order(),
                                               finder_.hits().slot, reflected);
    }
}

/// Fills in the columns that kernels do not write, for the rays from next_.count on, and drops rays
/// that are too deep. Returns the number of rays left.
std::size_t Wavefront::add_to_next(const SpawnedRays& spawned, bool through, int depth) {
    const std::size_t before = next_.count;
    for (std::size_t k = 0; k < spawned.count; ++k) {
        const std::uint32_t lane = sorted_.order()[static_cast<std::size_t>(spawned.parent[k])];
        if (depth_of(lane, depth) >= settings_.max_depth) continue;
        const std::size_t from = before + k, to = next_.count++;
        if (from != to)
            for (int axis = 0; axis < 3; ++axis) {
                next_.origin[axis][to] = next_.origin[axis][from];
                next_.direction[axis][to] = next_.direction[axis][from];
                next_.throughput[axis][to] = next_.throughput[axis][from];
            }
        start_next(to, lane, through);
        next_.set_passed(to, paths_.passed_at(lane), 0.0);
    }
    return next_.count - before;
}

/// Adds the rays that go straight on behind transparent surfaces, in the order of the lanes, so
/// that neighbours stay neighbours. Returns their number.
std::size_t Wavefront::pass_on() {
    constexpr std::uint32_t none = no_slot;
    std::fill_n(position_of_.begin(), paths_.count, none);
    for (const Run& run : sorted_.runs())
        if (run.material->opacity < 1.0)
            for (std::size_t i = run.begin; i < run.end; ++i)
                position_of_[sorted_.order()[i]] = static_cast<std::uint32_t>(i);
    const auto least = static_cast<double>(settings_.min_weight);
    const std::size_t before = next_.count;
    for (std::size_t lane = 0; lane < paths_.count; ++lane) {
        const std::uint32_t position = position_of_[lane];
        if (position == none) continue;
        double most = 0.0;
        for (const double* channel : surfaces_.behind)
            most = std::max(most, channel[position]);
        if (!(most > 0.0) || most < least) continue;
        const std::size_t to = next_.count++;
        for (int axis = 0; axis < 3; ++axis) {
            next_.origin[axis][to] = surfaces_.point[axis][position];
            next_.direction[axis][to] = surfaces_.direction[axis][position];
            next_.throughput[axis][to] = surfaces_.behind[axis][position];
        }
        start_next(to, lane, /*through=*/true);
        next_.set_passed(to, paths_.passed_at(lane) + 1,
                         paths_.travelled_at(lane) + finder_.hits().t[lane]);
    }
    return next_.count - before;
}

/// Starts a ray of the next wave on the surface that a lane has hit.
void Wavefront::start_next(std::size_t to, std::size_t lane, bool through) {
    const std::uint32_t slot = finder_.hits().slot[lane], hit = finder_.hits().hit[lane];
    const SceneData::ShapeRecord shape = scene_.record_of(slot);
    next_.sample[to] = paths_.sample[lane];
    next_.start_on(to, slot, shape, hit, through);
    if (!with_media_) return;
    const core::Media media = paths_.media_at(lane);
    const bool crosses = through && scene_.scene().bounds_medium(shape.material, shape.medium);
    next_.set_media(to, crosses
                            ? reference_.media().crossed(media, shape.medium, shape.is_entered(hit))
                            : media);
}

/// While the rays do not fit in a wave, defers those of the later half of the samples. If a single
/// sample has too many rays, the reference tracer follows them.
void Wavefront::split_next(int depth) {
    while (paths_.count > wave_rays) {
        const auto [least, most] = std::minmax_element(paths_.sample, paths_.sample + paths_.count);
        const std::uint32_t first = *least, last = *most;
        if (first == last) {
            for (std::size_t lane = 0; lane < paths_.count; ++lane)
                follow(lane, depth);
            paths_.count = 0;
            return;
        }
        const std::uint32_t middle = first + (last - first) / 2;
        std::size_t kept = 0;
        const std::size_t begin = deferred_.count;
        for (std::size_t lane = 0; lane < paths_.count; ++lane)
            if (paths_.sample[lane] <= middle)
                paths_.copy(paths_, lane, kept++);
            else
                deferred_.copy(paths_, lane, deferred_.count++);
        pending_.push_back({begin, deferred_.count - begin, depth});
        counters_.deferred += deferred_.count - begin;
        paths_.count = kept;
    }
}

void Wavefront::take_deferred(int& depth) {
    const Deferred last = pending_.back();
    pending_.pop_back();
    for (std::size_t i = 0; i < last.count; ++i)
        paths_.copy(deferred_, last.begin + i, i);
    paths_.count = last.count;
    deferred_.count = last.begin;
    depth = last.depth;
    if (paths_.count > wave_rays) split_next(depth);
}

} // namespace raylane::simd
