#include "simd/query/pair_crossings.hpp"

#include <algorithm>
#include <numeric>

namespace raylane::simd {

void PairCrossings::reserve(std::size_t rays) {
    first_of_ray.resize(rays + 1);
    listed_ray_.resize(16 * rays);
    listed_slot_.resize(listed_ray_.size());
}

/// Counts the pairs of each ray, finds where they begin, then moves each pair to its place.
void PairCrossings::sort(const PairList& list) {
    std::fill(first_of_ray.begin(), first_of_ray.end(), 0U);
    for (std::size_t k = 0; k < list.count; ++k)
        ++first_of_ray[list.ray[k]];
    std::exclusive_scan(first_of_ray.begin(), first_of_ray.end(), first_of_ray.begin(), 0U);
    ray_.resize(list.count);
    slot.resize(list.count);
    for (std::size_t k = 0; k < list.count; ++k) {
        const std::uint32_t to = first_of_ray[list.ray[k]]++;
        ray_[to] = list.ray[k];
        slot[to] = list.slot[k];
    }
    std::copy_backward(first_of_ray.begin(), first_of_ray.end() - 1, first_of_ray.end());
    first_of_ray[0] = 0;
}

void PairCrossings::cross(const double* const (&origin)[3], const double* const (&direction)[3],
                          const double* const (&unit_direction)[3], bool with_normals) {
    for (std::vector<double>* const column : {&high, &low, &error})
        column->resize(2 * slot.size());
    bits.resize(2 * slot.size());
    CrossingPairs pairs{};
    pairs.count = slot.size();
    for (int axis = 0; axis < 3; ++axis) {
        pairs.origin[axis] = origin[axis];
        pairs.direction[axis] = direction[axis];
        pairs.unit_direction[axis] = unit_direction[axis];
        if (!with_normals) continue;
        normal[axis].resize(2 * slot.size());
        pairs.normal[axis] = normal[axis].data();
    }
    pairs.ray = ray_.data();
    pairs.slot = slot.data();
    pairs.high = high.data();
    pairs.low = low.data();
    pairs.error = error.data();
    pairs.hit = bits.data();
    tracing_.method().refine.cross_all(scene_.view_with_copies(), pairs);
}

} // namespace raylane::simd
