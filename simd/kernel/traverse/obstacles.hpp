#pragma once

#include "simd/kernel/traverse/pairs.hpp"

namespace raylane::simd {

/// Calls take(ray, blocked or doubtful) for the pairs in which a shape is, or may be, in the ray's
/// way before t_limit(ray).
template <class Filter, class Arch, class Method, class Limit, class Take>
[[gnu::always_inline]] inline void for_each_obstacle(const SceneView& scene,
                                                     const Pairs<Arch, Method>& pairs,
                                                     const Limit& t_limit, const Take& take) {
    using S = Streams<Arch>;
    const PairBounds bounds = pairs.template bound<Filter>();
    for (std::uint32_t bits = bounds.possible; bits != 0; bits &= bits - 1) {
        const int k = __builtin_ctz(bits);
        const int ray = pairs.whose[k];
        const std::uint32_t slot = pairs.slot[k];
        const float limit = t_limit(ray);
        if (only_cuts<Arch, Method>(scene, slot)) continue;
        // A cut inside of the shape may be nearer.
        if (!(bounds.lower[k] < limit * perhaps_within) &&
            (cut_of<Method>(scene, slot) == nullptr || S::is_plain(scene, slot)))
            continue;
        const bool certain =
            (bounds.certain >> k & 1) != 0 && bounds.upper[k] < limit * surely_within;
        take(ray, certain && S::is_plain(scene, slot) ? blocked : doubtful);
    }
}

} // namespace raylane::simd
