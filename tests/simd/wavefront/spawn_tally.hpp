#pragma once

#include "core/shapes/types.hpp"

#include <cstdint>
#include <cstdio>
#include <string>

namespace raylane::tests {

enum RayKind : std::uint8_t { reflected_ray, refracted_ray, shadow_ray };

struct Tally {
    long rays[2][3] = {}; ///< index 1 for rays to the inside, then RayKind
    long self_hits = 0;   ///< hits on the shape left, where another shape is next
    long missed = 0;      ///< neighbours that were missed
    long other = 0;       ///< all other faults
    long by_oracle = 0, by_construction = 0;
    long doubtful = 0; ///< left open by float bounds or `solve`
    long followed = 0; ///< rays that only the reference could trace
    long into_the_open = 0, doubtful_in_the_open = 0;
    std::string first_faults;

    long all() const {
        long sum = 0;
        for (const auto& side : rays)
            for (const long count : side)
                sum += count;
        return sum;
    }
};

inline void print(core::Kind kind, const Tally& tally) {
    std::printf(
        "spawned, %-15s outward %ld reflected %ld refracted %ld shadow, "
        "inward %ld reflected %ld refracted %ld shadow; "
        "%ld by construction, %ld by the oracle; %ld doubtful, %ld followed; off surfaces %ld of "
        "%ld doubtful\n",
        std::string(core::name_of(kind)).c_str(), tally.rays[0][0], tally.rays[0][1],
        tally.rays[0][2], tally.rays[1][0], tally.rays[1][1], tally.rays[1][2],
        tally.by_construction, tally.by_oracle, tally.doubtful, tally.followed,
        tally.doubtful_in_the_open, tally.into_the_open);
}

} // namespace raylane::tests
