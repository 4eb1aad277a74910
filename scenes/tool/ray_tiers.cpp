#include "scenes/tool/ray_tiers.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>

namespace raylane::scenes {

RayTiers::RayTiers(const simd::EngineCounters& counters)
    : first(counters.rays() - std::min(counters.rays(), counters.refined + counters.doubtful)),
      second(counters.refined), reference(counters.doubtful + counters.followed),
      widened(counters.widened) {}

RayTiers& RayTiers::operator+=(const RayTiers& other) {
    first += other.first;
    second += other.second;
    reference += other.reference;
    widened += other.widened;
    return *this;
}

std::string RayTiers::text() const {
    return std::to_string(first) + " at first sight, " + std::to_string(second) + " at second, " +
           std::to_string(reference) + " by the reference, " + std::to_string(widened) +
           " tests beyond double";
}

std::optional<RayTiers> ray_tiers_of(const std::string& text) {
    RayTiers tiers;
    const int found = std::sscanf(text.c_str(),
                                  "%" SCNu64 " at first sight, %" SCNu64 " at second, %" SCNu64
                                  " by the reference, %" SCNu64,
                                  &tiers.first, &tiers.second, &tiers.reference, &tiers.widened);
    if (found != 4 || tiers.text() != text) return std::nullopt;
    return tiers;
}

} // namespace raylane::scenes
