#include "bench/peers/contender.hpp"

namespace raylane::bench {

std::vector<std::unique_ptr<Contender>> make_embree(const core::Scene& /*scene*/,
                                                    simd::Isa /*isa*/) {
    return {};
}

double embree_build_seconds(const core::Scene& /*scene*/, simd::Isa /*isa*/) {
    return -1.0;
}

} // namespace raylane::bench
