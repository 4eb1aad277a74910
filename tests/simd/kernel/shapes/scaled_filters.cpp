#include "tests/simd/kernel/shapes/scaled_filter_kernels.hpp"

namespace raylane::simd {

template <Isa isa>
ScaledFilters scaled_filters() {
    return scaled_simd::scaled_filters<ArchOf<isa>>();
}
template ScaledFilters scaled_filters<Isa::RAYLANE_ISA>();

} // namespace raylane::simd
