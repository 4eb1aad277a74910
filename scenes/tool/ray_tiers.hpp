#pragma once

#include "simd/engine_counters.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace raylane::scenes {

/// The numbers of rays that each tier decided, which a picture's file states. Rays that one tier
/// leaves in doubt go to the next. The numbers depend slightly on the instruction set; the hits do
/// not.
struct RayTiers {
    std::uint64_t first = 0;     ///< rays decided by float bounds and double arithmetic
    std::uint64_t second = 0;    ///< rays decided by tighter bounds on the results of the first
    std::uint64_t reference = 0; ///< rays and paths decided by exact arithmetic, one by one
    std::uint64_t widened = 0;   ///< ray-shape tests beyond double precision, in the second

    RayTiers() = default;
    explicit RayTiers(const simd::EngineCounters& counters);

    RayTiers& operator+=(const RayTiers& other);
    /// Returns "12 at first sight, 2 at second, 0 by the reference, 0 tests beyond double".
    std::string text() const;
};

/// Parses a text of RayTiers::text(). Returns nothing if it is malformed.
std::optional<RayTiers> ray_tiers_of(const std::string& text);

} // namespace raylane::scenes
