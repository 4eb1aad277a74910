#include "bench/peers/contender.hpp"
#include "bench/peers/crossings.hpp"
#include "bench/peers/measure.hpp"

/// Stand-in for Embree where it is missing.
namespace raylane::bench {

const char* embree_version() {
    return nullptr;
}

Contenders make_embree(const core::Scene& /*scene*/, simd::Isa /*isa*/, int /*call*/) {
    return {};
}

std::unique_ptr<Gatherer> embree_gatherer(const core::Scene& /*scene*/, simd::Isa /*isa*/,
                                          const RaySet& /*rays*/) {
    return nullptr;
}

std::optional<TimedRun> embree_building(const core::Scene& /*scene*/, simd::Isa /*isa*/) {
    return std::nullopt;
}

std::vector<Drawing> embree_drawings(const simd::SceneData& /*scene*/, simd::Isa /*isa*/) {
    return {};
}

} // namespace raylane::bench
