#pragma once

#include "simd/engine_counters.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace raylane::scenes {

/// How the rays of a picture have been decided on, for the picture to say. What is left in doubt by
/// one tier goes to the next; how many are depends a little on the instruction set, what they hit
/// does not.
struct RayTiers {
    std::uint64_t first = 0;     ///< rays: by bounds in float and numbers in double
    std::uint64_t second = 0;    ///< rays: by tighter ones, of what the first had found
    std::uint64_t reference = 0; ///< rays and paths: by exact numbers, one after the other
    std::uint64_t widened = 0;   ///< tests of a ray and a shape in more than double, in the second

    RayTiers() = default;
    explicit RayTiers(const simd::EngineCounters& counters);

    RayTiers& operator+=(const RayTiers& other);
    /// "12 at first sight, 2 at second, 0 by the reference, 0 tests beyond double"
    std::string text() const;
};

/// Of a text() of them; nothing if it is none.
std::optional<RayTiers> ray_tiers_of(const std::string& text);

} // namespace raylane::scenes
