#include "bench/ceiling/loops.hpp"

namespace raylane::bench {

template <simd::Isa isa>
CeilingUnit ceiling() {
    return CeilingLoops<simd::ArchOf<isa>>::unit;
}
template CeilingUnit ceiling<simd::Isa::RAYLANE_ISA>();

} // namespace raylane::bench
