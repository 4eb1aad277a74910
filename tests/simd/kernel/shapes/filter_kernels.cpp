#include "tests/simd/kernel/shapes/filter_kernels.hpp"

namespace raylane::simd {

template <Isa isa>
FilterChecks filter_checks() {
    return FilterChecksOf<ArchOf<isa>>::table();
}
template FilterChecks filter_checks<Isa::RAYLANE_ISA>();

} // namespace raylane::simd
